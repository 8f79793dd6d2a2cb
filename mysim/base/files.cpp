#include "mysim/base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

#include "mysim/base/errors.h"
#include "mysim/base/hash.h"
#include "mysim/base/names.h"
#include "mysim/base/pattern.h"
#include "mysim/base/text.h"
#include "mysim/base/this_process.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr auto no_room = "; expected a folder with write permission and free space";
constexpr auto descriptors = "/proc/self/fd";

}  // namespace

StreamingFile::StreamingFile(fs::path file)
    : file_(std::move(file)), temporary_(fs::path(file_) += fmt::format(".{}.part", getpid())) {
  const fs::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  constexpr mode_t mode = 0666;  // reduced by the umask
  int descriptor = -1;
  if (access(descriptors, X_OK) == 0)  // needed to name the file later
    descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
  if (descriptor < 0) {
    descriptor = open(temporary_.c_str(), O_CREAT | O_TRUNC | O_RDWR | O_CLOEXEC, mode);
    named_ = descriptor >= 0;
  }
  if (descriptor < 0) fail(no_room);
  out_.reset(fdopen(descriptor, "w"));
  if (!out_) fail(no_room);
}

StreamingFile::~StreamingFile() {
  if (named_) unlink(temporary_.c_str());
}

void StreamingFile::append(std::string_view bytes) {
  assert(out_);
  if (std::fwrite(bytes.data(), 1, bytes.size(), out_.get()) != bytes.size()) fail(no_room);
}

void StreamingFile::rewrite_beginning(std::string_view bytes) {
  if (std::fseek(out_.get(), 0, SEEK_SET) != 0) fail(no_room);
  append(bytes);
  if (std::fseek(out_.get(), 0, SEEK_END) != 0) fail(no_room);
}

void StreamingFile::finish() {
  if (std::fflush(out_.get()) != 0) fail(no_room);
  if (!named_) {
    // a process with the same id may have left a file of this name, if it was killed before the rename
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

void StreamingFile::fail(const std::string& why) const {
  throw InputError(fmt::format("{}: cannot be written{}", file_.string(), why));
}

void write_file(const fs::path& file, std::string_view content) {
  StreamingFile growing(file);
  growing.append(content);
  growing.finish();
}

std::optional<std::string> try_read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text, block(1 << 16, '\0');
  // Documents and tables made from the text need more memory than the text itself. The free memory is read only for
  // large files.
  double most = 1 << 26;
  for (bool asked = false; in.read(block.data(), std::ssize(block)) || in.gcount() > 0;) {
    text.append(block, 0, static_cast<size_t>(in.gcount()));
    if (static_cast<double>(text.size()) <= most) continue;
    if (!asked) most = std::max(most, free_memory() / 4);
    asked = true;
    std::error_code none;
    const double size = fs::is_regular_file(file, none) ? static_cast<double>(fs::file_size(file, none)) : 0;
    if (std::max(size, static_cast<double>(text.size())) > most)
      throw InputError(fmt::format("{}: expected a file of at most {}", file.string(), format_bytes(most)));
  }
  if (!in.eof()) return std::nullopt;
  return text;
}

std::string read_file(const fs::path& file, std::string_view expected) {
  errno = 0;
  if (std::optional<std::string> text = try_read_file(file)) return *std::move(text);
  const std::string why = errno != 0 ? fmt::format(" ({})", std::strerror(errno)) : "";
  std::error_code unknown;
  throw InputError(fmt::format("{}: cannot be read; expected {}{}", file.string(), expected,
                               fs::is_directory(file, unknown) ? ", got a folder" : why));
}

double free_disk(const fs::path& folder) {
  std::error_code unknown;
  fs::path place = fs::absolute(folder, unknown);
  while (!fs::exists(place, unknown) && place.has_relative_path()) place = place.parent_path();
  struct statvfs about {};
  if (statvfs(place.c_str(), &about) != 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(about.f_bavail) * static_cast<double>(about.f_frsize);
}

void require_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder) || access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(fmt::format("--out {}: expected a folder that can be made and written to", folder.string()));
}

std::string file_name_of(std::string_view text) {
  std::string name;
  for (size_t at = 0; at < text.size();) {
    const std::string_view sign = text.substr(at, std::max<size_t>(1, utf8_length(text, at)));
    const bool plain = std::isalnum(static_cast<unsigned char>(sign[0])) ||
                       std::string_view("._=+-").find(sign[0]) != std::string_view::npos;
    name += plain || (sign.size() > 1 && is_printable(sign)) ? sign : "-";
    at += sign.size();
  }
  if (name.size() <= longest_derived_name) return name;
  size_t kept = longest_derived_name - 17;                                   // minus a dash and 16 digits
  while ((static_cast<unsigned char>(name[kept]) & 0xc0u) == 0x80u) --kept;  // do not cut inside a UTF-8 character
  return fmt::format("{}-{:016x}", name.substr(0, kept), Fnv1a::of(text));
}

// The process that makes a temporary folder keeps it locked until the process ends. A lock, unlike a process id, means
// the same in every pid namespace.

TemporaryFolder::TemporaryFolder(std::string_view purpose, const fs::path& place) {
  // a name pattern that no user folder has; remove_stale_temporary_folders() relies on it
  const fs::path name = (place.empty() ? fs::temp_directory_path() : place) /
                        fmt::format("crosscheck-{}-{}.tmp-XXXXXX", purpose, getpid());
  // retry if another process took the new folder for a stale one
  for (bool stale = true; stale;) {
    if (lock_ >= 0) close(lock_);
    std::string made = name.string();
    if (!mkdtemp(made.data()))
      throw InputError(
          fmt::format("{}: cannot create a folder there; expected a place for temporary files", name.string()));
    path = made;
    lock_ = open(made.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    stale = (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) || !fs::exists(path);
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
  if (lock_ >= 0) close(lock_);
}

void remove_stale_temporary_folders(const fs::path& place) {
  static const Pattern ours("crosscheck-[a-z]+-[0-9]+\\.tmp-[A-Za-z0-9]{6}");
  std::error_code error;
  for (fs::directory_iterator at(place.empty() ? fs::temp_directory_path(error) : place, error), last;
       !error && at != last; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with("crosscheck-") || !ours.match(name)) continue;
    const int folder = open(at->path().c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    struct stat about {};
    std::error_code ignored;
    if (folder >= 0 && fstat(folder, &about) == 0 && (about.st_uid == geteuid() || geteuid() == 0) &&
        flock(folder, LOCK_EX | LOCK_NB) == 0)
      fs::remove_all(at->path(), ignored);
    if (folder >= 0) close(folder);
  }
}

}  // namespace crosscheck
