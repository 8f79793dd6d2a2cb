// A caching sandbox, because the corpus asks the same programs the same questions thousands of times.
#pragma once

#include <fmt/ranges.h>

#include <map>
#include <mutex>

#include "tests/coursework/grader/sandbox.h"

namespace coursework {

/// Caches the answers of `inner` by program and input. Ignores the first line of the input, which is the token and
/// always differs. Never caches jobs that write.
class RecallingSandbox : public Sandbox {
 public:
  explicit RecallingSandbox(std::unique_ptr<Sandbox> inner) : inner_(std::move(inner)) {}
  std::string_view name() const override { return inner_->name(); }
  std::string_view says() const override { return inner_->says(); }

  End run(const Job& job) const override {
    const std::size_t line = job.input.find('\n');
    if (!job.writable.empty() || line == std::string::npos) return inner_->run(job);
    const std::string token = job.input.substr(0, line);
    const std::string question = fmt::format("{}", fmt::join(job.command, " ")) + job.input.substr(line);
    {
      const std::lock_guard<std::mutex> lock(guard_);
      if (const auto known = known_.find(question); known != known_.end()) return told(known->second, token);
    }
    End end = inner_->run(job);
    const std::lock_guard<std::mutex> lock(guard_);
    known_[question] = {token, end};
    return end;
  }

  void forget() {
    const std::lock_guard<std::mutex> lock(guard_);
    known_.clear();
  }

 private:
  struct Known {
    std::string token;
    End end;
  };
  static End told(const Known& known, const std::string& token) {
    End end = known.end;
    if (const std::size_t at = end.answers.rfind(known.token); at != std::string::npos)
      end.answers.replace(at, token.size(), token);
    return end;
  }

  std::unique_ptr<Sandbox> inner_;
  mutable std::mutex guard_;
  mutable std::map<std::string, Known> known_;
};

}  // namespace coursework
