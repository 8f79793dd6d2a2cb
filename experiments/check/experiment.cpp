// Experiment `relations`: every relation of every engine, on the smallest scenes that can show it.
#include "experiments/experiment.h"

#include "experiments/check/check.h"
#include "mysim/base/files.h"

namespace crosscheck {

std::vector<Point> relations_points(const Request& request) {
  std::vector<Method> methods = request.methods.empty() ? default_methods() : request.methods;
  // leaves out shipped methods: their answers do not depend on the chosen scenes, and are in the report of all scenes
  if (request.scenes_only) std::erase_if(methods, [](const Method& method) { return method.fingerprint.empty(); });
  const std::string text = read_file(shipped_known_breaks(), "a table of known breaks");
  const std::vector<KnownBreak> known = read_known_breaks(shipped_known_breaks());
  std::vector<Point> points;
  for (const Method& method : methods)
    points.push_back({"relations: " + method.name, method.fingerprint + "\n" + text,
                      [method, known](TableSet& tables) { tables.add(table_of(answers_of(method, {}, 1, known))); }});
  return points;
}

}  // namespace crosscheck
