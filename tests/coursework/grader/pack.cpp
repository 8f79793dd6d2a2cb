#include "tests/coursework/grader/pack.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/names.h"
#include "mysim/base/text.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/container.h"
#include "tests/coursework/grader/python.h"
#include "tests/coursework/grader/submission.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

constexpr size_t block_size = 1 << 16;

void check_archive(archive* a, la_ssize_t result) {
  if (result < ARCHIVE_OK) throw std::runtime_error(fmt::format("zip: {}", archive_error_string(a)));
}

la_ssize_t append_to(archive*, void* to, const void* bytes, size_t size) {
  static_cast<std::string*>(to)->append(static_cast<const char*>(bytes), size);
  return static_cast<la_ssize_t>(size);
}

}  // namespace

void write_zip(const fs::path& zip, const std::map<std::string, std::string>& files) {
  // packed in memory, because the library leaks its buffers if writing fails
  std::string packed;
  const std::unique_ptr<archive, int (*)(archive*)> out(archive_write_new(), archive_write_free);
  check_archive(out.get(), archive_write_set_format_zip(out.get()));
  check_archive(out.get(), archive_write_set_bytes_in_last_block(out.get(), 1));
  check_archive(out.get(), archive_write_open(out.get(), &packed, nullptr, append_to, nullptr));
  const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(), archive_entry_free);
  for (const auto& [name, content] : files) {
    archive_entry_clear(entry.get());
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), content.starts_with("#!") ? 0755 : 0644);
    check_archive(out.get(), archive_write_header(out.get(), entry.get()));
    check_archive(out.get(), archive_write_data(out.get(), content.data(), content.size()));
  }
  check_archive(out.get(), archive_write_close(out.get()));
  // renamed when complete, so that a full disk or a kill leaves no partial zip
  crosscheck::StreamingFile file(zip);
  file.append(packed);
  file.finish();
}

void unpack_zip(const fs::path& zip, const fs::path& folder) {
  const std::unique_ptr<archive, int (*)(archive*)> in(archive_read_new(), archive_read_free);
  check_archive(in.get(), archive_read_support_format_zip(in.get()));
  check_archive(in.get(), archive_read_open_filename(in.get(), zip.c_str(), block_size));
  archive_entry* entry = nullptr;
  size_t entries = 0, total = 0;
  while (archive_read_next_header(in.get(), &entry) == ARCHIVE_OK) {
    if (++entries > most_entries) throw std::runtime_error(fmt::format("{}: too many files", zip.string()));
    if (archive_entry_filetype(entry) == AE_IFDIR) continue;
    const char* named = archive_entry_pathname(entry);
    const std::string name = named ? named : "";
    if (!crosscheck::is_path_inside(name))
      throw std::runtime_error(
          fmt::format("{}: {} points outside of it", zip.string(), crosscheck::shell_quote(name.substr(0, 200))));
    std::string content, part(block_size, '\0');
    for (la_ssize_t got; (got = archive_read_data(in.get(), part.data(), part.size())) != 0;) {
      if (got < 0) throw std::runtime_error(fmt::format("{}: {}", zip.string(), archive_error_string(in.get())));
      if ((total += static_cast<size_t>(got)) > largest_total)
        throw std::runtime_error(fmt::format("{}: more than {} MB unpacked", zip.string(), largest_total >> 20));
      content.append(part.data(), static_cast<size_t>(got));
    }
    crosscheck::write_file(folder / name, content);
    if (archive_entry_perm(entry) & 0100) fs::permissions(folder / name, fs::perms(0755));
  }
  if (const char* wrong = archive_error_string(in.get()))
    throw std::runtime_error(fmt::format("{}: {}", zip.string(), wrong));
}

namespace {

/// The files that a file includes in quotes, relative to `root` or to the file's folder.
std::vector<std::string> includes_of(const fs::path& root, const std::string& file) {
  std::vector<std::string> found;
  std::ifstream in(root / file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("#include \"")) continue;
    const std::string name = line.substr(10, line.find('"', 10) - 10);
    const fs::path beside = (fs::path(file).parent_path() / name).lexically_normal();
    found.push_back(fs::exists(root / beside) ? beside.generic_string() : name);
  }
  return found;
}

bool has_main(const fs::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("int main(")) return true;
  return false;
}

/// True if `source` includes `header` and implements it. Programs with a main only use the header, and so do the calls
/// of public tests. These include "calls.h", a path that exists only where they are compiled with a submission.
bool belongs_to(const fs::path& root, const std::string& source, const std::string& header) {
  const auto its = includes_of(root, source);
  return !has_main(root / source) && std::find(its.begin(), its.end(), header) != its.end() &&
         std::all_of(its.begin(), its.end(), [&](const std::string& file) { return fs::exists(root / file); });
}

}  // namespace

