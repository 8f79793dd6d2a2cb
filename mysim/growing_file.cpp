// O_TMPFILE where there is one, then a link and a rename.
#include "mysim/growing_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "mysim/errors.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr auto no_room = "; expected a folder with write permission and free space";
constexpr auto descriptors = "/proc/self/fd";

}  // namespace

GrowingFile::GrowingFile(fs::path file)
    : file_(std::move(file)), temporary_(fs::path(file_) += fmt::format(".{}.part", getpid())) {
  const fs::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  constexpr mode_t mode = 0666;  // less what the user's mask takes away
  int descriptor = -1;
  if (access(descriptors, X_OK) == 0)  // by which it gets its name
    descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
  if (descriptor < 0) {
    descriptor = open(temporary_.c_str(), O_CREAT | O_TRUNC | O_RDWR | O_CLOEXEC, mode);
    named_ = descriptor >= 0;
  }
  if (descriptor < 0) fail(no_room);
  out_.reset(fdopen(descriptor, "w"));
  if (!out_) fail(no_room);
}

GrowingFile::~GrowingFile() {
  if (named_) unlink(temporary_.c_str());
}

void GrowingFile::append(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), out_.get()) != bytes.size()) fail(no_room);
}

void GrowingFile::rewrite_beginning(std::string_view bytes) {
  if (std::fseek(out_.get(), 0, SEEK_SET) != 0) fail(no_room);
  append(bytes);
  if (std::fseek(out_.get(), 0, SEEK_END) != 0) fail(no_room);
}

void GrowingFile::finish() {
  if (std::fflush(out_.get()) != 0) fail(no_room);
  if (!named_) {
    // left behind by a process of the same number that died in between
    unlink(temporary_.c_str());
    const std::string self = fmt::format("{}/{}", descriptors, fileno(out_.get()));
    if (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, temporary_.c_str(), AT_SYMLINK_FOLLOW) != 0)
      fail(fmt::format(": {}", std::strerror(errno)));
    named_ = true;
  }
  if (std::fclose(out_.release()) != 0) fail(no_room);
  if (std::rename(temporary_.c_str(), file_.c_str()) != 0) fail(fmt::format(": {}", std::strerror(errno)));
  named_ = false;
}

void GrowingFile::fail(const std::string& why) const {
  throw InputError(fmt::format("{}: cannot be written{}", file_.string(), why));
}

}  // namespace crosscheck
