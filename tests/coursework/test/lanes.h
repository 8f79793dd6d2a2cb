// The lanes that can be had here, for tests that hold in each.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "tests/coursework/grader/lane.h"
#include "tests/coursework/grader/own_folder.h"

namespace coursework {

/// From now on what outlives a run becomes this process's child.
void adopt_orphans();
/// Names of what has outlived the runs since then; it is ended.
std::set<std::string> left_running();

/// A test of each lane; skipped, with the lane's reason, where there is none.
class LaneTest : public testing::TestWithParam<std::string> {
 protected:
  LaneTest() : open_(0711) {
    adopt_orphans();
    try {
      lane_ = choose_lane(GetParam(), GetParam() == "bare");
    } catch (const std::runtime_error& error) {
      why_ = error.what();
    }
  }
  void SetUp() override {
    if (!lane_) GTEST_SKIP() << why_;
  }

  /// A folder that programs in all lanes can be shown; the programs of this build may lie where only we reach them.
  std::filesystem::path open_folder(const std::string& name) const {
    const auto folder = open_.path() / name;
    std::filesystem::create_directory(folder);
    std::filesystem::permissions(folder, std::filesystem::perms(0755));
    return folder;
  }
  Job job(const std::string& what, const std::string& amount) const {
    const auto folder = open_folder("program");
    std::filesystem::copy_file(LANE_PROGRAM, folder / "program", std::filesystem::copy_options::skip_existing);
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
  const Lane& lane() const { return *lane_; }

 private:
  OwnFolder open_;
  std::unique_ptr<Lane> lane_;
  std::string why_;
};

}  // namespace coursework
