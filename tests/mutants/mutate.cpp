// mutate MUTATIONS MYSIM FILE OUT: writes mysim's FILE with all its mutations in it, each behind a switch that is read
// at run time.

#include <fmt/format.h>

#include "experiments/regress/mutations.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"

using namespace crosscheck;

namespace {

/// The switch is read once, so that it costs no more than a branch.
std::string switched(const Mutation& m) {
  const std::string on =
      fmt::format("[]() -> bool {{ static const bool on = ::crosscheck::mutant(\"{}\"); return on; }}()", m.name);
  return m.right.ends_with(';') ? fmt::format("{{ if ({}) {{ {} }} else {{ {} }} }}", on, m.wrong, m.right)
                                : fmt::format("({} ? ({}) : ({}))", on, m.wrong, m.right);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  try {
    const std::string name = argv[3];
    std::string text = read_file(std::filesystem::path(argv[2]) / name, "a source of mysim");
    for (const Mutation& m : read_mutations(argv[1])) {
      if (m.file != name) continue;
      const size_t at = text.find(m.right);
      if (at == std::string::npos || text.find(m.right, at + 1) != std::string::npos)
        throw InputError(fmt::format("{}: expected its right text once in {}", m.name, name));
      text.replace(at, m.right.size(), switched(m));
    }
    write_file(argv[4], "#include \"tests/mutants/mutant.h\"\n" + text);
  } catch (const std::exception& error) {
    fmt::print(stderr, "mutate: {}\n", error.what());
    return 1;
  }
}
