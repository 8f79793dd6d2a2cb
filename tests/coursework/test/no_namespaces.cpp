// no_namespaces COMMAND ARGUMENT... runs a command as in containers that forbid namespaces: unshare and clone with
// namespace flags fail with EPERM, and clone3 fails with ENOSYS.
#include <sched.h>
#include <seccomp.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

int main(int count, char** arguments) {
  if (count < 2) return std::fprintf(stderr, "no_namespaces COMMAND ARGUMENT...\n"), 2;
  scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  const unsigned long spaces = CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWNET | CLONE_NEWIPC | CLONE_NEWUTS |
                               CLONE_NEWCGROUP | 0x80 /* CLONE_NEWTIME */;
  int failed = seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), SCMP_SYS(unshare), 0);
  failed |= seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0);
  for (unsigned long flag = 1; flag <= spaces; flag <<= 1)
    if (spaces & flag)
      failed |=
          seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), SCMP_SYS(clone), 1, SCMP_A0(SCMP_CMP_MASKED_EQ, flag, flag));
  // Root does not need no_new_privs to install a filter. Without it, children may still change to another user.
  seccomp_attr_set(filter, SCMP_FLTATR_CTL_NNP, geteuid() != 0);
  if (failed || seccomp_load(filter) != 0) return std::fprintf(stderr, "no_namespaces: no filter\n"), 2;
  execvp(arguments[1], arguments + 1);
  std::perror(arguments[1]);
  return 2;
}
