// Prints the name of the sandbox that is chosen on this machine, or why no sandbox is available.

#include <cstdio>
#include <stdexcept>

#include "tests/coursework/grader/sandbox.h"

int main() try {
  std::printf("%s\n", coursework::choose_sandbox("", false)->name().data());
} catch (const std::runtime_error& error) {
  std::printf("%s\n", error.what());
  return 1;
}
