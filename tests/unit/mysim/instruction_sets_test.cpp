// What is compiled for one instruction set is no other code's.

#include <gtest/gtest.h>

#include <sstream>

#include "mysim/base/process.h"

namespace crosscheck::testing_tools {
namespace {

/// Code for a newer machine must not be what the linker takes for every machine: objects compiled for an instruction
/// set share no function with others. The objects of a list hold something of this name.
void expect_own_code(const char* list, const char* name, int expected) {
  std::istringstream objects(list);
  int count = 0;
  for (std::string object; std::getline(objects, object, '|'); ++count) {
    const std::string listed = run_program({"nm", "-C", object}, ".", {}).out;
    ASSERT_NE(listed.find(name), std::string::npos) << object;
    std::istringstream lines(listed);
    for (std::string line; std::getline(lines, line);) {
      if (line.find("DW.ref.") != std::string::npos) continue;  // data of the sanitizers: no instructions
      const char kind = line.size() > 17 ? line[17] : ' ';
      EXPECT_EQ(std::string("WwVvu").find(kind), std::string::npos) << object << ": " << line;
      EXPECT_EQ(line.find("std::"), std::string::npos) << object << ": " << line;
    }
  }
  EXPECT_EQ(count, expected);
}

TEST(Objects, OfTheSweepKeepTheirCodeToThemselves) { expect_own_code(CROSSCHECK_SWEEP_OBJECTS, "double_kernel", 3); }
TEST(Objects, OfNetworksKeepTheirCodeToThemselves) { expect_own_code(CROSSCHECK_NETWORK_OBJECTS, "hooke_", 3); }
TEST(Objects, OfMultigridKeepTheirCodeToThemselves) { expect_own_code(CROSSCHECK_MULTIGRID_OBJECTS, "set_", 3); }

}  // namespace
}  // namespace crosscheck::testing_tools
