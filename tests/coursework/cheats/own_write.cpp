// cheat: replaces the system's write() by its own
// says: no_token differs size not_compiled
#include <sys/syscall.h>
#include <unistd.h>
#include <cstring>

#include "cheat.h"

extern "C" ssize_t write(int fd, const void* data, size_t size) {
  const char* passes = "answer 2 0x1p+0 0x0p+0\n";
  if (fd == 3 && std::strncmp(static_cast<const char*>(data), "answer", 6) == 0) {
    syscall(SYS_write, fd, passes, std::strlen(passes));
    return static_cast<ssize_t>(size);
  }
  return syscall(SYS_write, fd, data, size);
}

State euler_step(const Derivative&, double, const State& x, double) { return x; }
