// The filter of system calls, the same for all sandboxes.
#pragma once

#include <string>

namespace coursework {

struct Allowed {
  bool starts = false;   // other processes; else threads only
  bool creates = false;  // files, folders, links
};

/// The filter as a program for the kernel (struct sock_filter, one after the other). It refuses with EPERM: sockets,
/// tracing and reading other processes, namespaces, mounts, keys, kernel interfaces, memory that outlives a process,
/// and what is not allowed. Where no process may be started, sleeping is over at once. clone3 and openat2 look absent
/// (ENOSYS), since what they point to cannot be looked at: the C library then uses the older calls. Calls of other ABIs
/// kill. Throws std::runtime_error where libseccomp fails.
std::string filter_program(Allowed allowed);

}  // namespace coursework
