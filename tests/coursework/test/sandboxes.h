// The sandboxes available here, for tests that hold in each.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "tests/coursework/grader/sandbox.h"
#include "tests/coursework/grader/staging.h"

namespace coursework {

/// Makes this process the new parent of processes that outlive a run.
void adopt_orphans();
/// Kills the processes that have outlived runs since adopt_orphans(), and returns their names.
std::set<std::string> leftover_processes();

/// A test that runs in each sandbox. If a sandbox is unavailable, the test is skipped with the reason.
class SandboxTest : public testing::TestWithParam<std::string> {
 protected:
  SandboxTest() : open_(0711) {
    adopt_orphans();
    try {
      sandbox_ = choose_sandbox(GetParam(), GetParam() == "bare");
    } catch (const std::runtime_error& error) {
      why_ = error.what();
    }
  }
  void SetUp() override {
    if (!sandbox_) GTEST_SKIP() << why_;
  }

  /// A folder that programs in all sandboxes can access, unlike the folder of this build's programs.
  std::filesystem::path open_folder(const std::string& name) const {
    const auto folder = open_.path() / name;
    std::filesystem::create_directory(folder);
    std::filesystem::permissions(folder, std::filesystem::perms(0755));
    return folder;
  }
  Job job(const std::string& what, const std::string& amount) const {
    const auto folder = open_folder("program");
    std::filesystem::copy_file(SANDBOX_PROGRAM, folder / "program", std::filesystem::copy_options::skip_existing);
    Job made;
    made.command = {(folder / "program").string(), what, amount};
    made.readable = {folder};
    return made;
  }
  Job shell(const std::string& script) const {
    Job made;
    made.command = {"/bin/sh", "-c", script};
    return made;
  }
  const Sandbox& sandbox() const { return *sandbox_; }

 private:
  PrivateFolder open_;
  std::unique_ptr<Sandbox> sandbox_;
  std::string why_;
};

}  // namespace coursework
