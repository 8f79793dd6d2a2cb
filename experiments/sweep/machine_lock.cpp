// One file; a process that dies lets go of it.
#include "experiments/sweep/machine_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace crosscheck {

MachineLock::MachineLock(Hold hold) {
  const char* named = std::getenv("CROSSCHECK_LOCK");
  const std::string file = named && *named ? named : fmt::format("/tmp/crosscheck-{}.lock", getuid());
  handle_ = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (handle_ >= 0) flock(handle_, hold == Hold::alone ? LOCK_EX : LOCK_SH);
}

MachineLock::~MachineLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace crosscheck
