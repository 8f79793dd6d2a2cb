// write_additions SOURCE OUT FILE...: writes the files of additions below OUT.
#include <fmt/core.h>

#include "tests/unit/report/adding/additions.h"

int main(int argc, char** argv) {
  using namespace crosscheck::testing_tools;
  if (argc < 4) return 2;
  try {
    for (int i = 3; i < argc; ++i) write_addition(read_addition(argv[i]), argv[1], argv[2]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "write_additions: {}\n", error.what());
    return 1;
  }
}
