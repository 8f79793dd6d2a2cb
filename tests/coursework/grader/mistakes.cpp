#include "tests/coursework/grader/mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "mysim/base/errors.h"
#include "tests/coursework/check/judge.h"
#include "tests/coursework/grader/parallel.h"
#include "tests/coursework/grader/run.h"

namespace coursework {
namespace fs = std::filesystem;
using crosscheck::InputError;
namespace {

class Lines {
 public:
  explicit Lines(const fs::path& file) : file_(file), in_(file) {
    if (!in_) throw InputError(fmt::format("{}: cannot be read", file.string()));
  }
  bool next(std::string& line) {
    if (!std::getline(in_, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    ++number_;
    return true;
  }
  InputError wrong(const std::string& what) const {
    return InputError(fmt::format("{}:{}: {}", file_.string(), number_, what));
  }
  /// The lines up to the line `end`, without the last line feed.
  std::string up_to(const std::string& end) {
    std::string text, line;
    const int begin = number_;
    for (bool first = true; next(line); first = false) {
      if (line == end) return text;
      text += (first ? "" : "\n") + line;
    }
    throw wrong(fmt::format("expected '{}' that ends the text from line {}", end, begin));
  }

 private:
  fs::path file_;
  std::ifstream in_;
  int number_ = 0;
};

bool heading(const std::string& line) { return line.size() > 2 && line.front() == '[' && line.back() == ']'; }
std::string inside(const std::string& line) { return line.substr(1, line.size() - 2); }

/// Parses "key: rest" into `value`; returns false for another key.
bool value_of(const std::string& key, const std::string& line, std::string& value) {
  if (line.rfind(key + ":", 0) != 0) return false;
  const std::size_t at = line.find_first_not_of(' ', key.size() + 1);
  value = at == std::string::npos ? "" : line.substr(at);
  return true;
}

bool nothing(const std::string& line) { return line.find_first_not_of(" \t") == std::string::npos || line[0] == '#'; }

}  // namespace

std::vector<Mistake> read_mistakes(const fs::path& file) {
  Lines lines(file);
  std::vector<Mistake> mistakes;
  bool open = false;  // the text of the last mistake has not been read yet
  for (std::string line, value; lines.next(line);) {
    if (nothing(line)) continue;
    if (heading(line)) {
      if (open) throw lines.wrong(fmt::format("expected '<<<<' and the text of [{}] first", mistakes.back().name));
      for (const Mistake& other : mistakes)
        if (other.name == inside(line)) throw lines.wrong(fmt::format("[{}] stands there twice", other.name));
      mistakes.push_back({inside(line), {}, {}, {}, {}});
      open = true;
    } else if (!open) {
      throw lines.wrong("expected a heading [name-of-mistake]");
    } else if (value_of("part", line, value)) {
      mistakes.back().part = value;
    } else if (value_of("loses", line, value)) {
      std::istringstream ids(value);
      for (std::string id; ids >> id;) mistakes.back().loses.push_back(id);
    } else if (line == "<<<<") {
      if (mistakes.back().part.empty()) throw lines.wrong("expected 'part: NAME' before the text");
      mistakes.back().find = lines.up_to("====");
      mistakes.back().replace = lines.up_to(">>>>");
      if (mistakes.back().find.empty()) throw lines.wrong("the text to be replaced is empty");
      open = false;
    } else {
      throw lines.wrong(fmt::format("expected 'part:', 'loses:' or '<<<<', got '{}'", line));
    }
  }
  if (open) throw lines.wrong(fmt::format("the text of [{}] is missing", mistakes.back().name));
  return mistakes;
}

std::vector<std::pair<std::string, std::string>> read_pairs(const fs::path& file) {
  Lines lines(file);
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::string line, value; lines.next(line);) {
    if (nothing(line)) continue;
    if (heading(line)) {
      pairs.emplace_back();
    } else if (!pairs.empty() && value_of("a", line, value)) {
      pairs.back().first = value;
    } else if (!pairs.empty() && value_of("b", line, value)) {
      pairs.back().second = value;
    } else {
      throw lines.wrong("expected a heading [name], 'a: NAME' or 'b: NAME'");
    }
  }
  for (const auto& [a, b] : pairs)
    if (a.empty() || b.empty()) throw lines.wrong("expected 'a: NAME' and 'b: NAME' under each heading");
  return pairs;
}

std::string with_mistake(const std::string& source, const Mistake& mistake) {
  const std::size_t at = source.find(mistake.find);
  if (at == std::string::npos || source.find(mistake.find, at + 1) != std::string::npos)
    throw InputError(fmt::format("[{}]: its text must stand exactly once in '{}'; it is {}", mistake.name, mistake.part,
                                 at == std::string::npos ? "not there" : "there more than once"));
  return source.substr(0, at) + mistake.replace + source.substr(at + mistake.find.size());
}

std::vector<Mistake> mistakes_of(const Assignment& assignment) {
  return read_mistakes(assignment.folder() / "mistakes.txt");
}

namespace {

double largest(const Numbers& numbers) {
  double size = 0;
  for (const double value : numbers)
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return size;
}

bool all_right(const TestRun& one) {
  for (std::size_t i = 0; i < one.cases.size(); ++i)
    if (!judge(one.cases[i], one.answers[i]).right) return false;
  return true;
}

bool answers_alike(const TestRun& one, const std::filesystem::path& program, const Sandbox& trusted) {
  const std::vector<Answer> answers = run_calls(trusted, program, one.cases);
  for (std::size_t i = 0; i < one.cases.size(); ++i)
    if (!agree(one.cases[i], one.answers[i], reduced(*one.test, one.cases[i], answers[i]))) return false;
  return true;
}

/// Compares number i of two answers. Shares of the same total are equal if their counts are. Shares of different
/// totals, as for cloths of different sizes, are equal if both are strictly between 0 and 1.
bool same_number(const Answer& a, const Answer& b, std::size_t i, double tolerance) {
  const double of = i < a.of.size() ? a.of[i] : 0, other = i < b.of.size() ? b.of[i] : 0;
  const double apart = std::abs(a.got[i] - b.got[i]);
  const auto some = [](double share) { return share > 0 && share < 1; };
  if (of > 0 && of == other) return apart <= 0.5 / of;
  return apart <= tolerance || (of > 0 && other > 0 && some(a.got[i]) && some(b.got[i]));
}

}  // namespace

Answer reduced(const Test& test, const Case& what, Answer raw) {
  if (!test.reduce || raw.how != How::answered) return raw;
  Found found = test.reduce(what, raw.got);
  raw.got = std::move(found.got), raw.of = std::move(found.of);
  if (raw.got.empty() && !what.expected.empty()) raw.how = How::undecided;
  return raw;
}

bool agree(const Case& what, const Answer& student, const Answer& mistake) {
  if (student.how != mistake.how) return false;
  if (student.how != How::answered) return true;
  if (student.got.size() != mistake.got.size()) return false;
  if (judge(what, student).right != judge(what, mistake).right) return false;
  const double right = largest(what.expected), wrong = largest(mistake.got);
  const double tolerance = what.tolerance * (right > 0 ? std::max(1.0, wrong / right) : 1.0);
  for (std::size_t i = 0; i < student.got.size(); ++i) {
    const bool finite = std::isfinite(student.got[i]);
    if (finite != std::isfinite(mistake.got[i])) return false;
    if (finite && !same_number(student, mistake, i, tolerance)) return false;
  }
  return true;
}

std::vector<std::string> likely_causes(const Assignment& assignment, const std::string& part,
                                       const std::vector<TestRun>& runs, const std::vector<Mistake>& known,
                                       const Builder& builder, const Sandbox& trusted, unsigned jobs) {
  // failed tests run first, because they distinguish mistakes best
  std::vector<const TestRun*> order;
  for (const TestRun& one : runs) order.push_back(&one);
  std::stable_partition(order.begin(), order.end(), [](const TestRun* one) { return !all_right(*one); });
  std::vector<const Mistake*> candidates;
  for (const Mistake& mistake : known)
    if (mistake.part == part) candidates.push_back(&mistake);
  const std::string solution = content_of_file(solution_of(assignment, builder, part));
  std::vector<char> fits(candidates.size(), 0);
  parallel_for(candidates.size(), jobs, [&](std::size_t i) {
    const std::filesystem::path program = builder.ours(part, with_mistake(solution, *candidates[i]));
    fits[i] = std::all_of(order.begin(), order.end(),
                          [&](const TestRun* one) { return answers_alike(*one, program, trusted); });
  });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (fits[i]) names.push_back(candidates[i]->name);
  if (names.size() > 3) names.clear();
  return names;
}

std::string cause_text(const Texts& common, const Texts& own, const std::vector<std::string>& names) {
  std::string cause;
  for (const std::string& name : names) {
    const std::string behaves = own.has("mistake." + name) ? own.of("mistake." + name) : name;
    cause +=
        cause.empty() ? common.fill(names.size() == 1 ? "cause" : "either", behaves) : " " + common.fill("or", behaves);
  }
  return cause.empty() ? common.of("no_cause") : cause;
}

}  // namespace coursework
