// Experiments on a student's code, skipped if all tests passed. Before any compilation, the source is inspected.
#include "tests/coursework/grader/suspects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <regex>

#include "tests/coursework/check/judge.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/run.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

bool right_in(const TestRun& one, std::size_t i) { return judge(one.cases[i], one.answers[i]).right; }

/// True if all errors are as large as if a value had been stored in single precision: a few times 6e-8 of the largest
/// number. The wrong numbers themselves must be single-precision numbers, unlike errors due to a constant with six
/// digits.
bool single_beside(const Case& what, const Answer& answer) {
  if (answer.how != How::answered || answer.got.size() != what.expected.size()) return false;
  double size = 0;
  for (const double value : what.expected) size = std::max(size, std::abs(value));
  for (std::size_t i = 0; i < answer.got.size(); ++i) {
    const double off = std::abs(answer.got[i] - what.expected[i]);
    if (off <= what.tolerance) continue;
    if (!(off <= 1e-5 * size) || static_cast<double>(static_cast<float>(answer.got[i])) != answer.got[i]) return false;
  }
  return true;
}

/// True if there are wrong cases, and all of their wrong numbers are single-precision versions of the right ones.
/// False if a feature extracted from an answer is wrong, because it is not the student's own number.
bool all_single(const std::vector<TestRun>& of_part) {
  bool any = false;
  for (const TestRun& one : of_part)
    for (std::size_t i = 0; i < one.cases.size(); ++i) {
      if (right_in(one, i)) continue;
      if (one.test->reduce || !single_beside(one.cases[i], one.answers[i])) return false;
      any = true;
    }
  return any;
}

/// True if there are wrong cases, and in each of them the first wrong number equals the expected number truncated to an
/// integer. Ignores features extracted from answers, because they are not the student's own numbers.
bool all_whole(const std::vector<TestRun>& of_part) {
  bool any = false;
  for (const TestRun& one : of_part)
    for (std::size_t i = 0; i < one.cases.size(); ++i) {
      const Judged judged = judge(one.cases[i], one.answers[i]);
      if (judged.right || one.test->reduce) continue;
      if (judged.how != How::answered || judged.wrong_size || judged.got != std::trunc(judged.expected)) return false;
      any = true;
    }
  return any;
}

/// True if a call that was wrong after other calls is right as the first call of its program.
bool keeps_something(const Subject& subject, const std::vector<TestRun>& of_part) {
  for (const TestRun& one : of_part)
    for (std::size_t i = 1; i < one.cases.size(); ++i) {
      if (one.answers[i].how != How::answered || right_in(one, i)) continue;
      const Answer alone = run_calls(subject.sandbox, subject.program, {one.cases[i]}).at(0);
      return judge(one.cases[i], reduced(*one.test, one.cases[i], alone)).right;
    }
  return false;
}

/// True if `program` passes every wrong case after changed() has modified its inputs. Expected answers are unchanged.
template <class Changed>
bool mends(const Subject& subject, const fs::path& program, const std::vector<TestRun>& of_part, Changed changed) {
  for (const TestRun& one : of_part) {
    bool wrong = false;
    std::vector<Case> cases = one.cases;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (right_in(one, i)) continue;
      wrong = true;
      if (!changed(cases[i])) return false;
    }
    if (!wrong) continue;
    const std::vector<Answer> answers = run_calls(subject.sandbox, program, cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (!right_in(one, i) && !judge(one.cases[i], reduced(*one.test, one.cases[i], answers[i])).right) return false;
  }
  return true;
}

bool mends(const Subject& subject, const fs::path& program, const std::vector<TestRun>& of_part) {
  return mends(subject, program, of_part, [](Case&) { return true; });
}

constexpr double degree = std::numbers::pi / 180;

