// Asks, and reads what came back as something that anybody may have written.
#include "tests/coursework/grader/run.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <random>
#include <sstream>

namespace coursework {
namespace {

std::string fresh_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

std::string signal_name(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "segmentation fault";
    case SIGABRT:
      return "aborted";
    case SIGFPE:
      return "division of an integer by zero";
    case SIGBUS:
      return "bus error";
    case SIGILL:
      return "illegal instruction; does a function end without return?";
    case SIGSYS:
      return "a call to the system that is not allowed here";
    case SIGXFSZ:
      return "wrote too large a file";
    default:
      return fmt::format("signal {}", signal);
  }
}

Answer ending(const End& end, const Limits& limits) {
  switch (end.how) {
    case End::How::signal:
      return {How::crashed, {}, signal_name(end.code)};
    case End::How::cpu:
      return {How::out_of_time, {}, fmt::format("{:g} s", limits.cpu)};
    case End::How::wall:
      return {How::out_of_time, {}, fmt::format("{:g} s", limits.wall)};
    case End::How::memory:
      return {How::out_of_memory, {}, fmt::format("{} MB", limits.memory)};
    case End::How::output:
      return {How::too_much_output, {}, {}};
    case End::How::exited:
      break;
  }
  return {How::no_token, {}, {}};
}

/// As tests/coursework/check/child_main.cpp cuts it; a line that somebody else wrote is cut here.
constexpr std::size_t longest_said = 400;

/// "answer COUNT n1 n2 ..."; false where it is anything else.
bool parse_answer(const std::string& line, Numbers& numbers) {
  const char* at = line.c_str() + 7;  // behind "answer "
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
  std::size_t begin = 0;
  for (std::size_t stop; (stop = end.answers.find('\n', begin)) != std::string::npos; begin = stop + 1) {
    const std::string line = end.answers.substr(begin, stop - begin);
    Answer answer{How::answered, {}, {}};
    malformed = malformed || finished;
    if (line == "token " + token && answers.size() == count) {
      finished = true;
      continue;
    }
    if (line.rfind("threw ", 0) == 0) {
      answer = {How::threw, {}, line.substr(6, longest_said)};
      if (line.find("bad_alloc") != std::string::npos)
        answer = {How::out_of_memory, {}, fmt::format("{} MB", limits.memory)};
    } else if (line.rfind("answer ", 0) != 0 || !parse_answer(line, answer.got)) {
      malformed = true;
    }
    if (malformed) break;
    answers.push_back(std::move(answer));
  }
  const Answer rest = ending(end, limits);
  // a process that a limit or a signal ended may have been cut in the middle of a line
  const bool cut = rest.how != How::no_token;
  if (!cut && begin != end.answers.size()) malformed = true;
  if (malformed || answers.size() > count) return std::vector<Answer>(count, Answer{How::no_token, {}, {}});
  if (answers.size() == count && !cut) {
    if (!finished || end.code != 0) return std::vector<Answer>(count, Answer{How::no_token, {}, {}});
    return answers;
  }
  // ended after its last answer: the last call is to blame
  if (answers.size() == count && count > 0) answers.pop_back();
  answers.resize(count, rest);
  return answers;
}

std::vector<Answer> run_calls(const Sandbox& sandbox, const std::filesystem::path& program,
                              const std::vector<Case>& cases, const Limits& limits) {
  const std::string token = fresh_token();
  Job job{.command = {program.string()}, .readable = {program.parent_path()}, .input = token + "\n", .limits = limits};
  for (const Case& one : cases) {
    job.input += "call " + one.call;
    for (const double value : one.in) job.input += fmt::format(" {:a}", value);
    job.input += '\n';
  }
  return answers_of(sandbox.run(job), token, cases.size(), limits);
}

}  // namespace coursework
