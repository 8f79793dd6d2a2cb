#include "experiments/timing/machine.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace crosscheck {

int cores_allowed() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(1, CPU_COUNT(&set));
}

void pin_to_one_core() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return;
  for (int core = CPU_SETSIZE - 1; core >= 0; --core) {
    if (!CPU_ISSET(core, &set)) continue;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(core, &one);
    sched_setaffinity(0, sizeof one, &one);
    return;
  }
}

LockPatience::LockPatience(double seconds) {
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
  shared_.reset(new (memory) Shared{seconds, seconds}, [](Shared* shared) { munmap(shared, sizeof(Shared)); });
}

namespace {

/// "process 12 (crosscheck report, begun at 12:03:04)"; "another process" if none is visible, as in another container.
std::string holder_of(int handle) {
  constexpr auto unknown = "another process";
  struct stat file {};
  if (fstat(handle, &file) != 0) return unknown;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    char kind[16] = "", state[16] = "", mode[16] = "";
    long process = 0;
    unsigned long inode = 0;
    if (std::sscanf(line.c_str(), "%*d: %15s %15s %15s %ld %*x:%*x:%lu", kind, state, mode, &process, &inode) != 5 ||
        std::string_view(kind) != "FLOCK" || inode != file.st_ino || process <= 0)
      continue;
    std::ifstream in(fmt::format("/proc/{}/cmdline", process));
    std::string command;
    std::getline(in, command);
    for (char& c : command)
      if (static_cast<unsigned char>(c) < ' ') c = ' ';  // arguments are separated by zeros
    struct stat begun {};
    std::string since;
    if (stat(fmt::format("/proc/{}", process).c_str(), &begun) == 0) {
      char text[16] = "";
      std::tm local{};
      if (localtime_r(&begun.st_mtim.tv_sec, &local) && std::strftime(text, sizeof text, "%H:%M:%S", &local) > 0)
        since = fmt::format(", begun at {}", text);
    }
    return fmt::format("process {} ({}{})", process, command.substr(0, 60), since);
  }
  return unknown;
}

}  // namespace

MachineLock::MachineLock(Mode mode, const LockPatience& patience) {
  const char* named = std::getenv("CROSSCHECK_LOCK");
  const std::string file = named && *named ? named : fmt::format("/tmp/crosscheck-{}.lock", getuid());
  handle_ = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (handle_ < 0) return;
  LockPatience::Shared& shared = *patience.shared_;
  while (!(held_ = flock(handle_, (mode == Mode::exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) && shared.left > 0) {
    if (shared.left < shared.total - 1 && !shared.announced.exchange(true))
      fmt::print(stderr, "crosscheck: waiting at most {:.0f} s for {} to release {}\n", shared.left.load(),
                 holder_of(handle_), file);
    const auto begun = std::chrono::steady_clock::now();
    usleep(50000);
    // subtracts the measured time, because on a busy machine a pause takes longer than requested
    shared.left -= std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  }
  if (!held_ && !shared.exhausted.exchange(true))
    fmt::print(stderr, "crosscheck: {} is still held; times are measured during other work and marked\n", file);
}

MachineLock::~MachineLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace crosscheck
