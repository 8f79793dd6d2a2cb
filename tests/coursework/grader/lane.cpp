#include "tests/coursework/grader/lane.h"

#include <fmt/core.h>
#include <unistd.h>

#include <stdexcept>

#include "mysim/errors.h"
#include "mysim/nearest.h"
#include "tests/coursework/grader/lanes.h"
#include "tests/coursework/grader/own_folder.h"

namespace coursework {
namespace {

struct Row {
  std::string_view name;
  std::unique_ptr<Lane> (*make)();
};

// In the order in which they are tried. `bare` is never chosen by a probe.
constexpr Row lanes[] = {{"bwrap", bwrap_lane}, {"uid", uid_lane}};

constexpr std::string_view no_sandbox_means =
    "With --no-sandbox submissions run as you: they can read and change whatever you can, the tests and the results "
    "among it, and use the network; only time, memory, processes and output stay limited. Do that for code you trust, "
    "or in a virtual machine that you throw away.";

/// Runs a shell in the lane. Empty where it runs there, sees no secret of ours and cannot start a process; else what is
/// wrong.
std::string lacks(const Lane& lane) {
  const OwnFolder secret(0700);
  try {
    Job job;
    job.command = {"/bin/sh", "-c",
                   R"(if [ -r "$0" ]; then echo sees >&3; else echo blind >&3; fi; (true) && echo forks >&3)",
                   secret.path().string()};
    const End end = lane.run(job);
    if (end.answers == "blind\n") return {};
    if (end.answers.find("sees") == 0) return "a program in it still reads folders of mode 0700";
    if (end.answers.find("forks") != std::string::npos) return "a program in it still starts others";
    return end.chatter.empty() ? "a shell does not run in it" : end.chatter.substr(0, end.chatter.find('\n'));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

}  // namespace

std::unique_ptr<Lane> choose_lane(const std::string& named, bool unsafe) {
  if (named == "bare" || (named.empty() && unsafe)) {
    if (unsafe) return bare_lane();
    throw std::runtime_error(fmt::format("lane bare needs --no-sandbox as well. {}", no_sandbox_means));
  }
  std::string reasons, names;
  bool known = false;
  for (const Row& row : lanes) {
    names += fmt::format("{}, ", row.name);
    if (!named.empty() && named != row.name) continue;
    known = true;
    auto lane = row.make();
    const std::string why = lacks(*lane);
    if (why.empty()) return lane;
    reasons += fmt::format("  {}: {}\n", row.name, why);
  }
  if (!known)
    throw crosscheck::InputError(fmt::format("--lane {}: there is no such lane; expected one of: {}bare{}", named,
                                             names, crosscheck::did_you_mean(named, {"bwrap", "uid", "bare"})));
  throw std::runtime_error(
      fmt::format("Nothing here keeps a submission away from your files, so it is not run:\n{}"
                  "Install bubblewrap where user namespaces are allowed, or run the grader as root.\n{}",
                  reasons, no_sandbox_means));
}

std::unique_ptr<Lane> lane_named(const std::string& name) {
  if (name == "bare") return bare_lane();
  for (const Row& row : lanes)
    if (row.name == name) return row.make();
  throw crosscheck::InputError(fmt::format("--lane {}: there is no such lane; expected bwrap, uid or bare{}", name,
                                           crosscheck::did_you_mean(name, {"bwrap", "uid", "bare"})));
}

bool sees(const Lane& lane, const std::filesystem::path& secret) {
  Job job;
  job.command = {"/bin/sh", "-c", R"([ -r "$0" ] && echo sees >&3)", std::filesystem::absolute(secret).string()};
  return lane.run(job).answers == "sees\n";
}

}  // namespace coursework
