// Experiments: drivers that run methods over scenes and write tables. The table of them is in experiment.cpp.
#pragma once

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/progress.h"
#include "experiments/table.h"
#include "mysim/observers/trajectory.h"
#include "reference/certificate.h"
#include "reference/method.h"
#include "reference/truth.h"

namespace crosscheck {

struct Request {
  std::vector<Scene> scenes;
  std::vector<Method> methods;  // empty: the default ones of each scene
  bool full = false;            // more points, for the same questions
  double step = 0;              // s, of all fixed-step methods; 0: each scene's own
};

/// One method's answer to one scene at the request's step, kept: experiments and pictures look at the same run.
struct Answer {
  std::string scene, method;
  Outcome outcome;
  Trajectory trajectory;
  std::vector<LedgerRow> ledger;  // empty in first-order scenes, without velocities and where unsupported
  bool contact_inferred = false;
};

struct Result {
  std::vector<Table> tables;
  std::deque<Answer> answers;  // a deque: references stay valid
  std::vector<Certificate> certificates;
  std::vector<std::string> notes;  // what was left out and why, for people

  const Table* table(const std::string& name) const;
};

struct Experiment {
  std::string_view name, question;
  void (*run)(const Request&, Progress&, Result&);
  int (*steps)(const Request&);  // how many times it calls Progress::begin
};

void order_experiment(const Request& request, Progress& progress, Result& result);
void energy_experiment(const Request& request, Progress& progress, Result& result);
void engines_experiment(const Request& request, Progress& progress, Result& result);
void stiffness_experiment(const Request& request, Progress& progress, Result& result);
void disagreements_experiment(const Request& request, Progress& progress, Result& result);

std::span<const Experiment> experiments();
/// Throws InputError that lists what there is.
const Experiment& find_experiment(const std::string& name);

/// The methods that a request runs on a scene: the ones it names, or all of mysim and Bullet; on a scene with a sphere
/// also the assignment's sticky sphere, to be seen failing beside them.
std::vector<Method> methods_of(const Request& request, const Scene& scene);

/// The method's answer to the scene, from the result or by running it now.
Answer& answer_of(const Request& request, const Scene& scene, const Method& method, Result& result);

/// The ledger of one run as rows of (method, t, energies, losses, work, balance error); the last is empty where the
/// contact loss was inferred, as no closure is claimed there.
Table ledger_table(const std::string& name);
void add_ledger(Table& table, const std::string& method, const std::vector<LedgerRow>& rows, bool contact_inferred);

/// A run of the scene at the request's step.
Run run_of(const Request& request, const Scene& scene);

}  // namespace crosscheck
