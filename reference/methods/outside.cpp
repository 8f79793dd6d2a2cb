// External programs and trajectories: only samples are available, and nothing is known about the states between them.

#include <fmt/format.h>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/names.h"
#include "mysim/base/text.h"
#include "reference/method.h"
#include "reference/protocol/exec_engine.h"
#include "reference/protocol/trajectory_files.h"
#include "reference/which_rule.h"

namespace crosscheck {
namespace {

std::string fingerprint_of(const std::filesystem::path& file) {
  return fmt::format("{:016x}", Fnv1a::of(read_file(file, "a program or a trajectory that can be read")));
}

}  // namespace

Method exec_method(const std::string& text) {
  if (!is_printable(text))
    throw InputError(
        fmt::format("method exec:{}: expected a path without control and hidden characters", shell_quote(text)));
  const auto program = find_program(text);
  Method method{.name = std::string(program_prefix) + text,
                .what = "an external program that implements the engine protocol",
                .rule = "",
                .engine = [program](const Scene& scene, const Run& run,
                                    Observer& observer) { return run_outside_engine(program, scene, run, observer); },
                .contact = ContactLoss::sampled,
                .fingerprint = fingerprint_of(program.path)};
  identify_by_runs(method);
  return method;
}

Method trajectory_method(const std::filesystem::path& file, const Scene& scene, const Run& run) {
  Frames frames{read_positions(file, scene, run), {}};
  return {.name = "file:" + require_name(file.filename().string(), "--trajectory"),
          .what = "a trajectory from a file",
          .rule = "",
          .engine =
              [frames = std::move(frames)](const Scene& s, const Run& r, Observer& observer) {
                Outcome out;
                replay(frames, s, r, observer, out);
                return out;
              },
          .contact = ContactLoss::sampled,
          .fingerprint = fingerprint_of(file)};
}

}  // namespace crosscheck
