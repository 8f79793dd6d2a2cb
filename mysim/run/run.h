// The interface of all engines: a run's settings (Run), its observers (Observer) and its results (Outcome).
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
  energy,       // more than ten times as fast as the true motion ever is (run/observers.h)
  nan,          // a non-finite position or velocity
  stretch,      // a spring more than ten times as long as in the true motion
  solver,       // an equation inside a step could not be solved
  frozen,       // nothing moves, although forces act
  timeout,      // an external program did not end in time
  crash,        // an external program died, or violated the protocol
  unsupported,  // the method does not support an ingredient of the scene
};
std::string_view name_of(Verdict verdict);   // identifier in tables and files
std::string_view in_words(Verdict verdict);  // readable text

struct Run {
  double step;              // s, upper bound; reduced to divide the sampling interval
  double duration;          // s
  int samples;              // frames after the first, at i duration / samples
  double tolerance = 1e-6;  // adaptive methods: relative; the absolute tolerance is this times the scene's size
  bool timed = true;        // measure CPU time, which costs as much as a step of a few particles
};
/// The scene's step, duration and samples; the tolerance of adaptive methods is a hundredth of the scene's.
Run default_run(const Scene& scene);

struct TimeGrid {
  double h;  // s
  int steps_per_sample;
  int samples;
  double time(int sample, int step) const { return (static_cast<double>(sample) * steps_per_sample + step) * h; }
};
/// Throws InputError if a sampling interval would contain more than 1e9 steps.
TimeGrid time_grid(const Run& run);
/// Steps between two states on which a verdict is based: the smallest divisor of steps_per_sample for which a run has
/// at most 8192 such states, and at most 2^20 particle positions in them. External programs must return the same
/// states, so that every engine is judged on the same evidence.
int verdict_stride(const TimeGrid& grid, int particles);

class Observer {
 public:
  virtual ~Observer() = default;
  /// True: receives every step. False: only the initial state and the samples.
  virtual bool every_step() const { return false; }
  /// True: also receives every verdict_stride-th step.
  virtual bool between_samples() const { return false; }
  /// Any verdict except Verdict::ok ends the run.
  virtual Verdict observe(const State& state, bool sample) = 0;
  /// Reports a contact in the last step and its energy loss (J, accounting rules in contacts.h). Engines that know
  /// their contacts call it before observe() receives the state after the step.
  virtual void contact(double /*lost*/) {}
};

class NullObserver : public Observer {
 public:
  Verdict observe(const State&, bool) override { return Verdict::ok; }
};

/// Several observers; the first verdict that is not ok counts.
class Observers : public Observer {
 public:
  explicit Observers(std::vector<Observer*> list) : list_(std::move(list)) {}
  bool every_step() const override;
  Verdict observe(const State& state, bool sample) override;
  void contact(double lost) override;

 private:
  std::vector<Observer*> list_;
};

/// Forces (N, 3 x n) that an engine computes at a state set for this purpose; empty if not reported.
struct ForceProbe {
  double t = 0;     // s
  Points x, v;      // m, m/s: the state that was set
  Points springs;   // springs alone, at x
  Points bending;   // bending alone, at x
  Points dashpots;  // dashpots alone, at x and v
  Points wind;      // uniform wind and air on triangles, at x and t, with the free particles at rest
};

/// The scene as the engine built it, read from its own data structures after the first step. Members that the engine
/// does not report are empty.
struct Readback {
  struct Link {
    int a, b;                         // ends, in the scene's numbering
    double rest;                      // m
    std::optional<double> stiffness;  // N/m; empty if the probe reports it
  };
  struct Ball {
    Vec3 centre;                        // m, at the start
    std::optional<double> radius;       // m, distance of touching particles from the centre, with margin
    std::optional<double> friction;     // Coulomb's mu
    std::optional<double> restitution;  // e
  };
  struct Face {          // a plane
    Vec3 point, normal;  // m, 1: where particles touch at the start, including the margin
    std::optional<double> friction;
    std::optional<double> restitution;
  };
  /// Positions of pins, spheres and planes in the engine at another time.
  struct Places {
    double t;                   // s
    Points pins;                // m, in the scene's order
    std::vector<Vec3> centres;  // m, of spheres
    std::vector<Vec3> points;   // m, of planes, as Face::point
  };
  std::vector<double> mass;  // kg; 0 if the engine holds the particle fixed
  std::vector<char> pinned;  // 1 where fixed
  std::vector<Link> links;   // springs
  std::optional<ForceProbe> probe;
  std::optional<Vec3> gravity;              // m/s^2
  std::optional<std::vector<double>> drag;  // 1/s, drag rate gamma of each free particle
  std::optional<std::vector<Ball>> spheres;
  std::optional<std::vector<Face>> planes;
  std::optional<Places> later;                  // positions of moved objects
  std::optional<double> margin;                 // m, half the thickness of the cloth
  std::optional<State> start;                   // positions and velocities before the first step
  std::optional<double> step;                   // s
  std::string precision;                        // "double" or "single"
  std::optional<bool> may_sleep;                // the engine may freeze slow bodies
  std::map<std::string, std::string> settings;  // other settings that affect results: name -> value
  std::map<std::string, std::string> mapped;    // quantity -> how it was transferred, for the certificate
};

struct Outcome {
  Verdict verdict = Verdict::ok;
  std::string reason;                      // one sentence if the verdict is not ok
  double end = 0;                          // s, last time reached or time of failure
  double step = 0;                         // s, as used; for adaptive methods the mean
  bool adaptive = false;                   // an external program chooses its steps
  bool serves = false;                     // an external program can run many scenes in one process
  std::string engine;                      // name and version of an external program
  double tolerance = 0;                    // tolerance of adaptive methods, dimensionless; otherwise 0
  long steps = 0;                          // taken
  long evaluations = 0;                    // right-hand side evaluations, or the engine's own force passes
  long degenerate_springs = 0;             // springs at zero length, summed over evaluations
  double cpu_seconds = 0;                  // CPU time of stepping, without observers; external programs report it
  double process_seconds = 0;              // CPU time of an external program, including start-up and files; otherwise 0
  std::string remark;                      // e.g. complaints of an external program
  std::vector<std::string> different_law;  // ingredients that the engine models by another law, one sentence each
  std::optional<Readback> readback;
};

using Engine = std::function<Outcome(const Scene&, const Run&, Observer&)>;

}  // namespace crosscheck