std::vector<std::string> sources_needed(const fs::path& root, std::vector<std::string> first) {
  std::set<std::string> needed;
  std::vector<std::string> todo = std::move(first);
  auto want = [&](const fs::path& file) {
    if (fs::exists(root / file)) todo.push_back(file.generic_string());
  };
  while (!todo.empty()) {
    const std::string file = todo.back();
    todo.pop_back();
    if (!needed.insert(file).second) continue;
    for (const std::string& included : includes_of(root, file)) want(included);
    if (!file.ends_with(".h")) continue;
    want(fs::path(file).replace_extension(".cpp"));
    for (const auto& entry : fs::directory_iterator((root / file).parent_path())) {
      const fs::path beside = fs::relative(entry.path(), root);
      if (beside.extension() == ".cpp" && !fs::exists(fs::path(entry.path()).replace_extension(".h")) &&
          belongs_to(root, beside.generic_string(), file))
        want(beside);
    }
  }
  return {needed.begin(), needed.end()};
}

namespace {

using Files = std::map<std::string, std::string>;

constexpr const char* secret_file = "secret.txt";

void add_folder(Files& files, const fs::path& from, const std::string& to) {
  for (const auto& entry : fs::recursive_directory_iterator(from))
    if (entry.is_regular_file())
      files[to + "/" + fs::relative(entry.path(), from).generic_string()] = content_of_file(entry.path());
}

/// A library whose headers are packed: its folder, one header, and Debian's package.
struct HeaderLibrary {
  const char *folder, *header, *package;
};

/// Adds the libraries' headers. Throws crosscheck::InputError with the packages that are not installed.
void add_headers(Files& files) {
  constexpr HeaderLibrary libraries[] = {{"Eigen", "Core", "libeigen3-dev"},
                                         {"fmt", "core.h", "libfmt-dev"},
                                         {"nlohmann", "json.hpp", "nlohmann-json3-dev"},
                                         {"CLI", "CLI.hpp", "libcli11-dev"},
                                         {"toml++", "toml.h", "libtomlplusplus-dev"}};
  std::string missing;
  for (const auto& [folder, header, package] : libraries) {
    fs::path found;
    for (const char* place : {"/usr/include", "/usr/include/eigen3", "/usr/local/include", "/usr/local/include/eigen3"})
      if (found.empty() && fs::exists(fs::path(place) / folder / header)) found = fs::path(place) / folder;
    if (found.empty())
      missing += std::string(" ") + package;
    else
      add_folder(files, found, std::string("headers/") + folder);
  }
  if (!missing.empty())
    throw crosscheck::InputError(fmt::format(
        "the grader is packed with headers of libraries that are not here: apt-get install --no-install-recommends{}",
        missing));
}

std::string identifier_of(std::string_view assignment) {
  std::string name(assignment);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;  // the assignment is returned by a function whose name begins like this
}

/// The table of assignments with only the row of `only`, because sources of other assignments are not packed.
std::string table_of_one(const std::string& table, const Assignment& only) {
  std::string out;
  size_t begin = 0;
  for (size_t end; (end = table.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = table.substr(begin, end - begin);
    bool others = false;
    for (const Assignment& other : assignments())
      others |= other.name != only.name && line.find(" " + identifier_of(other.name)) != std::string::npos;
    if (!others) out += line + "\n";
  }
  return out;
}

/// All files of a package except its secret.
Files files_of_package(const Assignment& assignment) {
  const fs::path coursework = folder_of_coursework(), root = coursework.parent_path().parent_path();
  const std::string name(assignment.name), ours = "tests/coursework/" + name,
                                           table = "tests/coursework/grader/assignments.cpp";
  std::vector<std::string> first = {"tests/coursework/grader/main.cpp", table};
  for (const auto& entry : fs::directory_iterator(assignment.folder())) {
    const std::string file = entry.path().filename().string();
    if (file.starts_with("tests") && file.ends_with(".cpp")) first.push_back(ours + "/" + file);
  }
  Files files;
  std::string sources;
  for (const std::string& file : sources_needed(root, first)) {
    files[file] = file == table ? table_of_one(content_of_file(root / file), assignment) : content_of_file(root / file);
    if (file.ends_with(".cpp")) sources += file + "\n";
  }
  add_folder(files, coursework / "check", "tests/coursework/check");
  add_folder(files, coursework / "python", "tests/coursework/python");
  add_folder(files, assignment.folder(), ours);
  add_headers(files);
  files["sources.txt"] = sources;
  files["setup.sh"] = filled("package/setup", {});
  files["build.sh"] = filled("package/build", {name});
  files["run_autograder"] = filled("package/run_autograder", {name});
  return files;
}

}  // namespace

void write_package(const Assignment& assignment, const std::string& secret, const fs::path& zip) {
  Files files = files_of_package(assignment);
  files[secret_file] = secret + "\n";
  write_zip(zip, files);
}

std::string foreign_file(const Assignment& assignment, const fs::path& folder) {
  Files files = files_of_package(assignment);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) continue;
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    const auto ours = files.find(name);
    if (name != secret_file && (ours == files.end() || ours->second != content_of_file(entry.path()))) return name;
    files.erase(name);
  }
  return files.empty() ? "" : files.begin()->first;
}

