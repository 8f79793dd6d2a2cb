#include "mysim/base/names.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// Code point of a valid UTF-8 character.
char32_t code_point(std::string_view bytes) {
  const auto first = static_cast<unsigned char>(bytes[0]);
  char32_t code = bytes.size() == 1 ? first : first & (0x7fu >> bytes.size());
  for (const char c : bytes.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3fu);
  return code;
}

/// Control characters (Cc), line and paragraph separators, and invisible format characters (Cf): soft hyphen, Arabic
/// letter mark, zero-width and bidirectional characters, language tags.
bool is_hidden(char32_t c) {
  constexpr std::pair<char32_t, char32_t> ranges[] = {
      {0x00, 0x1f},     {0x7f, 0x9f},     {0xad, 0xad},     {0x61c, 0x61c},   {0x115f, 0x1160},
      {0x17b4, 0x17b5}, {0x180b, 0x180f}, {0x200b, 0x200f}, {0x2028, 0x202e}, {0x2060, 0x206f},
      {0x3164, 0x3164}, {0xfeff, 0xfeff}, {0xffa0, 0xffa0}, {0xfff0, 0xfffb}, {0xe0000, 0xe0fff}};
  return std::ranges::any_of(ranges, [&](const auto& range) { return range.first <= c && c <= range.second; });
}

/// Length in bytes of the character at `at`, or 0 if no printable character begins there.
std::size_t printable_length(std::string_view text, std::size_t at) {
  const std::size_t length = utf8_length(text, at);
  return length > 0 && !is_hidden(code_point(text.substr(at, length))) ? length : 0;
}

}  // namespace

bool is_printable(std::string_view text) {
  for (std::size_t at = 0, length; at < text.size(); at += length)
    if ((length = printable_length(text, at)) == 0) return false;
  return true;
}

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = text[at] == '\n' || text[at] == '\t' ? 1 : printable_length(text, at);
    out += length > 0 ? text.substr(at, length) : "?";
    at += std::max({length, utf8_length(text, at), std::size_t{1}});
  }
  return out;
}

namespace {

/// A standard stream, and the first bytes of a UTF-8 character whose other bytes come with the next write.
struct TextStream {
  int file;
  std::string begun;

  static ssize_t write_text(void* cookie, const char* bytes, size_t size) {
    auto& self = *static_cast<TextStream*>(cookie);
    std::string text = self.begun + std::string(bytes, size);
    size_t whole = text.size();
    for (size_t back = 1; back <= std::min<size_t>(3, text.size()); ++back) {
      const auto byte = static_cast<unsigned char>(text[text.size() - back]);
      if (byte < 0x80) break;
      if (byte < 0xc0) continue;
      if (back < (byte < 0xe0 ? 2u : byte < 0xf0 ? 3u : 4u)) whole -= back;
      break;
    }
    self.begun = text.substr(whole);
    text = printable(std::string_view(text).substr(0, whole));
    for (size_t done = 0; done < text.size();) {
      const ssize_t written = write(self.file, text.data() + done, text.size() - done);
      if (written < 0 && errno != EINTR) return 0;  // reported as an error of the stream
      if (written > 0) done += static_cast<size_t>(written);
    }
    return static_cast<ssize_t>(size);
  }
};

}  // namespace

void print_only_text() {
  const auto replace = [](FILE*& stream, int file, int buffering) {
    FILE* text = fopencookie(new TextStream{file, ""}, "w", {nullptr, &TextStream::write_text, nullptr, nullptr});
    if (!text) return;
    setvbuf(text, nullptr, buffering, BUFSIZ);
    std::fflush(stream);
    stream = text;
  };
  replace(stdout, STDOUT_FILENO, isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF);
  replace(stderr, STDERR_FILENO, _IONBF);
}

bool is_name(std::string_view text, std::size_t most) {
  return !text.empty() && text.size() <= most && text[0] != '-' && text[0] != '.' &&
         text.find('/') == std::string_view::npos && is_printable(text);
}

const std::string& require_name(const std::string& name, const std::string& place, std::size_t most) {
  if (!is_name(name, most))
    throw InputError(
        fmt::format("{}: expected a name of 1 to {} bytes of UTF-8 without '/' and invisible characters "
                    "that does not begin with '-' or '.', got {}",
                    place, most, shell_quote(name.substr(0, 60))));
  return name;
}

void require_cell(const std::string& column, const std::string& text) {
  const bool name = column == "scene" || column.find("method") != std::string::npos;
  if (name ? !is_printable(text) : printable(text) != text)
    throw InputError(fmt::format("column {}: expected text without control and hidden characters, got {}",
                                 printable(column), shell_quote(text.substr(0, 60))));
}

bool is_path_inside(std::string_view path) {
  return path.size() <= 1024 && is_printable(path) &&
         std::ranges::all_of(split(path, '/'), [](const std::string& part) {
           return !part.empty() && part.size() <= 255 && part != "." && part != "..";
         });
}

namespace {

void require_plain(const fs::path& path) {
  const fs::file_status status = fs::symlink_status(path);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
    throw InputError(fmt::format("{}: expected a file or folder, got {}", path.string(),
                                 fs::is_symlink(status) ? "a symbolic link" : "a device, pipe or socket"));
}

}  // namespace

fs::path path_inside(const fs::path& folder, const std::string& path) {
  if (!is_path_inside(path))
    throw InputError(fmt::format("{}: expected the path of a file inside this folder, got {}", folder.string(),
                                 shell_quote(path.substr(0, 60))));
  fs::path at = folder;
  for (const fs::path& part : fs::path(path)) require_plain(at /= part);
  return at;
}

void require_plain_files(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!is_printable(name))
      throw InputError(
          fmt::format("{}: expected printable names of files, got {}", folder.string(), shell_quote(name)));
    require_plain(entry.path());
  }
}

}  // namespace crosscheck
