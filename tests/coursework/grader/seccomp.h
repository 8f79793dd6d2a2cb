// The system-call filter, shared by all sandboxes.
#pragma once

#include <string>

namespace coursework {

struct Allowed {
  bool starts = false;   // the program may start other processes; otherwise only threads
  bool creates = false;  // the program may create files, folders, links
};

/// The filter as a program for the kernel (an array of struct sock_filter). Refuses with EPERM: sockets, tracing and
/// reading other processes, namespaces, mounts, keys, kernel interfaces, memory that outlives a process, and whatever
/// `allowed` excludes. If no process may be started, sleeping returns immediately. clone3 and openat2 fail with ENOSYS
/// as if absent, because a filter cannot inspect their arguments in memory; the C library then uses older calls. Calls
/// of other ABIs kill the program. Throws std::runtime_error if libseccomp fails.
std::string filter_program(Allowed allowed);

}  // namespace coursework
