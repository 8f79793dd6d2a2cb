#include <fmt/core.h>
#include <unistd.h>

#include <stdexcept>

#include "tests/coursework/grader/lanes.h"
#include "tests/coursework/grader/seccomp.h"
#include "tests/coursework/grader/spawn.h"
#include "tests/coursework/grader/stage.h"

namespace coursework {
namespace {

class UidLane final : public Lane {
 public:
  std::string_view name() const override { return "uid"; }
  std::string_view says() const override {
    return "each run is another user who reaches no folder of mode 0700 and no network, and of other processes no more "
           "than how they were called; what is open to all on this machine it can read.";
  }

  End run(const Job& job) const override {
    if (geteuid() != 0) throw std::runtime_error("it needs root, to become another user for each run");
    const BorrowedUser user;
    Stage stage(job, user.id());
    Start start;
    start.command = stage.command();
    start.environment = {"PATH=/usr/bin:/bin", "LANG=C", "HOME=" + stage.own().string(),
                         "TMPDIR=" + stage.own().string()};
    start.folder = job.writable.empty() ? stage.own() : stage.of(job.writable);
    start.user = user.id();
    // Nothing bounds what all its files hold together: without a folder of its own it makes none.
    start.filter = filter_program({job.limits.processes > 0, !job.writable.empty()});
    start.input = job.input;
    start.limits = job.limits;
    start.processes = job.limits.processes + 1;
    End end = classify(spawn(start), job.limits, false);
    stage.give_back();
    return end;
  }
};

}  // namespace

std::unique_ptr<Lane> uid_lane() { return std::make_unique<UidLane>(); }

}  // namespace coursework
