// Reads a file of mutations.
#include "experiments/regress/mutations.h"

#include <fmt/format.h>

#include <fstream>

#include "mysim/base/errors.h"

namespace crosscheck {

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
      all.push_back({line.substr(3), "", {}, "", ""});
      text = nullptr;
    } else if (all.empty() || (!text && line.empty())) {
      continue;  // what stands before the first
    } else if (line.starts_with("file: ")) {
      all.back().file = after(line);
    } else if (line.starts_with("cause: ")) {
      all.back().causes.push_back(after(line));
    } else if (line == "right:") {
      text = &all.back().right;
    } else if (line == "wrong:") {
      text = &all.back().wrong;
    } else if (text) {
      if (!line.empty()) *text += (text->empty() ? "" : "\n") + line;
    } else {
      throw InputError(fmt::format("{}:{}: expected file:, cause:, right: or wrong:", file.string(), number));
    }
  }
  for (const Mutation& m : all)
    if (m.file.empty() || m.right.empty() || m.wrong.empty() || m.right == m.wrong)
      throw InputError(
          fmt::format("{}: {}: expected a file, and a right and a wrong text that differ", file.string(), m.name));
  return all;
}

}  // namespace crosscheck
