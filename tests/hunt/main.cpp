// hunt METHOD... [--seconds 60] [--seed 1] [--from 0] [--known FILE] [--out out/hunt]
//
// A tool for developers of engines and of Crosscheck. Draws random scenes and checks every relation of `crosscheck
// check`, and whether each pair of methods converges to the same limit as the steps go to 0. A scene that shows a
// violation is shrunk and written to OUT/RELATION-METHODS-KIND.toml. Later violations of the same relation, methods and
// kind of scene are only counted. Case i of a seed is always the same scene; several processes can share the work with
// different values of --from or --seed. Exit status: 0 if no unknown violation was found, 1 otherwise, 2 for bad usage.
//
//   cmake --build build/release --target hunt && build/release/tests/hunt/hunt exec:./engine leapfrog --seconds 600

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "tests/hunt/hunt.h"

using namespace crosscheck;

namespace {

struct Options {
  std::vector<std::string> methods;
  double seconds = 60;
  unsigned seed = 1;
  long from = 0;
  std::filesystem::path known = shipped_known_breaks(), out = "out/hunt";
};

void report(const Break& found, const Options& options, unsigned seed) {
  const Answer& answer = found.answer;
  const SceneDraft& scene = found.smallest.draft;
  const std::string relation(answer.relation->name), kind = scene.kind();
  const auto file = options.out / (file_name_of(fmt::format("{}-{}-{}", relation, answer.method, kind)) + ".toml");
  write_file(file, scene.text());
  fmt::print("{} of {} on {} ({} particles, {} springs, {} trials)\n  expected: {}\n  measured: {}\n", relation,
             answer.method, kind, scene.size(), scene.springs.size(), found.smallest.trials, answer.relation->sentence,
             answer.sentence());
  if (answer.relation == &agreement())
    fmt::print("  {}\n", file.string());
  else
    fmt::print("  crosscheck check {} {} --seed {}\n", answer.method, file.string(), seed);
  std::fflush(stdout);
}

int hunt_for(const Options& options) {
  Hunt hunt{{}, read_known_breaks(options.known), options.seed};
  for (const std::string& name : options.methods) hunt.methods.push_back(find_method(name));
  std::filesystem::create_directories(options.out);
  std::map<std::string, int> groups;  // violations by relation, methods and kind of scene
  int answers = 0;
  long index = options.from;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
  for (; std::chrono::steady_clock::now() < end; ++index)
    for (const Break& found : breaks_of(hunt, index, answers)) {
      const std::string group =
          fmt::format("{} of {} on {}", found.answer.relation->name, found.answer.method, found.smallest.draft.kind());
      if (groups[group]++ == 0) report(found, options, hunt.seed_of(index));
    }
  for (const auto& [group, count] : groups) fmt::print("{:>4} times: {}\n", count, group);
  fmt::print("{} answers on cases {} to {} of seed {}\n", answers, options.from, index - 1, options.seed);
  return groups.empty() && answers > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("checks relations of methods on random scenes, and shrinks scenes that break them");
  app.add_option("METHOD", options.methods, "methods")->required();
  app.add_option("--seconds", options.seconds, "time after which no new case starts (default: 60)");
  app.add_option("--seed", options.seed, "seed of the scenes (default: 1)");
  app.add_option("--from", options.from, "number of the first case (default: 0)");
  app.add_option("--known", options.known, "TOML file of known breaks, instead of the shipped one");
  app.add_option("--out", options.out, "folder for the scenes (default: out/hunt)");
  try {
    app.parse(argc, argv);
    return hunt_for(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "hunt: {}\n", error.what());
    return 2;
  }
}
