#include "tests/coursework/test/canaries.h"

#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace coursework {
namespace fs = std::filesystem;
namespace {

void look(const fs::path& top, std::map<std::string, std::string>& state) {
  for (const auto& entry : fs::recursive_directory_iterator(top)) {
    struct stat about {};
    lstat(entry.path().c_str(), &about);
    std::ostringstream text;
    text << std::oct << about.st_mode << ' ' << about.st_uid << ' ';
    if (entry.is_regular_file()) text << std::ifstream(entry.path()).rdbuf();
    state[entry.path().string()] = text.str();
  }
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

}  // namespace

Canaries::Canaries() : home_(0755), results_(0700), course_(0700), open_(home_.path().string() + ".canary") {
  for (const char* part : {"check", "python", "a1-steppers"})
    fs::copy(fs::path(COURSEWORK_FOLDER) / part, course_.path() / part, fs::copy_options::recursive);
  for (const char* name : {".bashrc", ".profile", "canary"}) write(home_.path() / name, "untouched");
  write(results_.path() / "results.json", "{}");
  write(open_, "untouched");
  setenv("CROSSCHECK_COURSEWORK", course_.path().c_str(), 1);
  before_ = state();
}

Canaries::~Canaries() {
  unsetenv("CROSSCHECK_COURSEWORK");
  fs::remove(open_);
}

fs::path Canaries::tests() const { return course_.path() / "a1-steppers"; }

std::map<std::string, std::string> Canaries::state() const {
  std::map<std::string, std::string> state;
  for (const fs::path& folder : {home_.path(), results_.path(), course_.path()}) look(folder, state);
  std::ostringstream content;
  content << std::ifstream(open_).rdbuf();
  state[open_.string()] = content.str();
  for (const char* folder : {"/tmp", "/var/tmp", "/dev/shm", "/run/lock", "/root", "/home"}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (entry.path().filename().string().starts_with("cheat")) state[entry.path().string()] = "left";
  }
  return state;
}

std::string Canaries::harm() const {
  std::string harm;
  const auto now = state();
  for (const auto& [file, content] : before_) {
    const auto found = now.find(file);
    if (found == now.end())
      harm += "removed: " + file + "\n";
    else if (found->second != content)
      harm += "changed: " + file + "\n";
  }
  for (const auto& [file, content] : now)
    if (!before_.contains(file)) harm += "added: " + file + "\n";
  return harm;
}

}  // namespace coursework
