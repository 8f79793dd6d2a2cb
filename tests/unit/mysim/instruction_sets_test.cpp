#include <gtest/gtest.h>

#include <sstream>

#include "mysim/base/process.h"

namespace crosscheck::testing_tools {
namespace {

/// Objects compiled for one instruction set must share no function with others, because the linker keeps only one
/// version, which might be the one for a newer machine. Each object must contain the table of its functions.
TEST(InstructionSets, OfAnInstructionSetKeepTheirCodeToThemselves) {
  std::istringstream objects(CROSSCHECK_KERNEL_OBJECTS);
  int count = 0;
  for (std::string object; std::getline(objects, object, '|'); ++count) {
    const std::string listed = run_program({CROSSCHECK_NM, "-C", object}, ".", {}).out;
    EXPECT_TRUE(listed.find("double_kernel") != std::string::npos || listed.find("kernels_of") != std::string::npos)
        << object;
    std::istringstream lines(listed);
    for (std::string line; std::getline(lines, line);) {
      if (line.find("DW.ref.") != std::string::npos) continue;  // data of the sanitizers, not instructions
      const char kind = line.size() > 17 ? line[17] : ' ';
      EXPECT_EQ(std::string("WwVvu").find(kind), std::string::npos) << object << ": " << line;
      EXPECT_EQ(line.find("std::"), std::string::npos) << object << ": " << line;
    }
  }
#ifdef __x86_64__
  EXPECT_EQ(count, 9);
#else
  EXPECT_EQ(count, 3);
#endif
}

}  // namespace
}  // namespace crosscheck::testing_tools
