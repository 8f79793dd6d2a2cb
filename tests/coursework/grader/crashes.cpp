#include "tests/coursework/grader/crashes.h"

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/run.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

constexpr const char* addr2line = "/usr/bin/addr2line";
constexpr std::size_t most_addresses = 40;

/// Replaces all white space by single blanks, because messages are broken into lines.
std::string in_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

/// Converts the unsigned representation of a negative index back.
long signed_of(const std::string& digits) { return static_cast<long>(std::strtoull(digits.c_str(), nullptr, 10)); }

/// Parses "PATH:LINE"; returns false if `place` is not a source line.
bool parse_place(const std::string& place, fs::path& path, int& line) {
  static const std::regex form("(/.*):([0-9]{1,6})( .*)?");
  std::smatch found;
  constexpr std::size_t longest = 4096;  // std::regex needs stack per character, and #line can name any file
  if (place.size() > longest || !std::regex_match(place, found, form)) return false;
  path = found[1].str();
  line = std::atoi(found[2].str().c_str());
  return line > 0;
}

/// Finds the first place outside of libraries and signal handlers. Returns false if this place is not in one of the
/// student's files.
bool first_of_student(std::istream& places, Crash& crash) {
  for (std::string place; std::getline(places, place);) {
    fs::path path;
    int line = 0;
    if (!parse_place(place, path, line)) continue;
    path = path.lexically_normal();
    crash.file = path.filename().string(), crash.line = line;
    if (path.string().rfind("/usr/", 0) == 0 || crash.file == "child_main.cpp") continue;
    return path.string().rfind(std::string(student_folder) + "/", 0) == 0;
  }
  return false;
}

}  // namespace

Crash crash_in(const std::string& captured, std::vector<std::string>& addresses) {
  Crash crash;
  const std::string text = in_one_line(captured);
  static const std::regex subscript(
      "attempt to subscript container with out-of-bounds index ([0-9]{1,20}), but container only holds "
      "([0-9]{1,20}) elements");
  static const std::regex array("index (-?[0-9]{1,20}) out of bounds for type '[^']{1,200}\\[([0-9]{1,20})\\]'");
  std::smatch found;
  if (std::regex_search(text, found, subscript)) {
    crash.why = Crash::Why::index, crash.index = signed_of(found[1]), crash.size = signed_of(found[2]);
    if (crash.size == 0) crash.why = Crash::Why::empty;
  } else if (std::regex_search(text, found, array)) {
    crash.why = Crash::Why::index, crash.index = std::atol(found[1].str().c_str()), crash.size = signed_of(found[2]);
  } else if (text.find("attempt to access an element in an empty container") != std::string::npos) {
    crash.why = Crash::Why::empty;
  } else if (text.find("attempt to dereference a past-the-end iterator") != std::string::npos) {
    crash.why = Crash::Why::iterator;
  }
  const std::size_t at = captured.rfind("\nat 0x");
  std::istringstream words(at == std::string::npos ? "" : captured.substr(at + 3));
  static const std::regex address("0x[0-9a-f]{1,16}");
  for (std::string word; words >> word && std::regex_match(word, address) && addresses.size() < most_addresses;)
    addresses.push_back(word);
  return crash;
}

std::optional<Crash> crash_of(const Sandbox& sandbox, const fs::path& program, const std::vector<Case>& cases) {
  Limits limits = limits_for(0);
  limits.cpu = 5, limits.wall = 60;
  std::string captured;
  const std::vector<Answer> answers = run_calls(sandbox, program, cases, limits, nullptr, &captured);
  const auto last = std::find_if(answers.begin(), answers.end(), [](const Answer& a) { return a.how == How::crashed; });
  if (last == answers.end() || !fs::exists(addr2line)) return {};
  std::vector<std::string> addresses;
  Crash crash = crash_in(captured, addresses);
  crash.which = static_cast<std::size_t>(last - answers.begin());
  if (addresses.empty()) return {};
  // runs in the sandbox, because the student controls the line tables that addr2line parses
  Job job{.command = {fs::canonical(addr2line).string(), "-i", "-e", program.string()},
          .readable = {program.parent_path()}};
  job.command.insert(job.command.end(), addresses.begin(), addresses.end());
  const End end = sandbox.run(job);
  std::istringstream places(end.captured_output);
  if (end.how != End::How::exited || end.code != 0 || !first_of_student(places, crash)) return {};
  return crash;
}

std::string crash_text(const Texts& common, const Crash& crash, std::size_t told) {
  const std::string line = std::to_string(crash.line);
  std::string text;
  switch (crash.why) {
    case Crash::Why::index:
      text = common.fill("crash.index", crash.file, line, std::to_string(crash.index), std::to_string(crash.size));
      break;
    case Crash::Why::empty:
      text = common.fill("crash.empty", crash.file, line);
      break;
    case Crash::Why::iterator:
      text = common.fill("crash.iterator", crash.file, line);
      break;
    case Crash::Why::other:
      text = common.fill("crash.line", crash.file, line);
      break;
  }
  if (crash.which == told) return text;
  return text + " " + common.fill("crash.case", std::to_string(crash.which + 1));
}

}  // namespace coursework
