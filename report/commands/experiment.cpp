// experiment: runs experiments over scenes and writes their tables.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/experiment.h"
#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "report/certificate_json.h"
#include "report/commands/commands.h"
#include "report/provenance.h"

namespace crosscheck {

int experiment_command(const ExperimentOptions& options) {
  std::vector<const Experiment*> chosen;
  std::vector<std::string> scenes;
  Request request;
  request.full = options.full;
  if (!options.methods.empty()) request.methods = find_methods(options.methods);
  for (const std::string& name : options.names) {
    const auto all = experiments();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Experiment& e) { return e.name == name; });
    if (found != all.end())
      chosen.push_back(&*found);
    else if (chosen.empty())
      find_experiment(name);  // throws: the first word must be an experiment
    else
      scenes.push_back(name);
  }
  request.scenes = load_scenes(scenes);
  require_writable(options.out);

  int steps = 0;
  for (const Experiment* experiment : chosen) steps += experiment->steps(request);
  Progress progress(steps);
  Result result;
  for (const Experiment* experiment : chosen) experiment->run(request, progress, result);
  progress.done();

  const Provenance lines = with_scenes(provenance(options.command_line), request.scenes);
  for (const Table& table : result.tables) {
    write_csv(table, lines, options.out);
    fmt::print("{}  {} rows\n", (options.out / (table.name + ".csv")).string(), table.rows.size());
  }
  for (const Certificate& c : result.certificates)
    write_file(options.out / fmt::format("certificate-{}-{}.json", c.scene, file_name_of(c.method)),
               certificate_json(c));
  for (const std::string& note : result.notes) fmt::print("note: {}\n", note);
  return 0;
}

}  // namespace crosscheck
