// Uses one resource up to a limit or beyond it, for sandbox_test: sandbox_program WHAT AMOUNT. Writes `done` to
// descriptor 3 if it reaches its end.

#include <arpa/inet.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>
#include <new>
#include <string>
#include <vector>

namespace {

void say(const std::string& text) {
  if (write(3, text.data(), text.size()) < 0) _exit(1);
}

int fill(int fd, long bytes) {
  const std::string block(1024, 'x');
  for (long left = bytes; left > 0; left -= 1024)
    if (write(fd, block.data(), block.size()) < 0) return errno;
  return 0;
}

void burn(double seconds) {
  while (static_cast<double>(std::clock()) < seconds * CLOCKS_PER_SEC) {
  }
}

/// Starts as many sleeping processes as possible, at most `count`. Returns their number.
long sleepers(long count) {
  for (long i = 0; i < count; ++i) {
    const pid_t child = fork();
    if (child < 0) return i;
    if (child == 0) {
      setsid();
      pause();
    }
  }
  return count;
}

void tell(const char* what, long result) {
  if (result < 0)
    say(std::string(what) + ": " + std::strerror(errno) + "\n");
  else
    say(std::string(what) + ": " + std::to_string(result) + "\n");
}

void reach_out() {
  tell("socket", socket(AF_INET, SOCK_STREAM, 0));
  tell("unix", socket(AF_UNIX, SOCK_STREAM, 0));
  tell("ptrace", ptrace(PTRACE_ATTACH, getppid(), nullptr, nullptr));
  char byte;
  const iovec here{&byte, 1}, there{reinterpret_cast<void*>(0x1000), 1};
  tell("process_vm_readv", syscall(SYS_process_vm_readv, getppid(), &here, 1, &there, 1, 0));
  tell("unshare", syscall(SYS_unshare, 0x10000000));
  tell("clone", syscall(SYS_clone, 0x10000000 | SIGCHLD, nullptr, nullptr, nullptr, 0L));
  tell("clone3", syscall(SYS_clone3, nullptr, 0));
  tell("keyctl", syscall(SYS_keyctl, 0, 0, 0, 0, 0));
  tell("bpf", syscall(SYS_bpf, 0, nullptr, 0));
  tell("perf_event_open", syscall(SYS_perf_event_open, nullptr, 0, 0, 0, 0));
  tell("userfaultfd", syscall(SYS_userfaultfd, 0));
  tell("io_uring_setup", syscall(SYS_io_uring_setup, 1, nullptr));
  tell("shmget", shmget(IPC_PRIVATE, 4096, IPC_CREAT | 0600));
  tell("msgget", msgget(IPC_PRIVATE, IPC_CREAT | 0600));
  tell("memfd_create", memfd_create("x", 0));
  tell("prctl", prctl(PR_SET_PDEATHSIG, 0));
  tell("setuid", setuid(0));
}

const std::map<std::string, std::function<int(const char*)>> things = {
    {"cpu", [](const char* amount) { return burn(std::atof(amount)), 0; }},
    {"swallow", [](const char* amount) { return std::signal(SIGXCPU, SIG_IGN), burn(std::atof(amount)), 0; }},
    {"sleep",
     [](const char* amount) {
       sigset_t none;  // unlike sleep functions, sigtimedwait() does not return at once under the filter
       sigemptyset(&none);
       const timespec time{static_cast<time_t>(std::atof(amount)),
                           static_cast<long>(1e9 * std::fmod(std::atof(amount), 1))};
       return sigtimedwait(&none, nullptr, &time) == -1 && errno == EAGAIN ? 0 : 1;
     }},
    {"nap", [](const char* amount) { return usleep(static_cast<useconds_t>(1e6 * std::atof(amount))); }},
    {"memory",
     [](const char* amount) {
       std::set_new_handler([] { say("memory\n"), _exit(1); });
       std::vector<char> block(std::strtoul(amount, nullptr, 10) << 20);
       return block[block.size() / 2] != 0 ? 1 : 0;
     }},
    {"throw", [](const char* amount) { return std::vector<char>(std::strtoul(amount, nullptr, 10) << 20)[0] + 0; }},
    {"processes", [](const char* amount) { return sleepers(std::atol(amount)) == std::atol(amount) ? 0 : 1; }},
    {"threads",
     [](const char* amount) {
       const std::function<int(long)> start = [&start](long more) {
         pthread_t thread{};
         const auto wait = [](void*) -> void* { return pause(), nullptr; };
         return more == 0 ? 0 : pthread_create(&thread, nullptr, wait, nullptr) != 0 ? 1 : start(more - 1);
       };
       return start(std::atol(amount));
     }},
    {"worker",
     [](const char* amount) {
       pthread_t thread{};
       const auto work = [](void* seconds) -> void* { return burn(*static_cast<double*>(seconds)), nullptr; };
       double seconds = std::atof(amount);
       return pthread_create(&thread, nullptr, work, &seconds) | pthread_join(thread, nullptr);
     }},
    {"answers", [](const char* amount) { return fill(3, std::atol(amount) << 10); }},
    {"output", [](const char* amount) { return fill(2, std::atol(amount) << 10); }},
    {"file",
     [](const char* amount) {
       return fill(open((std::string(std::getenv("TMPDIR")) + "/big").c_str(), O_CREAT | O_WRONLY, 0600),
                   std::atol(amount) << 10);
     }},
    {"files",
     [](const char* amount) {
       long full = 0;  // in units of 1000 kB
       for (long i = 0; i < std::atol(amount); ++i) {
         const std::string name = std::string(std::getenv("TMPDIR")) + "/" + std::to_string(i);
         const int file = open(name.c_str(), O_CREAT | O_WRONLY, 0600);
         if (file >= 0 && fill(file, 1000 << 10) == 0) ++full;
         if (file >= 0) close(file);
       }
       return say(std::to_string(full) + "\n"), 1;
     }},
    {"signal", [](const char* amount) { return std::raise(std::atoi(amount)); }},
    {"exit", [](const char* amount) { return std::atoi(amount); }},
    {"leave", [](const char*) { return sleepers(2), usleep(100000); }},
    {"killall", [](const char*) { return kill(getppid(), SIGKILL), kill(-1, SIGKILL), usleep(100000); }},
    {"reach", [](const char*) { return reach_out(), 0; }},
    {"litter",
     [](const char* amount) {
       for (const char* place : {".", "/tmp", "/var/tmp", "/dev/shm", "/run/lock"}) {
         const std::string name = std::string(place) + "/" + amount;
         const int file = open(name.c_str(), O_CREAT | O_WRONLY, 0600);
         if (file >= 0) say(name + "\n"), close(file);
       }
       return mkfifo("pipe", 0600) | symlink("/etc/passwd", "link");
     }},
};

}  // namespace

int main(int count, char** arguments) {
  const auto thing = things.find(count == 3 ? arguments[1] : "");
  if (thing == things.end()) return 2;
  const int code = thing->second(arguments[2]);
  if (code == 0) say("done\n");
  return code;
}
