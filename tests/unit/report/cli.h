// Calls the program in a temporary folder, one for each test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "mysim/base/process.h"

namespace crosscheck::testing_tools {
namespace fs = std::filesystem;

class Cli : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("crosscheck-cli-" + std::to_string(getpid()) + "-" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override {
    fs::remove_all(folder_);
    fs::remove(folder_.string() + ".lock");
  }

  ProgramResult call(std::vector<std::string> words) const {
    words.insert(words.begin(), CROSSCHECK_PROGRAM);
    return run_program(words, folder_,
                       {"ASAN_OPTIONS=detect_leaks=0", "CROSSCHECK_LOCK=" + (folder_.string() + ".lock")});
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
  /// Rows of a table without its provenance lines, which contain the date.
  static std::string rows(const fs::path& file) {
    std::istringstream in(read(file));
    std::string out;
    for (std::string line; std::getline(in, line);)
      if (!line.starts_with("#")) out += line + "\n";
    return out;
  }
  int files() const {
    return static_cast<int>(
        std::distance(fs::recursive_directory_iterator(folder_), fs::recursive_directory_iterator()));
  }
  fs::path folder_;
};

inline constexpr auto own_scene = R"(
question = "Does a scene that nobody shipped work everywhere?"
parameters = "Two masses on springs, picked at random."
[time]
duration = 0.4
samples = 20
step = 1e-3
window = 0.4
tolerance = 1e-3
method = "leapfrog"
[[particle]]
position = [0, 0, 0]
mass = 1
[[particle]]
position = [0.3, -0.4, 0]
mass = 0.5
[[particle]]
position = [0.3, -0.9, 0.1]
mass = 0.25
[[spring]]
ends = [0, 1]
stiffness = 150
[[spring]]
ends = [1, 2]
stiffness = 90
[pins]
particles = [0]
[gravity]
acceleration = [0, -9.81, 0]
)";

}  // namespace crosscheck::testing_tools
