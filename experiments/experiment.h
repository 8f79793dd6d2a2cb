// Experiments: their points and what a point computes, requests, and the table of experiments.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/tables/table.h"
#include "mysim/run/observers.h"
#include "mysim/scene/scene.h"
#include "reference/certificate/certificate.h"
#include "reference/method.h"
#include "reference/truth/truth.h"

namespace crosscheck {

// A point: one piece of an experiment's work, independent of all others. A sweep computes points in any order, on any
// machine, and keeps their tables.

/// The tables of a point, or of all points: these are joined by appending the rows of tables of the same name.
struct TableSet {
  std::vector<Table> tables;
  std::vector<Certificate> certificates;
  std::vector<std::string> notes;  // what was left out and why, for people

  const Table* table(const std::string& name) const;
  /// Appends the rows of a table to the one of that name, or begins it. Throws std::logic_error when columns differ.
  void add(const Table& table);
  /// Appends all of another's; a note that is there already is not said twice.
  void append(const TableSet& other);
};

/// The rows of the table Row::table; none where it is not there.
template <class Row>
std::vector<Row> rows_of(const TableSet& tables) {
  const Table* table = tables.table(std::string(Row::table));
  return table ? rows_of<Row>(*table) : std::vector<Row>();
}

struct Point {
  std::string name;     // for people: "engines: cloth-hang"; no two of a sweep share it
  std::string content;  // everything, beside the program, that its rows depend on
  std::function<void(TableSet&)> compute;
  bool timed = false;    // measures time: is run alone, pinned to one core, after all others
  bool is_long = false;  // takes seconds: begins before the others, so that no core waits for it at the end
  /// An untimed point whose rows this one needs: where they are kept, compute_from() is given them; compute() computes
  /// them first.
  std::shared_ptr<const Point> after = {};
  std::function<void(const TableSet&, TableSet&)> compute_from = {};