/// Trigonometric functions whose angles are multiplied by `factor`.
std::string trigonometry(double factor) {
  std::string source = "#define _GNU_SOURCE\nextern \"C\" {\n";
  for (const auto& [type, ending] : {std::pair{"double", ""}, std::pair{"float", "f"}}) {
    for (const char* name : {"sin", "cos", "tan"})
      source +=
          fmt::format("{0} __real_{1}{2}({0});\n{0} __wrap_{1}{2}({0} x) {{ return __real_{1}{2}({0}({3:a} * x)); }}\n",
                      type, name, ending, factor);
    source += fmt::format(
        "void __real_sincos{1}({0}, {0}*, {0}*);\nvoid __wrap_sincos{1}({0} x, {0}* s, {0}* c) "
        "{{ __real_sincos{1}({0}({2:a} * x), s, c); }}\n",
        type, ending, factor);
  }
  return source + "}\n";
}

bool takes_degrees(const Subject& subject, const std::vector<TestRun>& of_part, const std::string& file) {
  for (const double factor : {degree, 1 / degree})
    if (mends(subject, subject.program, of_part, [&](Case& what) {
          const std::vector<std::size_t> angles = angles_in(subject.own, what);
          for (const std::size_t i : angles) what.in[i] *= factor;
          return !angles.empty();
        }))
      return true;
  const auto source = subject.submission.files.find(file);
  static const std::regex asks("\\b(sin|cos|tan)f?\\s*\\(");
  if (source == subject.submission.files.end() || !std::regex_search(code_of(source->second), asks)) return false;
  int number = 0;
  for (const double factor : {degree, 1 / degree}) {
    const Built built = subject.builder.varied(
        subject.submission, std::string(of_part.front().test->part), subject.scratch / fmt::format("angle{}", number++),
        {"sin", "cos", "tan", "sincos", "sinf", "cosf", "tanf", "sincosf"}, trigonometry(factor));
    if (!built.program.empty() && mends(subject, built.program, of_part)) return true;
  }
  return false;
}

/// The source with double instead of float in declarations, functions and literals; empty if it contains no float.
/// Strings and comments are unchanged. `line` receives the line of the first float.
std::string in_double(const std::string& source, int& line) {
  static const std::regex single(R"(\bfloat\b|\b(sqrt|sin|cos|tan|fabs|pow|exp|hypot|fmax|fmin|floor|ceil)f\b|)"
                                 R"((\d\.\d*|\.\d+|\d[eE][+-]?\d+)[fF]\b)");
  const std::string code = code_of(source);
  std::string out;
  std::size_t done = 0;
  line = 0;
  for (std::sregex_iterator at(code.begin(), code.end(), single), end; at != end; ++at) {
    const auto place = static_cast<std::size_t>(at->position());
    if (line == 0)
      line =
          1 + static_cast<int>(std::count(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(place), '\n'));
    const std::string found = at->str();
    out += source.substr(done, place - done) + (found == "float" ? "double" : found.substr(0, found.size() - 1));
    done = place + found.size();
  }
  return line == 0 ? "" : out + source.substr(done);
}

/// The line of the first float in the file if all tests pass with double instead, otherwise 0. Finds intermediate
/// results rounded to single precision, which the digits of the answers do not reveal.
int line_of_single(const Subject& subject, const std::vector<TestRun>& of_part, const std::string& file) {
  const auto found = subject.submission.files.find(file);
  if (found == subject.submission.files.end()) return 0;
  int line = 0;
  Submission changed = subject.submission;
  changed.files[file] = in_double(found->second, line);
  if (line == 0) return 0;
  const Built built =
      subject.builder.varied(changed, std::string(of_part.front().test->part), subject.scratch / "double");
  return !built.program.empty() && mends(subject, built.program, of_part) ? line : 0;
}

