// The package, from the zip to results.json, before any student sees it.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>

#include "mysim/errors.h"
#include "mysim/json.h"
#include "mysim/temporary_folder.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/pack.h"
#include "tests/coursework/grader/watched.h"
#include "tests/coursework/grader/zip.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

std::string last_lines(const fs::path& log) {
  const std::string text = content_of_file(log);
  constexpr size_t most = 1500;
  return text.size() > most ? "... " + text.substr(text.size() - most) : text;
}

/// What is wrong with the results of our own solution; empty: nothing.
std::string wrong_with(const fs::path& results) {
  if (!fs::exists(results)) return "there is no results/results.json";
  try {
    const auto json = crosscheck::JsonField::parse(content_of_file(results), "results.json");
    double most = 0;
    for (const auto& test : json["tests"].elements()) {
      most += test["max_score"].number();
      if (test["status"].text() != "passed")
        return fmt::format("the solution fails test {}: {}", test["number"].text(), test["output"].text());
    }
    if (json["score"].number() != most || most != 100)
      return fmt::format("the solution gets {} of {} points", json["score"].dump(), most);
    if (json["extra_data"]["lane"].text() == "bare") return "submissions would run without a lane";
  } catch (const crosscheck::InputError& error) {
    return fmt::format("the results are not as documented: {}", error.what());
  }
  return "";
}

bool not_ready(const std::string& why) {
  fmt::print("not ready: {}\n", why);
  return false;
}

}  // namespace

bool rehearse(const Assignment& assignment, const fs::path& zip) {
  const crosscheck::TemporaryFolder scratch("rehearse");
  const fs::path root = scratch.path, source = root / "source", log = root / "log.txt";
  unpack_zip(zip, source);
  for (const char* needed : {"setup.sh", "run_autograder", "build.sh"})
    if (!fs::exists(source / needed)) return not_ready(fmt::format("{} is not in the zip", needed));
  const char* path = std::getenv("PATH");
  const std::vector<std::string> environment = {std::string("PATH=") + (path ? path : "/usr/bin:/bin"), "LANG=C",
                                                "HOME=" + root.string(), "AUTOGRADER_ROOT=" + root.string()};

  fmt::print("build.sh, with the packages of this machine (setup.sh would install its own first)\n");
  std::fflush(stdout);
  const Used built = run_watched({"/bin/sh", (source / "build.sh").string()}, environment, log,
                                 {.cpus = 1, .memory = 1 << 20, .time = 1800, .closed = false});
  fmt::print("  {:.0f} s on one CPU, {} MB\n{}", built.time, built.memory, last_lines(log));
  if (built.too_late) return not_ready("build.sh takes more than half an hour");
  if (built.status != 0) return not_ready(fmt::format("build.sh ends with {}", built.status));

  // Gradescope puts the script there, and makes the two folders
  fs::copy_file(source / "run_autograder", root / "run_autograder");
  fs::create_directories(root / "submission");
  fs::create_directories(root / "results");
  for (const auto& entry : fs::directory_iterator(assignment.folder() / "solution"))
    fs::copy(entry.path(), root / "submission" / entry.path().filename());

  const Container container;
  fmt::print("run_autograder on the solution: {} MB, {} CPU, {:.0f} s, no new namespaces\n", container.memory,
             container.cpus, container.time);
  std::fflush(stdout);
  const Used used = run_watched({(root / "run_autograder").string()}, environment, log, container);
  fmt::print("  {:.0f} s at {} CPU, {} MB\n{}", used.time, container.cpus, used.memory, last_lines(log));
  if (used.too_large) return not_ready(fmt::format("it takes more than {} MB", container.memory));
  if (used.too_late) return not_ready(fmt::format("it takes more than {:.0f} s", container.time));
  if (used.status != 0) return not_ready(fmt::format("run_autograder ends with {}", used.status));
  if (const std::string wrong = wrong_with(root / "results/results.json"); !wrong.empty()) return not_ready(wrong);
  fmt::print("ready\n");
  return true;
}

}  // namespace coursework
