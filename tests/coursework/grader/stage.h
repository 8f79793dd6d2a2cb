// What a job reads and writes, as copies that only its user reaches: the grader's own folders stay closed to everybody.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/coursework/grader/lane.h"
#include "tests/coursework/grader/own_folder.h"

namespace coursework {

class Stage {
 public:
  /// For a job that runs under `user`; 0: under ours, and nothing is copied.
  Stage(const Job& job, unsigned user);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// An empty folder of the user's own, but for the copies.
  const std::filesystem::path& own() const { return own_.path(); }
  /// Where one of the job's folders stands.
  const std::filesystem::path& of(const std::filesystem::path& folder) const;
  /// The job's command with these places in it.
  std::vector<std::string> command() const;

  /// After the run: what is in the writable folder by now becomes ours and returns to where the job named it.
  void give_back();

 private:
  const Job& job_;
  OwnFolder own_;
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> places_;  // as the job names it, where it stands
  std::unique_ptr<Loan> loan_;
};

}  // namespace coursework
