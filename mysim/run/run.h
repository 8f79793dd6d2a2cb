// One run: its settings (Run), its observers (Observer), its results (Outcome). Every engine has this type.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

enum class Verdict {
  ok,
  energy,       // over ten times as fast as the true motion ever is (run/observers.h)
  nan,          // a non-finite position or velocity
  stretch,      // a spring over ten times as long as in the true motion
  solver,       // an equation inside a step had no solution
  frozen,       // forces act, and nothing moves
  timeout,      // an outside program did not end in time
  crash,        // an outside program died, or did not deliver what the protocol requires
  unsupported,  // the method lacks an ingredient of the scene
};
std::string_view name_of(Verdict verdict);   // the word in tables and files
std::string_view in_words(Verdict verdict);  // for people

struct Run {
  double step;              // s, at most; the run reduces it so that it divides the sampling interval
  double duration;          // s
  int samples;              // frames after the first, at i duration / samples
  double tolerance = 1e-6;  // of adaptive methods: relative; absolute it is this times the scene's size
  bool timed = true;        // whether CPU time is measured; its clock costs as much as a step of a few particles
};
/// The scene's own step, duration and samples; adaptive methods keep to a hundredth of the scene's tolerance.
Run default_run(const Scene& scene);

/// The steps of a run: `steps_per_sample` steps of length h between two samples.
struct TimeGrid {
  double h;  // s
  int steps_per_sample;
  int samples;
  double time(int sample, int step) const { return (static_cast<double>(sample) * steps_per_sample + step) * h; }
};
/// Throws InputError when the step is so small that a sampling interval would take more than 1e9 of them.
TimeGrid time_grid(const Run& run);
/// Steps between two states that a verdict is based on: the smallest divisor of a sampling interval with which a run
/// has at most 8192 such states, and at most 2^20 particle positions in them. Outside programs are asked for the same
/// states, so that every engine is judged on the same evidence.
int verdict_stride(const TimeGrid& grid, int particles);

/// Observes the states of a run.
class Observer {
 public:
  virtual ~Observer() = default;
  /// True: sees every step. False: sees the start and the samples only.
  virtual bool every_step() const { return false; }
  /// True: sees every verdict_stride-th step between two samples, too.
  virtual bool between_samples() const { return false; }
  /// Anything but Verdict::ok ends the run.
  virtual Verdict observe(const State& state, bool sample) = 0;
  /// Something touched in the last step, and this is what it took, J (contacts.h says how it is counted): called before
  /// the state after the step is observed, by engines that know their contacts.
  virtual void contact(double /*lost*/) {}
};

/// Observes nothing.
class NullObserver : public Observer {
 public:
  Verdict observe(const State&, bool) override { return Verdict::ok; }
};

/// Several observers as one; the first verdict that is not ok counts.
class Observers : public Observer {
 public:
  explicit Observers(std::vector<Observer*> list) : list_(std::move(list)) {}
  bool every_step() const override;
  Verdict observe(const State& state, bool sample) override;
  void contact(double lost) override;

 private:
  std::vector<Observer*> list_;
};

/// Forces that an engine computes in a state that it was put into for the purpose, N (3 x n); each may be empty.
struct ForceProbe {
  double t = 0;     // s
  Points x, v;      // m, m/s: where the particles were put, and how fast
  Points springs;   // of the springs alone, at x
  Points bending;   // of bending alone, at x
  Points dashpots;  // of the dashpots alone, at x and v
  Points wind;      // of both winds, at x and t, the free particles at rest
};

/// The scene as the engine built it, read from its own data structures after the first step. What is empty it
/// does not report.
struct Readback {
  struct Link {
    int a, b;                         // ends, in the scene's numbering
    double rest;                      // m
    std::optional<double> stiffness;  // N/m; where the engine does not report it, the probe does
  };
  struct Ball {
    Vec3 centre;                        // m, at the start
    std::optional<double> radius;       // m, at which particles touch: margin included
    std::optional<double> friction;     // Coulomb's mu
    std::optional<double> restitution;  // e
  };
  struct Face {                         // a plane
    Vec3 point, normal;                 // m, 1: where particles touch at the start, margin included
    std::optional<double> friction;     // Coulomb's mu
    std::optional<double> restitution;  // e
  };
  /// Pins, spheres and planes in the engine at another time.
  struct Places {
    double t;                   // s
    Points pins;                // m, in the scene's order
    std::vector<Vec3> centres;  // m, of spheres
    std::vector<Vec3> points;   // m, of planes: where those points of the faces are by then
  };
  std::vector<double> mass;  // kg; 0 where the engine holds the particle fixed
  std::vector<char> pinned;  // 1 where fixed
  std::vector<Link> links;   // springs
  std::optional<ForceProbe> probe;
  std::optional<Vec3> gravity;              // m/s^2
  std::optional<std::vector<double>> drag;  // 1/s, drag rate gamma of each free particle
  std::optional<std::vector<Ball>> spheres;
  std::optional<std::vector<Face>> planes;
  std::optional<Places> later;                  // what a prescribed motion moves, at a later time
  std::optional<double> margin;                 // m, half the thickness of the cloth
  std::optional<State> start;                   // positions and velocities that the first step began from
  std::optional<double> step;                   // s
  std::string precision;                        // "double" or "single"
  std::optional<bool> may_sleep;                // the engine may freeze slow bodies
  std::map<std::string, std::string> settings;  // others that the engine's results depend on: name -> value
  std::map<std::string, std::string> mapped;    // quantity -> how it was handed over, for the certificate
};

struct Outcome {
  Verdict verdict = Verdict::ok;
  std::string reason;                      // one sentence when the verdict is not ok
  double end = 0;                          // s, last time reached; the time of failure when the verdict is not ok
  double step = 0;                         // s, as used; the mean of adaptive methods
  bool adaptive = false;                   // an outside program reports that it chooses its steps
  bool serves = false;                     // likewise, that one process of it can run many scenes
  std::string engine;                      // name and version of an outside program's engine
  double tolerance = 0;                    // 1, of adaptive methods; 0 elsewhere
  long steps = 0;                          // taken
  long evaluations = 0;                    // of the right-hand side, or the engine's own force passes
  long degenerate_springs = 0;             // springs met at zero length, summed over the evaluations
  double cpu_seconds = 0;                  // of the stepping threads, observers excluded; an outside program's own word
  double process_seconds = 0;              // CPU of a whole outside process, its start and its files included; 0 inside
  std::string remark;                      // what else a reader should know, e.g. what an outside program complained of
  std::vector<std::string> different_law;  // ingredients that the engine has under another law, one sentence each
  std::optional<Readback> readback;
};

using Engine = std::function<Outcome(const Scene&, const Run&, Observer&)>;

}  // namespace crosscheck
