// Which sources a program needs, from their include lines.
#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/pack.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

/// The quoted includes of a file, relative to `root` or beside the file.
std::vector<std::string> includes_of(const fs::path& root, const std::string& file) {
  std::vector<std::string> found;
  std::ifstream in(root / file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("#include \"")) continue;
    const std::string name = line.substr(10, line.find('"', 10) - 10);
    const fs::path beside = (fs::path(file).parent_path() / name).lexically_normal();
    found.push_back(fs::exists(root / beside) ? beside.generic_string() : name);
  }
  return found;
}

bool has_main(const fs::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("int main(")) return true;
  return false;
}

}  // namespace

std::vector<std::string> sources_needed(const fs::path& root, std::vector<std::string> first) {
  std::set<std::string> needed;
  std::vector<std::string> todo = std::move(first);
  auto want = [&](const fs::path& file) {
    if (fs::exists(root / file)) todo.push_back(file.generic_string());
  };
  while (!todo.empty()) {
    const std::string file = todo.back();
    todo.pop_back();
    if (!needed.insert(file).second) continue;
    for (const std::string& included : includes_of(root, file)) want(included);
    if (!file.ends_with(".h")) continue;
    want(fs::path(file).replace_extension(".cpp"));
    for (const auto& entry : fs::directory_iterator((root / file).parent_path())) {
      const fs::path beside = fs::relative(entry.path(), root);
      // a program of its own only uses the header
      if (beside.extension() != ".cpp" || has_main(entry.path()) ||
          fs::exists(fs::path(entry.path()).replace_extension(".h")))
        continue;
      const auto its = includes_of(root, beside.generic_string());
      if (std::find(its.begin(), its.end(), file) != its.end()) want(beside);
    }
  }
  return {needed.begin(), needed.end()};
}

}  // namespace coursework