/// The line of the first relevant integer division if all answers are right with floating-point divisions, otherwise 0.
int line_of_integer_division(const Subject& subject, const std::vector<TestRun>& of_part, const std::string& file) {
  constexpr std::size_t most = 4;  // one compilation each
  const auto found = subject.submission.files.find(file);
  if (found == subject.submission.files.end()) return 0;
  const std::string& source = found->second;
  std::vector<std::size_t> all = whole_divisions(source);
  if (all.empty()) return 0;
  if (all.size() > most) all.resize(most);
  int number = 0;
  const auto mended_by = [&](std::vector<std::size_t> places) {
    Submission changed = subject.submission;
    std::sort(places.rbegin(), places.rend());
    for (const std::size_t at : places) changed.files[file].insert(at, "/ 1.0 ");
    const Built built = subject.builder.varied(changed, std::string(of_part.front().test->part),
                                               subject.scratch / fmt::format("division{}", number++));
    return !built.program.empty() && mends(subject, built.program, of_part);
  };
  const auto line = [&](std::size_t at) {
    return 1 + static_cast<int>(std::count(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  };
  // tries each division alone first, because the source with all divisions changed does not compile if one is an index
  for (const std::size_t at : all)
    if (mended_by({at})) return line(at);
  return all.size() > 1 && mended_by(all) ? line(all.front()) : 0;
}

}  // namespace

std::vector<std::size_t> whole_divisions(const std::string& source) {
  static const std::regex division(
      R"(([A-Za-z_]\w*(?:\s*\.\s*size\s*\(\s*\))?|[0-9][\w.]*|\))\s*/(?![/*=])\s*([A-Za-z_]\w*(?:\.size\(\))?|[0-9][\w.]*|\())");
  const std::string code = code_of(source);
  const auto literal = [](const std::string& word) { return std::regex_match(word, std::regex("[0-9]+[uUlL]*")); };
  const auto whole = [&](const std::string& word) {
    if (literal(word) || word.ends_with(")")) return true;  // `division` matches no other call than size()
    if (std::isdigit(static_cast<unsigned char>(word[0]))) return false;
    return std::regex_search(code, std::regex("\\b(int|unsigned|long|short|size_t|ptrdiff_t)\\s+" + word + "\\b"));
  };
  std::vector<std::size_t> places;
  for (std::sregex_iterator at(code.begin(), code.end(), division), end; at != end; ++at) {
    const std::string left = (*at)[1], right = (*at)[2];
    const bool bracket = left == ")" || right == "(";
    if (bracket ? literal(left) || literal(right) : whole(left) && whole(right))
      places.push_back(static_cast<std::size_t>(at->position()) + (*at)[0].str().find('/', left.size()));
  }
  return places;
}

bool can_be_searched(const std::string& source) {
  // `largest` is twenty times the size of our solutions; the search for each word then takes seconds. `longest` is a
  // fifth of the length at which the stack overflows.
  constexpr std::size_t largest = 1u << 15, longest = 4000;
  if (source.size() > largest) return false;
  std::size_t blanks = 0, word = 0;
  for (const char c : code_of(source)) {
    const auto sign = static_cast<unsigned char>(c);
    blanks = std::isspace(sign) ? blanks + 1 : 0;
    word = std::isalnum(sign) || c == '_' || c == '.' ? word + 1 : 0;
    if (std::max(blanks, word) > longest) return false;
  }
  return true;
}

Remark suspected(const Subject& subject, const std::vector<TestRun>& of_part) {
  const bool python = subject.submission.python;
  if (all_single(of_part)) return {python ? "suspect.float32" : "suspect.float", {}};
  if (python && all_whole(of_part)) return {"suspect.whole", {}};
  if (keeps_something(subject, of_part)) return {"suspect.state", {}};
  for (const TestRun& one : of_part)  // skips crashes, which have their own message and must not be repeated
    for (const Answer& answer : one.answers)
      if (answer.how != How::answered) return {};
  const std::string file = subject.builder.handed_in(std::string(of_part.front().test->part));
  const auto source = subject.submission.files.find(file);
  if (source != subject.submission.files.end() && !can_be_searched(source->second)) return {};
  if (const int line = line_of_single(subject, of_part, file); line > 0)
    return {"suspect.float_line", {file, std::to_string(line)}};
  if (takes_degrees(subject, of_part, file)) return {"suspect.degrees", {}};
  if (const int line = line_of_integer_division(subject, of_part, file); line > 0)
    return {"suspect.integer", {file, std::to_string(line)}};
  return {};
}

}  // namespace coursework
