// Nameless files that get their name when they are whole, whole files, and temporary folders with an owner.
#include "mysim/base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

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

StreamingFile::~StreamingFile() {
  if (named_) unlink(temporary_.c_str());
}

void StreamingFile::append(std::string_view bytes) {
  assert(out_);  // not finished yet
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
  // a quarter of the memory that is left, as a tree or rows are made of it; asked for where it matters
  double most = 1 << 26;
  for (bool asked = false; in.read(block.data(), std::ssize(block)) || in.gcount() > 0;) {
    text.append(block, 0, static_cast<size_t>(in.gcount()));
    if (static_cast<double>(text.size()) <= most) continue;
    if (!asked) most = std::max(most, free_memory() / 4);
    std::error_code none;
    const double size = fs::is_regular_file(file, none) ? static_cast<double>(fs::file_size(file, none)) : 0;
    if (std::max(size, static_cast<double>(text.size())) > most)
      throw InputError(fmt::format("{}: expected a file of at most {}", file.string(), format_bytes(most)));
    asked = true;
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
  size_t kept = longest_derived_name - 17;                                   // a dash and 16 digits
  while ((static_cast<unsigned char>(name[kept]) & 0xc0u) == 0x80u) --kept;  // within a character
  return fmt::format("{}-{:016x}", name.substr(0, kept), Fnv1a::of(text));
}

namespace {

/// The start of a process in clock ticks since the boot; empty where there is none of that number.
std::string start_of(const std::string& process) {
  std::ifstream in("/proc/" + process + "/stat");
  std::string text;
  std::getline(in, text, '\0');
  // the name, which may hold anything, stands in brackets; 19 fields lie between the state and the start
  const size_t bracket = text.rfind(')');
  if (bracket == std::string::npos) return "";
  std::istringstream fields(text.substr(bracket + 1));
  std::string field;
  for (int i = 0; i < 20; ++i) fields >> field;
  return field;
}

}  // namespace

std::string pid_namespace_of(std::string_view process) {
  std::error_code error;
  std::string link = fs::read_symlink(fmt::format("/proc/{}/ns/pid", process), error).string();  // "pid:[4026531836]"
  std::erase_if(link, [](char c) { return c < '0' || c > '9'; });
  return link.empty() ? "0" : link;
}

std::string temporary_name(std::string_view purpose) {
  const std::string self = fmt::format("{}", getpid());
  return (fs::temp_directory_path() /
          fmt::format("crosscheck-{}-{}.{}.{}-XXXXXX", purpose, self, start_of(self), pid_namespace_of()))
      .string();
}

TemporaryFolder::TemporaryFolder(std::string_view purpose) {
  std::string name = temporary_name(purpose);
  if (!mkdtemp(name.data()))
    throw InputError(fmt::format("{}: no folder can be made there; expected a place for temporary files", name));
  path = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

namespace {

using IsGone = std::function<bool(const std::string&, const std::string&, const std::string&)>;

/// Removes what lies in that place under the name of a temporary folder, with `files` plain files and not folders, and
/// is this user's, where its owner (its number, when it was started, its namespace) is gone.
void remove_temporary(const fs::path& place, bool files, const IsGone& is_gone) {
  static const Pattern ours(R"(crosscheck-[a-z]+-([0-9]+)\.([0-9]*)\.([0-9]+)-[A-Za-z0-9]{6}(\.[a-z]+)?)");
  std::error_code error;
  for (fs::directory_iterator at(place, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with("crosscheck-")) continue;
    const auto parts = ours.match(name);
    if (!parts || !is_gone((*parts)[1], (*parts)[2], (*parts)[3])) continue;
    struct stat about {};
    if (lstat(at->path().c_str(), &about) != 0 || !(files ? S_ISREG(about.st_mode) : S_ISDIR(about.st_mode))) continue;
    std::error_code ignored;
    if (about.st_uid == geteuid() || geteuid() == 0) fs::remove_all(at->path(), ignored);
  }
}

IsGone of_ended_processes() {
  return [here = pid_namespace_of()](const std::string& owner, const std::string& start, const std::string& space) {
    return space == here && (start.empty() || start_of(owner) != start);
  };
}

/// Where temporary files go; a folder that is not there has nothing in it.
fs::path temporary_place() {
  std::error_code ignored;
  return fs::temp_directory_path(ignored);
}

}  // namespace

void remove_stale_temporary_folders() { remove_temporary(temporary_place(), false, of_ended_processes()); }

void remove_stale_files(const fs::path& folder) { remove_temporary(folder, true, of_ended_processes()); }

void remove_temporary_folders_of(const std::string& pid_namespace) {
  remove_temporary(temporary_place(), false, [&](const std::string&, const std::string&, const std::string& space) {
    return space == pid_namespace;
  });
}

}  // namespace crosscheck
