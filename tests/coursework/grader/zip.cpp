#include "tests/coursework/grader/zip.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/core.h>

#include <memory>
#include <stdexcept>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/growing_file.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

constexpr size_t block = 1 << 16;

void check(archive* a, la_ssize_t result) {
  if (result < ARCHIVE_OK) throw std::runtime_error(fmt::format("zip: {}", archive_error_string(a)));
}

la_ssize_t append_to(archive*, void* to, const void* bytes, size_t size) {
  static_cast<std::string*>(to)->append(static_cast<const char*>(bytes), size);
  return static_cast<la_ssize_t>(size);
}

}  // namespace

void write_zip(const fs::path& zip, const std::map<std::string, std::string>& files) {
  // packed in memory, as the library leaks what it packs with where writing fails
  std::string packed;
  const std::unique_ptr<archive, int (*)(archive*)> out(archive_write_new(), archive_write_free);
  check(out.get(), archive_write_set_format_zip(out.get()));
  check(out.get(), archive_write_set_bytes_in_last_block(out.get(), 1));
  check(out.get(), archive_write_open(out.get(), &packed, nullptr, append_to, nullptr));
  const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(), archive_entry_free);
  for (const auto& [name, content] : files) {
    archive_entry_clear(entry.get());
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), content.starts_with("#!") ? 0755 : 0644);
    check(out.get(), archive_write_header(out.get(), entry.get()));
    check(out.get(), archive_write_data(out.get(), content.data(), content.size()));
  }
  check(out.get(), archive_write_close(out.get()));
  // it gets its name when it is whole: a full disk or a kill leaves no half zip
  crosscheck::GrowingFile file(zip);
  file.append(packed);
  file.finish();
}

void unpack_zip(const fs::path& zip, const fs::path& folder) {
  const std::unique_ptr<archive, int (*)(archive*)> in(archive_read_new(), archive_read_free);
  check(in.get(), archive_read_support_format_zip(in.get()));
  check(in.get(), archive_read_open_filename(in.get(), zip.c_str(), block));
  archive_entry* entry = nullptr;
  while (archive_read_next_header(in.get(), &entry) == ARCHIVE_OK) {
    const fs::path name = archive_entry_pathname(entry);
    if (name.is_absolute() || *name.lexically_normal().begin() == "..")
      throw std::runtime_error(fmt::format("{}: {} points outside of it", zip.string(), name.string()));
    if (archive_entry_filetype(entry) == AE_IFDIR) continue;
    std::string content, part(block, '\0');
    for (la_ssize_t got; (got = archive_read_data(in.get(), part.data(), part.size())) != 0;) {
      if (got < 0) throw std::runtime_error(fmt::format("{}: {}", zip.string(), archive_error_string(in.get())));
      content.append(part.data(), static_cast<size_t>(got));
    }
    crosscheck::write_file(folder / name, content);
    if (archive_entry_perm(entry) & 0100) fs::permissions(folder / name, fs::perms(0755));
  }
  if (const char* wrong = archive_error_string(in.get()))
    throw std::runtime_error(fmt::format("{}: {}", zip.string(), wrong));
}

}  // namespace coursework
