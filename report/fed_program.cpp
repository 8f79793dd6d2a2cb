// stdin is a socket, as writing to the pipe of a program that has ended would end this one; stderr is a nameless file
// in memory, so that nobody has to read along.
#include "report/fed_program.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "report/spawn.h"

namespace crosscheck {

FedProgram::FedProgram(const std::vector<std::string>& argv) {
  int ends[2] = {-1, -1};
  err_ = memfd_create("stderr", MFD_CLOEXEC);
  if (err_ < 0 || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    const std::string why = std::strerror(errno);
    if (err_ >= 0) close(err_);
    throw std::runtime_error("cannot feed " + argv[0] + ": " + why);
  }
  FileActions actions;
  posix_spawn_file_actions_adddup2(&actions.list, ends[1], 0);
  posix_spawn_file_actions_addopen(&actions.list, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions.list, err_, 2);
  try {
    child_ = spawn(argv, actions);
  } catch (...) {
    for (const int file : {ends[0], ends[1], err_}) close(file);
    throw;
  }
  close(ends[1]);
  feed_ = ends[0];
}

FedProgram::~FedProgram() {
  if (feed_ >= 0) close(feed_);
  if (child_ > 0) kill(child_, SIGKILL), end_of(child_);
  close(err_);
}

bool FedProgram::feed(const void* data, size_t bytes) {
  for (const char* at = static_cast<const char*>(data); bytes > 0;) {
    const ssize_t sent = send(feed_, at, bytes, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return false;
    at += sent, bytes -= static_cast<size_t>(sent);
  }
  return true;
}

ProgramResult FedProgram::finish() {
  close(feed_), feed_ = -1;
  ProgramResult result;
  result.status = end_of(child_), child_ = 0;
  lseek(err_, 0, SEEK_SET);
  std::array<char, 4096> chunk;
  for (ssize_t n; (n = read(err_, chunk.data(), chunk.size())) > 0;)
    result.err.append(chunk.data(), static_cast<size_t>(n));
  return result;
}

}  // namespace crosscheck
