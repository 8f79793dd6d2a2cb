// Prints which sandbox would be chosen here, or why there is none.

#include <cstdio>
#include <stdexcept>

#include "tests/coursework/grader/sandbox.h"

int main() try {
  std::printf("%s\n", coursework::choose_sandbox("", false)->name().data());
} catch (const std::runtime_error& error) {
  std::printf("%s\n", error.what());
  return 1;
}
