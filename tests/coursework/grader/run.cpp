#include "tests/coursework/grader/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <map>
#include <random>
#include <sstream>

#include "tests/coursework/grader/python.h"

namespace coursework {
namespace {

std::string fresh_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

std::string signal_name(int signal) {
  static const std::map<int, const char*> names = {
      {SIGSEGV, "segmentation fault"},
      {SIGABRT, "aborted"},
      {SIGFPE, "division of an integer by zero"},
      {SIGBUS, "bus error"},
      {SIGILL, "illegal instruction, as where a function ends without return"},
      {SIGSYS, "a call to the system that is not allowed here"},
      {SIGXFSZ, "wrote too large a file"}};
  const auto found = names.find(signal);
  return found == names.end() ? fmt::format("signal {}", signal) : found->second;
}

Answer ending(const End& end, const Limits& limits) {
  switch (end.how) {
    case End::How::signal:
      return {How::crashed, {}, signal_name(end.code)};
    case End::How::cpu:
      return {How::out_of_time, {}, fmt::format("{:.3g} s", limits.cpu)};
    case End::How::wall:
      return {How::waiting, {}, fmt::format("{:.3g} s", limits.wall)};
    case End::How::idle:
      return {How::waiting, {}, fmt::format("{:.3g} s", limits.idle)};
    case End::How::answers:
      return {How::too_much_answered, {}, fmt::format("{} MB", limits.answers >> 10)};
    case End::How::memory:
      return {How::out_of_memory, {}, fmt::format("{} MB", limits.memory)};
    case End::How::output:
      return {How::too_much_output, {}, {}};
    case End::How::exited:
      break;
  }
  return {How::no_token, {}, {}};
}

/// Limit on the length of messages of tests/coursework/check/child_main.cpp. Longer messages are forged; they are cut.
constexpr std::size_t longest_said = 200;
constexpr std::size_t longest_name = 40;

/// Parses counts: "KEY n1 n2", or, with `names`, "NAME n1 NAME n2 ...". Names consist of letters, digits, _ and .;
/// counts are small. The text is untrusted: returns an empty list for anything else.
std::vector<std::pair<std::string, long>> counts_in(const std::string& text, bool names) {
  std::vector<std::pair<std::string, long>> counts;
  std::istringstream words(text);
  for (std::string name, number; (!names || words >> name) && words >> number;) {
    const bool good = name.size() <= longest_name &&
                      std::all_of(name.begin(), name.end(),
                                  [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.'; }) &&
                      number.size() <= 12 && number.find_first_not_of("0123456789") == std::string::npos;
    if (!good || counts.size() == 8) return {};
    counts.emplace_back(name, std::stol(number));
  }
  return counts;
}

/// Parses "answer COUNT n1 n2 ..."; returns false for anything else.
bool parse_answer(const std::string& line, Numbers& numbers) {
  const char* at = line.c_str() + 7;  // after "answer "
  char* end = nullptr;
  if (*at < '0' || *at > '9') return false;
  const unsigned long count = std::strtoul(at, &end, 10);
  if (count > line.size()) return false;
  for (at = end; *at == ' '; at = end) {
    const double value = std::strtod(at + 1, &end);
    if (end == at + 1 || at[1] == ' ' || numbers.size() == count) return false;
    numbers.push_back(value);
  }
  return *at == '\0' && static_cast<std::size_t>(at - line.c_str()) == line.size() && numbers.size() == count;
}

}  // namespace

std::vector<Answer> answers_of(const End& end, const std::string& token, std::size_t count, const Limits& limits) {
  std::vector<Answer> answers;
  bool finished = false, malformed = false;
  Answer rest = ending(end, limits);
  std::size_t begin = 0;
  for (std::size_t stop; (stop = end.answers.find('\n', begin)) != std::string::npos; begin = stop + 1) {
    const std::string line = end.answers.substr(begin, stop - begin);
    Answer answer{How::answered, {}, {}};
    malformed = malformed || finished;
    if (line == "token " + token && answers.size() == count) {
      finished = true;
      continue;
    }
    // messages that announce the end; each is valid only if the process then ended accordingly
    if (line.rfind("slow", 0) == 0 && rest.how == How::out_of_time) {
      rest.counts = counts_in(line.substr(4), true);
      begin = end.answers.size();
      break;
    }
    if (line == "recursion" && end.how == End::How::signal && end.code == SIGSEGV) {
      rest = {How::recursion, {}, {}};
      begin = end.answers.size();
      break;
    }
    if (line.rfind("unusable ", 0) == 0) {
      const std::size_t key = std::min(line.find(' ', 9), line.size());
      answer = {How::unusable, {}, line.substr(9, std::min(key - 9, longest_name)), counts_in(line.substr(key), false)};
    } else if (line.rfind("threw ", 0) == 0) {
      answer = {How::threw, {}, line.substr(6, longest_said)};
      if (line.find("bad_alloc") != std::string::npos)
        answer = {How::out_of_memory, {}, fmt::format("{} MB", limits.memory)};
    } else if (line.rfind("answer ", 0) != 0 || !parse_answer(line, answer.got)) {
      malformed = true;
    }
    if (malformed) break;
    answers.push_back(std::move(answer));
  }
  // if a limit or a signal ended the process, its last line may be incomplete
  const bool cut = rest.how != How::no_token;
  if (!cut && begin != end.answers.size()) malformed = true;
  if (malformed || answers.size() > count) return std::vector<Answer>(count, Answer{How::no_token, {}, {}});
  if (answers.size() == count && !cut) {
    if (!finished || end.code != 0) return std::vector<Answer>(count, Answer{How::no_token, {}, {}});
    return answers;
  }
  // if the process ended after its last answer, attributes the end to the last call
  if (answers.size() == count && count > 0) answers.pop_back();
  answers.resize(count, rest);
  return answers;
}

std::string shown_exception(const std::string& text, const std::map<std::string, std::string>& files) {
  // messages of libstdc++'s exceptions, and of child_main.cpp
  static constexpr const char* known[] = {"vector::_M_range_check: __n (which is ",
                                          ") >= this->size() (which is ",
                                          "vector::_M_default_append",
                                          "vector::_M_realloc_insert",
                                          "vector::_M_fill_insert",
                                          "vector::reserve",
                                          "cannot create std::vector larger than max_size()",
                                          "array::at: __n (which is ",
                                          ") >= _Nm (which is ",
                                          "deque::_M_range_check: __n (which is ",
                                          "map::at",
                                          "_Map_base::at",
                                          "basic_string::at: __n (which is ",
                                          "basic_string::substr: __pos (which is ",
                                          ") > this->size() (which is ",
                                          "basic_string::append",
                                          "stod",
                                          "stoi",
                                          "bad_function_call",
                                          "std::bad_alloc",
                                          "std::bad_array_new_length",
                                          "std::bad_cast",
                                          "bad optional access",
                                          "Resource temporarily unavailable",  // no more threads
                                          "std::exception",
                                          "something that is no std::exception"};
  constexpr std::size_t most_pieces = 4, most_digits = 6;
  const auto stands = [&](const std::string& piece) {
    for (const char* one : known)
      if (std::string(one).find(piece) != std::string::npos) return true;
    for (const auto& [name, content] : files)
      if (content.find(piece) != std::string::npos) return true;
    return false;
  };
  std::size_t pieces = 0;
  for (std::size_t at = 0; at < text.size();) {
    const bool number = std::isdigit(static_cast<unsigned char>(text[at]));
    const std::size_t end =
        std::min(number ? text.find_first_not_of("0123456789", at) : text.find_first_of("0123456789", at), text.size());
    if (number ? end - at > most_digits : ++pieces > most_pieces || !stands(text.substr(at, end - at))) return "";
    at = end;
  }
  return text;
}

Limits limits_for(double reference, double least) {
  const double cpu = std::max(least, times_reference * reference);
  return {.cpu = cpu, .wall = 60 * cpu, .answers = 64 << 10};
}

std::vector<Answer> run_calls(const Sandbox& sandbox, const std::filesystem::path& program,
                              const std::vector<Case>& cases, const Limits& limits, double* cpu,
                              std::string* captured) {
  const std::string token = fresh_token();
  Job job{.command = {program.string()}, .readable = {program.parent_path()}, .input = token + "\n", .limits = limits};
  for (const Case& one : cases) {
    job.input += "call " + one.call;
    for (const double value : one.in) job.input += fmt::format(" {:a}", value);
    job.input += '\n';
  }
  const End end = is_python_program(program) ? run_python(sandbox, program, job) : sandbox.run(job);
  if (cpu) *cpu = end.cpu;
  if (captured) *captured = end.captured_output;
  return answers_of(end, token, cases.size(), limits);
}

}  // namespace coursework
