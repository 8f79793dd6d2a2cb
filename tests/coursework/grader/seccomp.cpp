#include "tests/coursework/grader/seccomp.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace coursework {
namespace {

constexpr const char* refused[] = {
    // network
    "socket", "socketpair",
    // other processes
    "ptrace", "process_vm_readv", "process_vm_writev", "process_madvise", "pidfd_open", "pidfd_getfd", "kcmp",
    // namespaces and mounts
    "unshare", "setns", "mount", "umount2", "pivot_root", "chroot", "fsopen", "fsconfig", "fsmount", "fspick",
    "open_tree", "move_mount", "mount_setattr",
    // keys and shared memory outlive a process
    "add_key", "request_key", "keyctl", "shmget", "shmat", "semget", "msgget", "mq_open", "memfd_create",
    "memfd_secret",
    // kernel interfaces; io_uring would bypass the filter
    "bpf", "perf_event_open", "userfaultfd", "fanotify_init", "open_by_handle_at", "io_uring_setup", "io_uring_enter",
    "io_uring_register", "init_module", "finit_module", "delete_module", "kexec_load", "kexec_file_load", "reboot",
    "swapon", "swapoff", "acct", "quotactl", "syslog", "personality"};
constexpr const char* starting[] = {"fork", "vfork"};
constexpr const char* creating[] = {"creat",     "mkdir", "mkdirat", "mknod",  "mknodat",  "symlink",
                                    "symlinkat", "link",  "linkat",  "rename", "renameat", "renameat2"};
// These calls return immediately, as if the time had passed: waiting uses no CPU time, so the limit on CPU time would
// not stop a student's program.
constexpr const char* waiting[] = {"nanosleep", "clock_nanosleep", "poll", "ppoll", "select", "pselect6"};
constexpr unsigned long spaces[] = {CLONE_NEWUSER, CLONE_NEWNS,  CLONE_NEWPID,    CLONE_NEWNET,
                                    CLONE_NEWIPC,  CLONE_NEWUTS, CLONE_NEWCGROUP, 0x80 /* CLONE_NEWTIME */};

struct Release {
  void operator()(void* filter) const { seccomp_release(filter); }
};

void check(int result) {
  if (result < 0) throw std::runtime_error(fmt::format("libseccomp: {}", std::strerror(-result)));
}

/// Skips a system call that this libseccomp does not know, or that this machine lacks: a program cannot make it either.
void refuse(void* filter, const char* name, int error) {
  const int number = seccomp_syscall_resolve_name(name);
  if (number >= 0) check(seccomp_rule_add(filter, SCMP_ACT_ERRNO(error), number, 0));
}

void refuse_if(void* filter, const char* name, scmp_arg_cmp when) {
  check(seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), seccomp_syscall_resolve_name(name), 1, when));
}

}  // namespace

std::string filter_program(Allowed allowed) {
  const std::unique_ptr<void, Release> filter(seccomp_init(SCMP_ACT_ALLOW));
  if (!filter) throw std::runtime_error("libseccomp: no filter can be made");
  for (const char* name : refused) refuse(filter.get(), name, EPERM);
  refuse(filter.get(), "clone3", ENOSYS);
  for (const unsigned long flag : spaces) refuse_if(filter.get(), "clone", SCMP_A0(SCMP_CMP_MASKED_EQ, flag, flag));
  if (!allowed.starts) {
    for (const char* name : starting) refuse(filter.get(), name, EPERM);
    refuse_if(filter.get(), "clone", SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0));
    for (const char* name : waiting) refuse(filter.get(), name, 0);
  }
  if (!allowed.creates) {
    for (const char* name : creating) refuse(filter.get(), name, EPERM);
    refuse(filter.get(), "openat2", ENOSYS);
    for (const unsigned long flag : {O_CREAT, O_TMPFILE & ~O_DIRECTORY}) {
      refuse_if(filter.get(), "open", SCMP_A1(SCMP_CMP_MASKED_EQ, flag, flag));
      refuse_if(filter.get(), "openat", SCMP_A2(SCMP_CMP_MASKED_EQ, flag, flag));
    }
  }
  refuse_if(filter.get(), "ioctl", SCMP_A1(SCMP_CMP_MASKED_EQ, 0xffffffffu, TIOCSTI));  // injects input into a terminal
  refuse_if(filter.get(), "prctl", SCMP_A0(SCMP_CMP_MASKED_EQ, 0xffffffffu, PR_SET_PDEATHSIG));  // would outlive us

  const int file = memfd_create("filter", MFD_CLOEXEC);
  if (file < 0) throw std::runtime_error(fmt::format("no memory file: {}", std::strerror(errno)));
  const int written = seccomp_export_bpf(filter.get(), file);
  std::string program(static_cast<std::size_t>(lseek(file, 0, SEEK_END)), '\0');
  const ssize_t got = pread(file, program.data(), program.size(), 0);
  close(file);
  check(written);
  if (program.empty() || got != static_cast<ssize_t>(program.size()))
    throw std::runtime_error("libseccomp: the filter cannot be read back");
  return program;
}

}  // namespace coursework
