// Affinity masks, the lock file, and what Linux reports of the processor.
#include "experiments/timing/machine.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace crosscheck {

int cores_allowed() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(1, CPU_COUNT(&set));
}

void pin_to_one_core() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return;
  for (int core = CPU_SETSIZE - 1; core >= 0; --core) {
    if (!CPU_ISSET(core, &set)) continue;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(core, &one);
    sched_setaffinity(0, sizeof one, &one);
    return;
  }
}

LockPatience::LockPatience(double seconds) {
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
  shared_.reset(new (memory) Shared{seconds, seconds}, [](Shared* shared) { munmap(shared, sizeof(Shared)); });
}

namespace {

/// "process 12 (crosscheck report) since 12:03:04" of a process that holds the file's lock; "another process" if none
/// is seen, as in another container.
std::string holder_of(int handle) {
  constexpr auto unknown = "another process";
  struct stat file {};
  if (fstat(handle, &file) != 0) return unknown;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    char kind[16] = "", state[16] = "", mode[16] = "";
    long process = 0;
    unsigned long inode = 0;
    if (std::sscanf(line.c_str(), "%*d: %15s %15s %15s %ld %*x:%*x:%lu", kind, state, mode, &process, &inode) != 5 ||
        std::string_view(kind) != "FLOCK" || inode != file.st_ino || process <= 0)
      continue;
    std::ifstream in(fmt::format("/proc/{}/cmdline", process));
    std::string command;
    std::getline(in, command);
    for (char& c : command)
      if (static_cast<unsigned char>(c) < ' ') c = ' ';  // the words end in zeros
    struct stat begun {};
    std::string since;
    if (stat(fmt::format("/proc/{}", process).c_str(), &begun) == 0) {
      char text[16] = "";
      std::tm local{};
      if (localtime_r(&begun.st_mtim.tv_sec, &local) && std::strftime(text, sizeof text, "%H:%M:%S", &local) > 0)
        since = fmt::format(", begun at {}", text);
    }
    return fmt::format("process {} ({}{})", process, command.substr(0, 60), since);
  }
  return unknown;
}

}  // namespace

MachineLock::MachineLock(Mode mode, const LockPatience& patience) {
  const char* named = std::getenv("CROSSCHECK_LOCK");
  const std::string file = named && *named ? named : fmt::format("/tmp/crosscheck-{}.lock", getuid());
  handle_ = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (handle_ < 0) return;
  LockPatience::Shared& shared = *patience.shared_;
  while (!(held_ = flock(handle_, (mode == Mode::exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) && shared.left > 0) {
    if (shared.left < shared.total - 1 && !shared.announced.exchange(true))
      fmt::print(stderr, "crosscheck: waiting at most {:.0f} s for {} to release {}\n", shared.left.load(),
                 holder_of(handle_), file);
    const auto begun = std::chrono::steady_clock::now();
    usleep(50000);
    // measured: on a busy machine the pause takes longer than that
    shared.left -= std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  }
  if (!held_ && !shared.exhausted.exchange(true))
    fmt::print(stderr, "crosscheck: {} is still held; times are measured beside other work and marked\n", file);
}

MachineLock::~MachineLock() {
  if (handle_ >= 0) close(handle_);
}

namespace {

namespace fs = std::filesystem;

/// The fields of the first processor; the blank line after it ends them.
std::map<std::string, std::string> first_processor(const fs::path& cpuinfo) {
  std::map<std::string, std::string> fields;
  std::ifstream in(cpuinfo);
  for (std::string line; std::getline(in, line) && !(line.empty() && !fields.empty());) {
    const size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const size_t name_end = line.find_last_not_of(" \t", colon - 1), value = line.find_first_not_of(" \t", colon + 1);
    if (name_end == std::string::npos || value == std::string::npos) continue;
    std::string text = line.substr(value);
    std::replace(text.begin(), text.end(), '|', '/');  // which parts the fields of a file
    fields.emplace(line.substr(0, name_end + 1), text);
  }
  return fields;
}

/// The instruction sets that arithmetic may use; others come and go with the kernel.
std::string arithmetic_of(const std::string& flags) {
  constexpr std::string_view kinds[] = {"sse", "ssse", "avx", "fma", "bmi", "f16c", "adx", "amx", "asimd", "sve"};
  std::vector<std::string> sets;
  std::istringstream in(flags);
  for (std::string flag; in >> flag;)
    if (std::any_of(std::begin(kinds), std::end(kinds), [&](std::string_view kind) { return flag.starts_with(kind); }))
      sets.push_back(flag);
  std::sort(sets.begin(), sets.end());
  std::string text;
  for (const std::string& set : sets) text += (text.empty() ? "" : " ") + set;
  return text;
}

std::string word_in(const fs::path& file) {
  std::ifstream in(file);
  std::string word;
  in >> word;
  return word;
}

/// "L1d 32K, L2 512K, L3 32768K"
std::string caches_in(const fs::path& folder) {
  std::vector<std::string> caches;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string level = word_in(entry.path() / "level"), type = word_in(entry.path() / "type"),
                      size = word_in(entry.path() / "size");
    if (level.empty() || size.empty() || type == "Instruction") continue;
    caches.push_back(fmt::format("L{}{} {}", level, type == "Data" ? "d" : "", size));
  }
  std::sort(caches.begin(), caches.end());
  std::string text;
  for (const std::string& cache : caches) text += (text.empty() ? "" : ", ") + cache;
  return text;
}

}  // namespace

std::string processor_kind(const fs::path& cpuinfo, const fs::path& caches) {
  const auto fields = first_processor(cpuinfo);
  std::string kind;
  const auto add = [&](const std::string& text) { kind += (kind.empty() ? "" : ", ") + text; };
  bool numbered = false;
  if (const auto name = fields.find("model name"); name != fields.end()) add(name->second);
  // what x86 and what ARM call their make; a name alone identifies nothing
  for (const char* number :
       {"cpu family", "model", "stepping", "CPU implementer", "CPU variant", "CPU part", "CPU revision"})
    if (const auto field = fields.find(number); field != fields.end()) {
      add(fmt::format("{} {}", number, field->second));
      numbered = true;
    }
  if (!numbered) return "";
  if (const std::string sizes = caches_in(caches); !sizes.empty()) add(sizes);
  for (const char* list : {"flags", "Features"})
    if (const auto field = fields.find(list); field != fields.end()) add(arithmetic_of(field->second));
  return kind;
}

std::string processor_kind() { return processor_kind("/proc/cpuinfo", "/sys/devices/system/cpu/cpu0/cache"); }

}  // namespace crosscheck
