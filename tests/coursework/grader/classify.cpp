#include <signal.h>
#include <sys/wait.h>

#include <string_view>

#include "tests/coursework/grader/spawn.h"

namespace coursework {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

bool says_memory(const Ended& ended) {
  const std::string_view answers = ended.answers;
  constexpr std::string_view word = "memory\n";
  if (answers.ends_with(word) && (answers.size() == word.size() || answers[answers.size() - word.size() - 1] == '\n'))
    return true;
  for (const std::string_view phrase : {"bad_alloc", "out of memory", "memory exhausted"})
    if (ended.chatter.find(phrase) != std::string::npos) return true;
  return false;
}

}  // namespace

End classify(Ended ended, const Limits& limits, bool shell) {
  End end{End::How::exited, 0, std::move(ended.answers), std::move(ended.chatter)};
  ended.answers = end.answers;
  ended.chatter = end.chatter;
  int signal = WIFSIGNALED(ended.status) ? WTERMSIG(ended.status) : 0;
  const int code = WIFEXITED(ended.status) ? WEXITSTATUS(ended.status) : 0;
  if (shell && code > 128 && code < 128 + NSIG) signal = code - 128;
  end.code = signal ? signal : code;
  const double cpu = seconds(ended.used.ru_utime) + seconds(ended.used.ru_stime);
  // ru_maxrss is in kB; what is mapped of the limit is more than what is resident, hence three quarters.
  const bool full = static_cast<double>(ended.used.ru_maxrss) > 0.75 * 1024 * static_cast<double>(limits.memory);
  if (ended.wall)
    end.how = End::How::wall;
  else if (ended.output || signal == SIGXFSZ)
    end.how = End::How::output;
  else if (signal == SIGXCPU || cpu > limits.cpu)
    end.how = End::How::cpu;
  else if ((end.code != 0 && says_memory(ended)) || (signal == SIGKILL && full))
    end.how = End::How::memory;
  else if (signal)
    end.how = End::How::signal;
  return end;
}

}  // namespace coursework
