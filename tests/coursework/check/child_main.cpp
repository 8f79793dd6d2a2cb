// The program around a student's code in the grader: reads calls from standard input, writes answers to descriptor 3.
// Never receives expected answers. Linux only; the hand-out has its own main.
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

/// Global, because a signal handler can access nothing else.
struct Watched {
  static constexpr int most = 8;
  const char* function[most] = {};  // names of the student's functions, in the order of their first calls
  long count[most] = {};
  int last = 0;
  volatile std::sig_atomic_t sending = 0;  // nonzero while a line is written that no other output may interrupt
  const char* stack_end = nullptr;         // the lowest address that the stack may reach
};
Watched watched;

#ifdef TELLS_PLACES
/// Writes the addresses of the call stack to standard error, for addr2line.
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

/// Handles the limit of CPU time: reports the number of calls of each function, the current function last.
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

/// Handles memory faults: distinguishes a stack overflow from other crashes by the address of the access.
void bad_access(int number, siginfo_t* what, void*) {
  constexpr std::ptrdiff_t near = 1 << 20;  // exceeds the frame size of realistic code
  const std::ptrdiff_t above = static_cast<const char*>(what->si_addr) - watched.stack_end;
  const bool is_full = number == SIGSEGV && above > -near && above < near;
  if (!watched.sending && is_full && write(3, "recursion\n", 10) < 0) _exit(4);
  if (!is_full) tell_place();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void watch() {
  static char own_stack[1 << 16];  // the handlers' stack, because the main stack may be full
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

/// Writes immediately, bypassing buffers of the student's code, so that earlier answers survive a later crash.
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

/// Called by std::thread::hardware_concurrency(). Returns a small number, because a program that starts one thread per
/// processor must stay within the limits.
extern "C" int get_nprocs() noexcept { return 4; }

void coursework::calling(const char* function) {
  int i = 0;
  while (i + 1 < Watched::most && watched.function[i] && std::strcmp(watched.function[i], function) != 0) ++i;
  watched.function[i] = function;
  ++watched.count[i], watched.last = i;
}

int main() {
  // each thread's arena would reserve 64 MB of the limited address space
  mallopt(M_ARENA_MAX, 1);
  // the token is only on main's stack, and all input is read before any of the student's code is called
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
  // skips the student's destructors, which might undo the answers
  _exit(0);
}
