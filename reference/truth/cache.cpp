#include "reference/truth/cache.h"

#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/installation.h"

namespace crosscheck {
namespace {

/// Callback for the program and then for each of its libraries, until it returns nonzero.
int find_build_id_note(dl_phdr_info* object, size_t, void* out) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const char* at = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
    const char* end = at + segment.p_memsz;
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof note);
      const auto padded = [](size_t size) { return (size + 3) / 4 * 4; };
      const char* name = at + sizeof note;
      const char* content = name + padded(note.n_namesz);
      if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(name, "GNU", 4) == 0) {
        for (size_t byte = 0; byte < note.n_descsz; ++byte)
          *static_cast<std::string*>(out) += fmt::format("{:02x}", static_cast<unsigned char>(content[byte]));
        return 1;
      }
      at = content + padded(note.n_descsz);
    }
  }
  return 1;
}

}  // namespace

std::string build_id() {
  std::string id;
  dl_iterate_phdr(find_build_id_note, &id);
  return id;
}

namespace fs = std::filesystem;
namespace {

constexpr auto extension = ".truth";
constexpr int error_bar_version =
    5;  // increased when the meaning of error bars changes, so that older truths are not found

class ByteWriter {
 public:
  void add(double value) { add_bytes(&value, sizeof value); }
  void add(std::uint64_t value) { add_bytes(&value, sizeof value); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    bytes_ += text;
  }
  void add(const std::vector<double>& values) {
    add(std::uint64_t{values.size()});
    add_bytes(values.data(), sizeof(double) * values.size());
  }
  void add(const std::vector<Points>& frames) {
    add(std::uint64_t{frames.size()});
    for (const Points& x : frames) {
      add(static_cast<std::uint64_t>(x.cols()));
      add_bytes(x.data(), sizeof(double) * static_cast<size_t>(x.size()));
    }
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void add_bytes(const void* from, size_t count) { bytes_.append(static_cast<const char*>(from), count); }
  std::string bytes_;
};

struct CorruptFile {};

/// Reads the output of ByteWriter; throws CorruptFile if it is too short.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : remaining_(bytes) {}
  std::uint64_t count() { return take_value<std::uint64_t>(); }
  double number() { return take_value<double>(); }
  std::string text() { return std::string(take_bytes(count())); }
  std::vector<double> numbers() {
    const std::uint64_t n = count();
    std::vector<double> values(n <= remaining_.size() / sizeof(double) ? n : throw CorruptFile());
    const std::string_view bytes = take_bytes(sizeof(double) * n);
    if (n > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  std::vector<Points> frames() {
    std::vector<Points> frames;
    for (std::uint64_t i = count(); i > 0; --i) {
      const std::uint64_t n = count();
      if (n > remaining_.size() / (3 * sizeof(double))) throw CorruptFile();
      Points x(3, static_cast<long>(n));
      std::memcpy(x.data(), take_bytes(3 * sizeof(double) * n).data(), 3 * sizeof(double) * n);
      frames.push_back(std::move(x));
    }
    return frames;
  }

 private:
  std::string_view take_bytes(std::uint64_t size) {
    if (size > remaining_.size()) throw CorruptFile();
    const std::string_view part = remaining_.substr(0, size);
    remaining_.remove_prefix(size);
    return part;
  }
  template <class T>
  T take_value() {
    T value;
    std::memcpy(&value, take_bytes(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view remaining_;
};

std::string serialized(const std::string& key, const std::optional<Truth>& truth) {
  ByteWriter w;
  w.add(key);
  w.add(std::uint64_t{truth.has_value()});
  if (truth) {
    w.add(static_cast<std::uint64_t>(truth->tier));
    w.add(truth->how);
    w.add(truth->trajectory.t);
    w.add(truth->trajectory.x);
    w.add(truth->trajectory.v);
    w.add(truth->error_bar);
    w.add(truth->error_bars);
    w.add(std::uint64_t{truth->under_contact_rule});
    w.add(truth->until);
    w.add(truth->contact);
    w.add(truth->contact_bars);
  }
  ByteWriter sum;
  sum.add(Fnv1a::of(w.bytes()));
  return sum.bytes() + w.bytes();
}

/// The truth in a file; throws CorruptFile if the file contains none, or the truth for another key.
std::optional<Truth> deserialized(const std::string& key, const std::string& file) {
  ByteReader r(file);
  if (r.count() != Fnv1a::of(std::string_view(file).substr(sizeof(std::uint64_t))) || r.text() != key)
    throw CorruptFile();
  if (r.count() == 0) return std::nullopt;
  Truth truth{};
  truth.tier = static_cast<Tier>(r.count());
  truth.how = r.text();
  truth.trajectory.t = r.numbers();
  truth.trajectory.x = r.frames();
  truth.trajectory.v = r.frames();
  truth.error_bar = r.number();
  truth.error_bars = r.numbers();
  truth.under_contact_rule = r.count() != 0;
  truth.until = r.number();
  truth.contact = r.numbers();
  truth.contact_bars = r.numbers();
  return truth;
}

/// Removes files older than a month, which accumulate because no later build reads them.
void remove_old_files(const fs::path& folder) {
  std::error_code error;
  const auto limit = fs::file_time_type::clock::now() - std::chrono::hours(30 * 24);
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::error_code each;
    const auto kind = entry.path().extension();
    if ((kind == extension || kind == ".lock") && entry.last_write_time(each) < limit && !each)
      fs::remove(entry.path(), each);
  }
}

/// The stored truth, or the stored statement that there is none; nullopt if the file is missing or damaged.
std::optional<std::optional<Truth>> load_file(const fs::path& file, const std::string& key) {
  const std::optional<std::string> content = try_read_file(file);
  if (!content) return std::nullopt;
  try {
    return deserialized(key, *content);
  } catch (const CorruptFile&) {
    return std::nullopt;
  }
}

/// Holds a file's lock until destroyed or until the process dies. Does not wait if no lock can be obtained.
class FileLock {
 public:
  explicit FileLock(const fs::path& file) {
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    handle_ = open((file.string() + ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (handle_ >= 0) flock(handle_, LOCK_EX);
  }
  ~FileLock() {
    if (handle_ >= 0) close(handle_);
  }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int handle_;
};

}  // namespace

std::optional<TruthCache> TruthCache::from_environment() {
  const std::string program = build_id();
  const auto folder = cache_folder();
  if (!folder || program.empty()) return std::nullopt;
  return TruthCache(*folder, program);
}

std::string TruthCache::key_of(const Scene& scene, const Run& run) const {
  // a scene changed in memory keeps its file's hash, so the hash is computed anew
  return fmt::format("{} bars {} {} {:a} {:a} {} {}", program_, error_bar_version, hash_of(scene), scene.step,
                     run.duration, run.samples, scene.window);
}

fs::path TruthCache::file_at(const std::string& key) const {
  return folder_ / fmt::format("{:016x}{}", Fnv1a::of(key), extension);
}

fs::path TruthCache::file_of(const Scene& scene, const Run& run) const { return file_at(key_of(scene, run)); }

std::optional<Truth> TruthCache::find_or_compute(const Scene& scene, const Run& run,
                                                 const std::function<std::optional<Truth>()>& compute) const {
  const std::string key = key_of(scene, run);
  const fs::path file = file_at(key);
  if (auto stored = load_file(file, key)) return *stored;
  // processes of a sweep need the same truth at the same time: one computes it, the others wait
  const FileLock lock(file);
  if (auto stored = load_file(file, key)) return *stored;
  std::optional<Truth> truth = compute();
  try {
    write_file(file, serialized(key, truth));
    remove_old_files(folder_);
  } catch (const InputError&) {
    // disk full or read-only: the next run computes it again
  }
  return truth;
}

}  // namespace crosscheck
