#include <unistd.h>

#include "tests/coursework/grader/lanes.h"
#include "tests/coursework/grader/seccomp.h"
#include "tests/coursework/grader/spawn.h"
#include "tests/coursework/grader/stage.h"

namespace coursework {
namespace {

class BareLane final : public Lane {
 public:
  std::string_view name() const override { return "bare"; }
  std::string_view says() const override {
    return "time, memory, processes and output are limited; nothing else is kept out: it can read and change what you "
           "can.";
  }

  End run(const Job& job) const override {
    Stage stage(job, 0);
    Start start;
    start.command = job.command;
    start.environment = {"PATH=/usr/bin:/bin", "LANG=C", "HOME=" + stage.own().string(),
                         "TMPDIR=" + stage.own().string()};
    start.folder = job.writable.empty() ? stage.own() : job.writable;
    // The filter only bounds what it starts here: a limit on processes would count all that its user, you, runs.
    start.filter = job.limits.processes > 0 ? std::string() : none_;
    start.input = job.input;
    start.limits = job.limits;
    start.processes = -1;
    End end = classify(spawn(start), job.limits, false);
    stage.give_back();
    return end;
  }

 private:
  std::string none_ = filter_program({.creates = true});
};

}  // namespace

std::unique_ptr<Lane> bare_lane() { return std::make_unique<BareLane>(); }

}  // namespace coursework
