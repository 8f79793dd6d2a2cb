// mutate MUTATIONS MYSIM FILE OUT: writes mysim's FILE with all its mutations, each behind a switch that is read at run
// time.

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"

using namespace crosscheck;

namespace {

struct Mutation {
  std::string name, file;    // file: below mysim/
  std::string right, wrong;  // an expression, or statements that end in ';'
};

/// Reads the mutations in a file. Throws InputError "FILE:LINE: expected ...".
std::vector<Mutation> read_mutations(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("{}: expected a file that can be read", file.string()));
  std::vector<Mutation> all;
  std::string* text = nullptr;
  int number = 0;
  const auto after = [](const std::string& line) { return line.substr(line.find(": ") + 2); };
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with("== ")) {
      all.push_back({line.substr(3), "", "", ""});
      text = nullptr;
    } else if (all.empty() || (!text && line.empty())) {
      continue;  // text before the first mutation
    } else if (line.starts_with("file: ")) {
      all.back().file = after(line);
    } else if (line == "right:") {
      text = &all.back().right;
    } else if (line == "wrong:") {
      text = &all.back().wrong;
    } else if (text) {
      if (!line.empty()) *text += (text->empty() ? "" : "\n") + line;
    } else {
      throw InputError(fmt::format("{}:{}: expected file:, right: or wrong:", file.string(), number));
    }
  }
  for (const Mutation& m : all)
    if (m.file.empty() || m.right.empty() || m.wrong.empty() || m.right == m.wrong)
      throw InputError(
          fmt::format("{}: {}: expected a file, and a right and a wrong text that differ", file.string(), m.name));
  return all;
}

/// Both versions behind a switch, which is read once so that it costs no more than a branch.
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