  /// Fingerprint of name, content and program: 16 hexadecimal digits. The same point of another build is another point.
  std::string hash() const;
};

/// A timed point that is computed from the rows of another one.
Point timed_after(const Point& first, std::string name, std::function<void(const TableSet&, TableSet&)> compute_from);

/// The data that a scene's rows depend on: its name, its hash, its times, its tolerance and its default method.
std::string content_of(const Scene& scene);

// Experiments: drivers that run methods over scenes and write tables. The table of them is in experiment.cpp.

/// A run, recorded for playback.
struct RecordedRun {
  Outcome outcome;
  Trajectory path;  // its samples; of one that failed, and of a map's cell, its last pictures; no frames: refused
  std::optional<Points> rest = {};  // m, of a map's cell: its base state
};
/// Runs of one method, in the order of the rows that the driver writes of them.
struct RecordedRuns {
  std::string of;  // "engines": one run, at the scene's own step; "speed-accuracy"; a map: "stiffness-map", "drag-map"
  const Scene& scene;
  std::string method;
  std::vector<RecordedRun> runs;
};
using RunCallback = std::function<void(const RecordedRuns&)>;

struct Request {
  std::vector<Scene> scenes;
  std::vector<Method> methods;  // empty: the default ones of each scene
  bool full = false;            // more points of the same experiments
  double step = 0;              // s, of all fixed-step methods; 0: each scene's own
  bool scenes_only = false;     // only these scenes, not the experiments' own ones
  bool all_engines = false;     // sets engines side by side: those in WebAssembly run small scenes only
  std::string reference = {};   // method from which `engines` measures differences; empty: the subject's representative
  RunCallback on_runs = {};     // is given the runs of engines, speed-accuracy and the maps; rows do not depend on it
};

/// A method's run of a scene at the request's step, kept, so that experiments and pictures use the same run.
struct MethodResult {
  std::string scene, method;
  Outcome outcome;
  Trajectory trajectory;
  std::vector<LedgerRow> ledger;  // empty in first-order scenes, without velocities and where unsupported
  bool contact_inferred = false;
};

struct Experiment {
  std::string_view name, question;
  /// The list of its points; the same request gives the same list.
  std::vector<Point> (*points)(const Request&);
  /// The scenes that stand for all in a quick run where none is named; empty: quick_scenes().
  std::span<const std::string_view> quick_scenes = {};
  /// Adds the tables that are made of the rows of all points.
  void (*conclude)(TableSet&) = nullptr;
  /// Those of its scenes that have charts and played runs of their own in a quick run where none is named; the
  /// others are in its tables and in the charts of all scenes. Empty: all have.
  std::span<const std::string_view> quick_charts = {};
};

std::vector<Point> order_points(const Request& request);
std::vector<Point> energy_points(const Request& request);
std::vector<Point> engines_points(const Request& request);
std::vector<Point> stability_points(const Request& request);
std::vector<Point> stiffness_points(const Request& request);
std::vector<Point> disagreements_points(const Request& request);
std::vector<Point> contact_points(const Request& request);
std::vector<Point> speed_accuracy_points(const Request& request);
std::vector<Point> cost_points(const Request& request);
std::vector<Point> adequacy_points(const Request& request);
std::vector<Point> relations_points(const Request& request);
std::vector<Point> fabric_points(const Request& request);
std::vector<Point> matrix_points(const Request& request);
void conclude_adequacy(TableSet& tables);
void conclude_matrix(TableSet& tables);
/// Adds what follows from the errors and the costs of all scenes (speed_accuracy/work_precision.cpp).
void conclude_speed_accuracy(TableSet& tables);

std::span<const Experiment> experiments();
/// The experiment of a name or of a former name, or null.
const Experiment* experiment_named(std::string_view name);
/// Throws InputError that lists what there is.
const Experiment& find_experiment(const std::string& name);

/// The scenes that an experiment looks at: the named ones; where none is named, all shipped ones or, in a quick run,
/// its quick ones; `methods` as for load_scene().
std::vector<Scene> scenes_for(const Experiment& experiment, const std::vector<std::string>& names, bool full,
                              const std::string& methods = "");

/// Whether the scene has charts of its own; `all`: scenes were named, or the run is a full one. Throws as
/// find_experiment().
bool has_own_charts(const std::string& experiment, const std::string& scene, bool all);

/// Appends those scenes of which none of the same name is there.
void add_missing(std::vector<Scene>& all, const std::vector<Scene>& more);

/// What runs where no method is named: all of mysim and of Bullet. Truth is what the others are held against,
/// integrators of others are no engines, and single precision doubles the work where few scenes need it.
std::vector<Method> default_methods();
/// The methods that a request runs on a scene: the ones it names, or all of mysim and Bullet; on a scene with a sphere
/// also the assignment's sticky sphere, to be seen failing.
std::vector<Method> methods_of(const Request& request, const Scene& scene);

/// The results so far: a deque, so that references stay valid.
using MethodResults = std::deque<MethodResult>;

/// The method's result on the scene at the request's step, from those so far or by running it now.
MethodResult& result_of(const Request& request, const Scene& scene, const Method& method, MethodResults& results);

/// A run of the method with its path, and nothing else that is observed.
MethodResult recorded_result(const Method& method, const Scene& scene, const Run& run);

/// Tables SCENE-energy and engines-energy: the ledgers of the results at the request's step, and what contact took
/// beside what it takes in truth.
void add_energies(const Request& request, const Scene& scene, const std::optional<Truth>& truth, MethodResults& results,
                  TableSet& tables);

/// Experiment `engines` on one scene, with the results that it used.
void engines_on(const Request& request, const Scene& scene, MethodResults& results, TableSet& tables);

/// One point per scene: `compute` is given a request of that scene alone. Its content is the scene's and the request's.
std::vector<Point> one_point_per_scene(const Request& request, const std::string& experiment,
                                       void (*compute)(const Request&, const Scene&, TableSet&));

/// The parts of a request that a scene's rows depend on: the methods, outside programs with the fingerprint of their
/// file, the step and the number of points.
std::string content_of(const Request& request, const Scene& scene);

/// True for a method that would take too long on the scene in a report of all engines.
bool is_left_out(const Request& request, const Method& method, const Scene& scene);

/// A run of the scene at the request's step.
Run run_of(const Request& request, const Scene& scene);

}  // namespace crosscheck