namespace {

std::string last_lines(const fs::path& log) {
  const std::string text = content_of_file(log);
  constexpr size_t most = 1500;
  return text.size() > most ? "... " + text.substr(text.size() - most) : text;
}

/// Reports an error in the results of our own solution, or returns an empty string.
std::string wrong_with(const fs::path& results) {
  if (!fs::exists(results)) return "there is no results/results.json";
  try {
    const auto json = crosscheck::JsonField::parse(content_of_file(results), "results.json");
    double most = 0;
    for (const auto& test : json["tests"].elements()) {
      most += test["max_score"].number();
      if (test["status"].text() != "passed")
        return fmt::format("the solution fails test {}: {}", test["number"].text(), test["output"].text());
    }
    if (json["score"].number() != most || most != 100)
      return fmt::format("the solution gets {} of {} points", json["score"].dump(), most);
    if (json["extra_data"]["lane"].text() == "bare") return "submissions would run without a lane";
  } catch (const crosscheck::InputError& error) {
    return fmt::format("the results are not as documented: {}", error.what());
  }
  return "";
}

bool not_ready(const std::string& why) {
  fmt::print("not ready: {}\n", why);
  return false;
}

/// Runs the autograder on the submission in `root`. Reports an error, or returns "".
std::string rehearsed(const fs::path& root, const std::vector<std::string>& environment) {
  const Container container;
  const fs::path log = root / "log.txt";
  fmt::print("run_autograder on the solution: {} MB, {} CPU, {:.0f} s, no new namespaces\n", container.memory,
             container.cpus, container.time);
  std::fflush(stdout);
  const Usage used = run_in_container({(root / "run_autograder").string()}, environment, log, container);
  fmt::print("  {:.0f} s at {} CPU, {} MB\n{}", used.time, container.cpus, used.memory, last_lines(log));
  if (used.too_large) return fmt::format("it takes more than {} MB", container.memory);
  if (used.too_late) return fmt::format("it takes more than {:.0f} s", container.time);
  if (used.status != 0) return fmt::format("run_autograder ends with {}", used.status);
  return wrong_with(root / "results/results.json");
}

}  // namespace

bool rehearse(const Assignment& assignment, const fs::path& zip) {
  const crosscheck::TemporaryFolder scratch("rehearse");
  const fs::path root = scratch.path, source = root / "source", log = root / "log.txt";
  unpack_zip(zip, source);
  if (const std::string file = foreign_file(assignment, source); !file.empty())
    return not_ready(fmt::format("{} is not what this version packs, and nothing of it was run; pack it anew", file));
  const char* path = std::getenv("PATH");
  const std::vector<std::string> environment = {std::string("PATH=") + (path ? path : "/usr/bin:/bin"), "LANG=C",
                                                "HOME=" + root.string(), "AUTOGRADER_ROOT=" + root.string()};

  fmt::print("build.sh, with the packages of this machine (setup.sh would install its own first)\n");
  std::fflush(stdout);
  const Usage built = run_in_container({"/bin/sh", (source / "build.sh").string()}, environment, log,
                                       {.cpus = 1, .memory = 1 << 20, .time = 1800, .closed = false});
  fmt::print("  {:.0f} s on one CPU, {} MB\n{}", built.time, built.memory, last_lines(log));
  if (built.too_late) return not_ready("build.sh takes more than half an hour");
  if (built.status != 0) return not_ready(fmt::format("build.sh ends with {}", built.status));

  // Gradescope installs the script at this path
  fs::copy_file(source / "run_autograder", root / "run_autograder");
  for (const char* ending : {".cpp", ".py"}) {
    if (ending == std::string_view(".py") && (!has_python(assignment) || !missing_python_package().empty())) continue;
    fs::create_directories(root / "submission");
    fs::create_directories(root / "results");
    for (const auto& entry : fs::directory_iterator(assignment.folder() / "solution"))
      if (assignment.takes_whole_program() || entry.path().extension() == ending)
        fs::copy(entry.path(), root / "submission" / entry.path().filename());
    if (const std::string wrong = rehearsed(root, environment); !wrong.empty()) return not_ready(wrong);
    fs::remove_all(root / "submission");
    fs::remove_all(root / "results");
  }
  fmt::print("ready\n");
  return true;
}

}  // namespace coursework
