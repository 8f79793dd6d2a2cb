// Experiments: their points, requests, and the table of experiments (experiment.cpp).
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

// A point is a unit of an experiment's work that does not depend on any other point. A sweep computes points in any
// order, on any machine, and keeps their tables.

/// The tables of one point or of several points.
struct TableSet {
  std::vector<Table> tables;
  std::vector<Certificate> certificates;
  std::vector<std::string> notes;  // omissions and their reasons, for human readers

  const Table* table(const std::string& name) const;
  /// Appends the rows to the table of the same name, or adds the table. Throws std::logic_error if the columns differ.
  void add(const Table& table);
  /// Does not repeat notes that exist already.
  void append(const TableSet& other);
};

/// The rows of table Row::table; empty if the set does not contain this table.
template <class Row>
std::vector<Row> rows_of(const TableSet& tables) {
  const Table* table = tables.table(std::string(Row::table));
  return table ? rows_of<Row>(*table) : std::vector<Row>();
}

struct Point {
  std::string name;     // for human readers: "engines: cloth-hang"; unique in a sweep
  std::string content;  // everything on which the rows depend, except the program
  std::function<void(TableSet&)> compute;
  bool timed = false;    // measures time: runs alone, pinned to one core, after all others
  bool is_long = false;  // takes seconds: starts before the others, so that no core is idle at the end
  /// An untimed point whose rows this one needs. A sweep that keeps these rows passes them to compute_from(); compute()
  /// computes them first.
  std::shared_ptr<const Point> after = {};
  std::function<void(const TableSet&, TableSet&)> compute_from = {};

  /// Fingerprint of name, content and program: 16 hexadecimal digits. It differs between builds.
  std::string hash() const;
};

Point timed_after(const Point& first, std::string name, std::function<void(const TableSet&, TableSet&)> compute_from);

/// The data of a scene on which rows depend: name, hash, times, tolerance and default method.
std::string content_of(const Scene& scene);

struct RecordedRun {
  Outcome outcome;
  Trajectory path;                  // samples; for failed runs and cells of maps, the last frames; empty if refused
  std::optional<Points> rest = {};  // m, base state of a cell of a map
};
/// Runs of one method, in the order of the corresponding rows.
struct RecordedRuns {
  std::string of;  // "engines" (one run, at the scene's own step), "speed-accuracy", "stiffness-map" or "drag-map"
  const Scene& scene;
  std::string method;
  std::vector<RecordedRun> runs;
};
using RunCallback = std::function<void(const RecordedRuns&)>;

struct Request {
  std::vector<Scene> scenes;
  std::vector<Method> methods;  // empty: the default methods of each scene
  bool full = false;            // more points of the same experiments
  double step = 0;              // s, for all fixed-step methods; 0: each scene's own step
  bool scenes_only = false;     // omits the experiments' own scenes
  bool all_engines = false;     // compares all engines: those in WebAssembly run small scenes only
  std::string reference = {};   // `engines` measures differences from it; empty: the subject's representative
  RunCallback on_runs = {};     // receives the runs of engines, speed-accuracy and maps; rows do not depend on it
};

struct MethodResult {
  std::string scene, method;
  Outcome outcome;
  Trajectory trajectory;
  std::vector<LedgerRow> ledger;  // empty for first-order scenes, methods without velocities, and unsupported scenes
  bool contact_inferred = false;
};

struct Experiment {
  std::string_view name, question;
  /// Makes the points of a request; equal requests give equal lists.
  std::vector<Point> (*points)(const Request&);
  /// Scenes of a quick run if the user names none. If empty: quick_scenes().
  std::span<const std::string_view> quick_scenes = {};
  /// Adds the tables that are derived from the rows of all points.
  void (*conclude)(TableSet&) = nullptr;
  /// Scenes that get their own charts and playable runs in a quick run if the user names no scenes. Other scenes appear
  /// in tables and joint charts only. If empty: all scenes.
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
void conclude_speed_accuracy(TableSet& tables);

std::span<const Experiment> experiments();
/// Also accepts former names.
const Experiment* experiment_named(std::string_view name);
/// Throws InputError with a suggestion if no experiment has this name.
const Experiment& find_experiment(const std::string& name);

/// The named scenes or, if none are named, all shipped scenes (in a quick run, the quick scenes of the experiment).
/// `methods` is passed to load_scene().
std::vector<Scene> scenes_for(const Experiment& experiment, const std::vector<std::string>& names, bool full,
                              const std::string& methods = "");

/// True if the scene has charts of its own. `all`: scenes were named, or the run is a full one. Throws InputError as
/// find_experiment() does.
bool has_own_charts(const std::string& experiment, const std::string& scene, bool all);

void add_missing(std::vector<Scene>& all, const std::vector<Scene>& more);

/// All methods of mysim and Bullet except three kinds: truth methods, which are the reference for the others; external
/// integrators, which are not engines; and single precision, which doubles the work and matters in few scenes.
std::vector<Method> default_methods();
/// The requested methods or, if none are requested, default_methods(). For scenes with contact, the default also
/// includes the assignment's sticky sphere, to show its failure.
std::vector<Method> methods_of(const Request& request, const Scene& scene);

/// A deque, because references to its elements stay valid when it grows.
using MethodResults = std::deque<MethodResult>;

/// The method's result on the scene at the request's step, taken from `results` or, if missing, computed and appended.
MethodResult& result_of(const Request& request, const Scene& scene, const Method& method, MethodResults& results);

MethodResult recorded_result(const Method& method, const Scene& scene, const Run& run);

/// Adds the tables SCENE-energy and engines-energy: the ledgers of the results at the request's step, and the contact
/// loss together with that of the truth.
void add_energies(const Request& request, const Scene& scene, const std::optional<Truth>& truth, MethodResults& results,
                  TableSet& tables);

void engines_on(const Request& request, const Scene& scene, MethodResults& results, TableSet& tables);

/// `compute` receives a request with one scene only; the point's content is that of this scene and the request.
std::vector<Point> one_point_per_scene(const Request& request, const std::string& experiment,
                                       void (*compute)(const Request&, const Scene&, TableSet&));

/// The properties of a request on which a scene's rows depend: the methods (including the file fingerprints of external
/// programs), the step and the number of points.
std::string content_of(const Request& request, const Scene& scene);

/// True if the method takes too long on the scene for a report that compares all engines.
bool is_left_out(const Request& request, const Method& method, const Scene& scene);

/// The scene's default run, at the request's step if it has one.
Run run_of(const Request& request, const Scene& scene);

}  // namespace crosscheck
