// The program around a student's code in the grader: calls come on standard input, answers go out on descriptor 3.
// It never sees what is right. Runs on Linux only; the hand-out has a main of its own.
#include <malloc.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <unistd.h>
#include <unwind.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "calls.h"

namespace {

struct Call {
  std::string name;
  coursework::Numbers in;
};

/// A handler of signals can reach nothing else.
struct Watched {
  static constexpr int most = 8;
  const char* function[most] = {};  // of the student's, in the order in which they were called first
  long count[most] = {};
  int last = 0;
  volatile std::sig_atomic_t sending = 0;  // a line is on its way: nothing may come between
  const char* stack_end = nullptr;         // the lowest address that the stack may grow to
};
Watched watched;

#ifdef TELLS_PLACES
/// Where the program is: the addresses of its calls on standard error, for addr2line.
_Unwind_Reason_Code tell_address(_Unwind_Context* call, void*) {
  int before = 0;
  const auto at = _Unwind_GetIPInfo(call, &before);
  std::fprintf(stderr, " 0x%lx", static_cast<unsigned long>(before ? at : at - 1));
  return _URC_NO_REASON;
}
extern "C" const char* __ubsan_default_options() { return "abort_on_error=1"; }
void tell_place() {
  std::fputs("\nat", stderr);
  _Unwind_Backtrace(tell_address, nullptr);
  std::fputs("\n", stderr);
}
#else
void tell_place() {}
#endif

/// The limit of processor time is reached: how often each was called, the one at hand last.
void too_slow(int) {
  char text[640] = "slow";
  std::size_t used = 4;
  const auto add = [&](int i) {
    used += static_cast<std::size_t>(
        std::snprintf(text + used, sizeof text - used, " %.40s %ld", watched.function[i], watched.count[i]));
  };
  for (int i = 0; i < Watched::most && watched.function[i]; ++i)
    if (i != watched.last) add(i);
  if (watched.function[watched.last]) add(watched.last);
  text[used++] = '\n';
  if (!watched.sending && write(3, text, used) < 0) _exit(4);
  std::signal(SIGXCPU, SIG_DFL);
  std::raise(SIGXCPU);
}

/// A full stack is told from other crashes by where the access was.
void bad_access(int number, siginfo_t* what, void*) {
  constexpr std::ptrdiff_t near = 1 << 20;  // larger than frames that people write
  const std::ptrdiff_t above = static_cast<const char*>(what->si_addr) - watched.stack_end;
  const bool is_full = number == SIGSEGV && above > -near && above < near;
  if (!watched.sending && is_full && write(3, "recursion\n", 10) < 0) _exit(4);
  if (!is_full) tell_place();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void watch() {
  static char own_stack[1 << 16];  // of the handlers: the other one may be full
  stack_t stack{};
  stack.ss_sp = own_stack, stack.ss_size = sizeof own_stack;
  sigaltstack(&stack, nullptr);
  rlimit limit{};
  getrlimit(RLIMIT_STACK, &limit);
  watched.stack_end = static_cast<const char*>(__builtin_frame_address(0)) - limit.rlim_cur;
  struct sigaction action {};
  action.sa_flags = SA_ONSTACK | SA_SIGINFO | SA_RESETHAND | SA_NODEFER;
  action.sa_sigaction = bad_access;
  sigaction(SIGSEGV, &action, nullptr);
#ifdef TELLS_PLACES
  for (const int other : {SIGABRT, SIGBUS, SIGFPE, SIGILL}) sigaction(other, &action, nullptr);
#endif
  std::signal(SIGXCPU, too_slow);
}

/// Past any buffer of the student's code, at once: what was answered stays answered whatever happens next.
void send(const std::string& line) {
  watched.sending = 1;
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t count = write(3, line.data() + done, line.size() - done);
    if (count <= 0) _exit(4);
    done += static_cast<std::size_t>(count);
  }
  watched.sending = 0;
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  return text.substr(0, 200);
}

std::string answer_line(const Call& call) {
  try {
    coursework::Numbers out;
    coursework::calling(call.name.c_str());
    if (!coursework::answer(call.name, call.in, out)) return "unknown\n";
    std::string line = "answer " + std::to_string(out.size());
    for (const double value : out) {
      char text[40];
      std::snprintf(text, sizeof text, " %a", value);
      line += text;
    }
    return line + "\n";
  } catch (const coursework::Unusable& error) {
    std::string line = std::string("unusable ") + error.what();
    for (const std::size_t number : error.numbers()) line += " " + std::to_string(number);
    return line + "\n";
  } catch (const std::exception& error) {
    return "threw " + one_line(error.what()) + "\n";
  } catch (...) {
    return "threw something that is no std::exception\n";
  }
}

}  // namespace

/// The number behind std::thread::hardware_concurrency(): one thread per processor has to fit into the limits.
extern "C" int get_nprocs() noexcept { return 4; }

void coursework::calling(const char* function) {
  int i = 0;
  while (i + 1 < Watched::most && watched.function[i] && std::strcmp(watched.function[i], function) != 0) ++i;
  watched.function[i] = function;
  ++watched.count[i], watched.last = i;
}

int main() {
  // each arena of a thread's own would take 64 MB of the address space that is limited
  mallopt(M_ARENA_MAX, 1);
  // the token lives on main's stack only, and all is read before anything of the student's is called
  const std::string all{std::istreambuf_iterator<char>(std::cin), {}};
  std::istringstream lines(all);
  std::string token, line;
  std::getline(lines, token);
  std::vector<Call> calls;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string word;
    Call call;
    words >> word >> call.name;
    while (words >> word) call.in.push_back(std::strtod(word.c_str(), nullptr));
    calls.push_back(std::move(call));
  }
  watch();
  for (const Call& call : calls) send(answer_line(call));
  send("token " + token + "\n");
  // no destructor of the student's may undo it
  _exit(0);
}
