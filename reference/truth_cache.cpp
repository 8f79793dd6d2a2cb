// One file: checksum, key, answer, in the machine's own byte order (it never leaves the machine).
#include "reference/truth_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/fnv.h"
#include "reference/build_id.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr auto extension = ".truth";
constexpr int rule_of_bars = 2;  // raised with what a truth's error bar means: no answer of an older rule is found

class Writer {
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

struct Damaged {};

/// Reads what Writer wrote; throws Damaged where there is less than announced.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : left_(bytes) {}
  std::uint64_t count() { return take<std::uint64_t>(); }
  double number() { return take<double>(); }
  std::string text() { return std::string(cut(count())); }
  std::vector<double> numbers() {
    const std::uint64_t n = count();
    std::vector<double> values(n <= left_.size() / sizeof(double) ? n : throw Damaged());
    std::memcpy(values.data(), cut(sizeof(double) * n).data(), sizeof(double) * n);
    return values;
  }
  std::vector<Points> frames() {
    std::vector<Points> frames;
    for (std::uint64_t i = count(); i > 0; --i) {
      const std::uint64_t n = count();
      if (n > left_.size() / (3 * sizeof(double))) throw Damaged();
      Points x(3, static_cast<long>(n));
      std::memcpy(x.data(), cut(3 * sizeof(double) * n).data(), 3 * sizeof(double) * n);
      frames.push_back(std::move(x));
    }
    return frames;
  }

 private:
  std::string_view cut(std::uint64_t size) {
    if (size > left_.size()) throw Damaged();
    const std::string_view part = left_.substr(0, size);
    left_.remove_prefix(size);
    return part;
  }
  template <class T>
  T take() {
    T value;
    std::memcpy(&value, cut(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view left_;
};

std::string packed(const std::string& key, const std::optional<Truth>& truth) {
  Writer w;
  w.add(key);
  w.add(std::uint64_t{truth.has_value()});
  if (truth) {
    w.add(static_cast<std::uint64_t>(truth->tier));
    w.add(truth->how);
    w.add(truth->trajectory.t);
    w.add(truth->trajectory.x);
    w.add(truth->trajectory.v);
    w.add(truth->bar);
    w.add(truth->bars);
    w.add(std::uint64_t{truth->of_contact_rule});
    w.add(truth->until);
  }
  Writer sum;
  sum.add(Fnv1a::of(w.bytes()));
  return sum.bytes() + w.bytes();
}

/// The answer in the file; throws Damaged where it is none, or another one's.
std::optional<Truth> unpacked(const std::string& key, const std::string& file) {
  Reader r(file);
  if (r.count() != Fnv1a::of(std::string_view(file).substr(sizeof(std::uint64_t))) || r.text() != key) throw Damaged();
  if (r.count() == 0) return std::nullopt;
  Truth truth{};
  truth.tier = static_cast<Tier>(r.count());
  truth.how = r.text();
  truth.trajectory.t = r.numbers();
  truth.trajectory.x = r.frames();
  truth.trajectory.v = r.frames();
  truth.bar = r.number();
  truth.bars = r.numbers();
  truth.of_contact_rule = r.count() != 0;
  truth.until = r.number();
  return truth;
}

/// Answers of programs that are gone would pile up: what is older than a month goes.
void forget_old(const fs::path& folder) {
  std::error_code error;
  const auto limit = fs::file_time_type::clock::now() - std::chrono::hours(30 * 24);
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::error_code each;
    const auto kind = entry.path().extension();
    if ((kind == extension || kind == ".lock") && entry.last_write_time(each) < limit && !each)
      fs::remove(entry.path(), each);
  }
}

/// The stored answer, or nothing where there is none or it is damaged.
std::optional<std::optional<Truth>> stored_in(const fs::path& file, const std::string& key) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  const std::string content((std::istreambuf_iterator<char>(in)), {});
  try {
    return unpacked(key, content);
  } catch (const Damaged&) {
    return std::nullopt;
  }
}

/// Holds a file's lock while it lives; a process that dies lets go of it. Where no lock can be had, nobody waits.
class Lock {
 public:
  explicit Lock(const fs::path& file) {
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    handle_ = open((file.string() + ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (handle_ >= 0) flock(handle_, LOCK_EX);
  }
  ~Lock() {
    if (handle_ >= 0) close(handle_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int handle_;
};

}  // namespace

std::optional<TruthCache> TruthCache::of_environment() {
  const std::string program = build_id();
  const auto named = [](const char* variable) {
    const char* value = std::getenv(variable);
    return std::string(value ? value : "");
  };
  fs::path folder = named("CROSSCHECK_CACHE");
  if (folder.empty() && !named("XDG_CACHE_HOME").empty()) folder = fs::path(named("XDG_CACHE_HOME")) / "crosscheck";
  if (folder.empty() && !named("HOME").empty()) folder = fs::path(named("HOME")) / ".cache" / "crosscheck";
  if (folder.empty() || program.empty()) return std::nullopt;
  return TruthCache(folder, program);
}

std::string TruthCache::key_of(const Scene& scene, const Run& run) const {
  // the hash is taken anew: a scene changed in memory keeps that of its file
  return fmt::format("{} bars {} {} {:a} {:a} {} {}", program_, rule_of_bars, hash_of(scene), scene.step, run.duration,
                     run.samples, scene.window);
}

fs::path TruthCache::file_at(const std::string& key) const {
  return folder_ / fmt::format("{:016x}{}", Fnv1a::of(key), extension);
}

fs::path TruthCache::file_of(const Scene& scene, const Run& run) const { return file_at(key_of(scene, run)); }

std::optional<Truth> TruthCache::find_or(const Scene& scene, const Run& run,
                                         const std::function<std::optional<Truth>()>& compute) const {
  const std::string key = key_of(scene, run);
  const fs::path file = file_at(key);
  if (auto stored = stored_in(file, key)) return *stored;
  // processes of one sweep ask for the same answer at the same time: one computes, the others wait
  const Lock lock(file);
  if (auto stored = stored_in(file, key)) return *stored;
  std::optional<Truth> truth = compute();
  try {
    write_file(file, packed(key, truth));
    forget_old(folder_);
  } catch (const InputError&) {
    // no room or no right to write: then the next run computes it again
  }
  return truth;
}

}  // namespace crosscheck
