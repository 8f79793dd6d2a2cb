#include "tests/coursework/grader/build.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/installation.h"
#include "tests/coursework/grader/parallel.h"

namespace coursework {
namespace fs = std::filesystem;
using crosscheck::InputError;
namespace {

fs::path find_compiler() {
  if (const char* named = std::getenv("CXX"); named && named[0] == '/') return named;
  std::istringstream path(std::getenv("PATH") ? std::getenv("PATH") : "/usr/bin");
  std::vector<fs::path> folders;
  for (std::string folder; std::getline(path, folder, ':');) folders.push_back(folder);
  for (const char* name : {"g++", "clang++", "c++"})
    for (const fs::path& folder : folders) {
      // sandboxes cannot see the user's folder of ccache
      if (folder.string().find("ccache") != std::string::npos || access((folder / name).c_str(), X_OK) != 0) continue;
      const fs::path real = fs::canonical(folder / name);  // resolves links through /etc/alternatives
      return real.filename().string().find("++") != std::string::npos ? real : folder / name;
    }
  throw InputError("no C++ compiler found; expected g++ or clang++ on the PATH: apt-get install g++");
}

fs::path compiled_folder() {
  if (const auto cache = crosscheck::cache_folder()) return *cache / "coursework";
  return fs::temp_directory_path() / fmt::format("crosscheck-coursework-{}", getuid());
}

}  // namespace

std::string key_of(const std::string& content) {
  // two 64-bit hashes; the contents are ours, so deliberate collisions are not a concern
  return fmt::format("{:016x}{:016x}", crosscheck::Fnv1a::of(content), crosscheck::Fnv1a::of(content + "/"));
}

std::string as_student_folder(const fs::path& folder) {
  return fmt::format("-fdebug-prefix-map={}={}", folder.string(), student_folder);
}

const std::vector<std::string>& checking_options() {
  static const std::vector<std::string> options = {
      "-D_GLIBCXX_DEBUG", "-DTELLS_PLACES", "-g1", "-no-pie", "-fsanitize=bounds", "-fno-sanitize-recover=bounds"};
  return options;
}

Compiler::Compiler() : cache_(compiled_folder()) {
  const fs::path program = find_compiler();
  // sandboxes set LANG to C, so messages are in English; without fused multiply-add, numbers are the same on every
  // machine
  command_ = {program.string(), "-w", "-ffp-contract=off", "-fno-diagnostics-show-caret", "-fdiagnostics-color=never"};
  fingerprint_ = fmt::format("{} {}", fmt::join(command_, " "), fs::file_size(program));
  crosscheck::require_writable(cache_);
  // programs in this folder are executed, so it must belong to this user
  struct stat info {};
  if (stat(cache_.c_str(), &info) != 0 || info.st_uid != geteuid())
    throw InputError(
        fmt::format("{}: belongs to another user; name another folder in CROSSCHECK_CACHE", cache_.string()));
  fs::permissions(cache_, fs::perms(0700));
  crosscheck::remove_stale_temporary_folders(cache_);  // unfinished copies of killed runs (cached())
}

fs::path Compiler::cached(const std::string& key, const std::string& ending,
                          const std::function<void(const fs::path&)>& make) const {
  const fs::path file = cache_ / (key + ending);
  if (fs::exists(file)) return file;
  const crosscheck::TemporaryFolder scratch("build");
  const fs::path made = scratch.path / ("made" + ending);
  make(made);
  const crosscheck::TemporaryFolder beside("copy", cache_);  // in the cache's file system, so that rename() works
  fs::copy_file(made, beside.path / "made");
  fs::rename(beside.path / "made", file);
  return file;
}

void compile_ours(const Sandbox& trusted, const std::vector<std::string>& command, const fs::path& writable,
                  const std::string& what) {
  const End end = trusted.run({.command = command, .writable = writable, .limits = compile_limits});
  if (end.how == End::How::cpu || end.how == End::How::wall)
    throw std::runtime_error(fmt::format("{}: compiling it took more than {:.0f} s ({:.0f} s of CPU)", what,
                                         compile_limits.wall, compile_limits.cpu));
  if (end.how != End::How::exited || end.code != 0)
    throw std::runtime_error(fmt::format("{} does not compile:\n{}", what, end.captured_output));
}

namespace {

/// Returns the line number N of the first "FILE:N:" in `line`.
std::optional<std::string> line_of(const std::string& file, const std::string& line) {
  std::size_t at = line.find(file + ":");
  if (at == std::string::npos) return {};
  at += file.size() + 1;
  const std::size_t end = line.find_first_not_of("0123456789", at);
  if (end == std::string::npos || end == at || (line[end] != ':' && line[end] != ',')) return {};
  return line.substr(at, end - at);
}

/// The name that ld prints between ` and ' after `words`.
std::optional<std::string> quoted_after(const std::string& words, const std::string& text) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) return {};
  const std::size_t begin = text.find_first_of("`'", at);
  const std::size_t end = begin == std::string::npos ? begin : text.find('\'', begin + 1);
  if (end == std::string::npos) return {};
  return text.substr(begin + 1, end - begin - 1);
}

}  // namespace

Remark too_large(const std::string& file) {
  return {"build.memory", {file, std::to_string(compile_limits.memory), std::to_string(compile_limits.file)}};
}

Remark first_error(const std::string& file, const std::string& said, const std::vector<std::string>& own) {
  constexpr std::size_t longest = 8000;  // with long type names, the relevant text is at the end of the line
  std::istringstream lines(said);
  std::optional<std::string> number, what;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t error = line.find("error: ");
    if (!what && error != std::string::npos && line.find("ld returned") == std::string::npos) {
      what = line.substr(error + 7, longest);
      for (const std::string& one : own)
        if (const auto there = line_of(one, line)) return {"build.compile", {one, *there, *what}};
      if (const auto here = line_of(file, line)) number = here;
    }
    // for an error inside a header, reports the student's line that includes the header; the compiler names this line
    if (!number) number = line_of(file, line);
    if (!what || !number) continue;
    const std::size_t lacks = what->find(": No such file or directory");
    if (lacks != std::string::npos) return {"build.include", {file, *number, what->substr(0, lacks)}};
    return {"build.compile", {file, *number, *what}};
  }
  if (const auto name = quoted_after("multiple definition of", said)) {
    if (*name == "main") return {"build.main", {file}};
    return {"build.twice", {file, *name}};
  }
  if (const auto name = quoted_after("undefined reference to", said)) return {"build.undefined", {file, *name}};
  if (what) return {"build.no_line", {file, *what}};
  if (said.find_first_not_of(" \n") == std::string::npos) return {"build.silent", {file}};
  return {"build.other", {file, said.substr(0, said.find('\n')).substr(0, longest)}};
}

namespace {

std::vector<fs::path> files_in(const fs::path& folder, const std::string& begin, const std::string& ending) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name.starts_with(begin) && name.ends_with(ending)) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

class PartBuilder : public Builder {
 public:
  PartBuilder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox, bool checking = false)
      : assignment_(assignment),
        trusted_(trusted),
        sandbox_(sandbox),
        folder_(assignment.folder()),
        check_(folder_of_coursework() / "check"),
        command_(compiler_.command()) {
    command_.insert(command_.end(), {"-std=c++17", "-O1", "-pthread"});
    // An index outside a vector or an array ends the program, unless the program is for charts, which measure the CPU
    // time of unchecked code.
    if (checking)
      command_.insert(command_.end(), checking_options().begin(), checking_options().end());
    else if (!fs::exists(folder_ / "calls_engine.cpp"))
      command_.push_back("-D_GLIBCXX_ASSERTIONS");
    surroundings_ = compiler_.fingerprint() + fmt::format("{}", fmt::join(command_, " "));
    for (const fs::path& folder : {check_, folder_, folder_ / "starter", folder_.parent_path() / "python"})
      for (const fs::path& header : files_in(folder, "", ".h")) surroundings_ += content_of_file(header);
    surroundings_ = key_of(surroundings_);
  }

  fs::path ours(const std::string& part, const std::string& source) const override {
    std::vector<fs::path> objects = shared();
    for (const Part& other : assignment_.parts)
      if (other.name != part) objects.push_back(solution(std::string(other.name)));
    objects.push_back(object(file_of(part), source));
    std::vector<std::string> words;
    std::string key;
    for (const fs::path& each : objects) words.push_back(each.string()), key += each.filename();
    return compiler_.cached(key_of(key), "", [&](const fs::path& made) { compile(words, made, part); });
  }

  std::map<std::string, Built> theirs(const Submission& submission, const fs::path& folder,
                                      unsigned jobs) const override {
    prepare(jobs);
    const std::size_t count = assignment_.parts.size();
    std::vector<Built> objects(count), built(count);
    parallel_for(count, jobs, [&](std::size_t i) { objects[i] = compiled(part(i), submission, folder / part(i)); });
    parallel_for(count, jobs, [&](std::size_t i) { built[i] = linked(i, objects, submission, folder / part(i), {}); });
    std::map<std::string, Built> all;
    for (std::size_t i = 0; i < count; ++i) all[part(i)] = built[i];
    return all;
  }

  Built checked(const Submission& submission, const std::string& part, const fs::path& folder) const override {
    return PartBuilder(assignment_, trusted_, sandbox_, true).varied(submission, part, folder, {}, "");
  }

  Built varied(const Submission& submission, const std::string& part, const fs::path& folder,
               const std::vector<std::string>& wrapped, const std::string& around) const override {
    const auto at = std::find_if(assignment_.parts.begin(), assignment_.parts.end(),
                                 [&](const Part& one) { return one.name == part; });
    const auto i = static_cast<std::size_t>(at - assignment_.parts.begin());
    std::vector<Built> objects(assignment_.parts.size());
    objects.at(i) = compiled(part, submission, folder);
    Around beside;
    if (!around.empty()) beside.object = object("around.cpp", around);
    for (const std::string& name : wrapped) beside.words.push_back("-Wl,--wrap=" + name);
    return linked(i, objects, submission, folder, beside);
  }

 private:
  /// Replacements that an experiment links with a part.
  struct Around {
    fs::path object;
    std::vector<std::string> words;
  };

  void compile(const std::vector<std::string>& more, const fs::path& made, const std::string& what) const {
    std::vector<std::string> command = command_;
    command.insert(command.end(), more.begin(), more.end());
    command.insert(command.end(), {"-o", made.string()});
    compile_ours(trusted_, command, made.parent_path(), fmt::format("{}, {}", assignment_.name, what));
  }

  fs::path object(const std::string& name, const std::string& source) const {
    return compiler_.cached(key_of(surroundings_ + source), ".o", [&](const fs::path& made) {
      const fs::path file = made.parent_path() / name;
      crosscheck::write_file(file, source);
      compile(
          {"-c", file.string(), "-I" + folder_.string(), "-I" + (folder_ / "starter").string(), "-I" + check_.string()},
          made, name);
    });
  }

  fs::path object_of(const fs::path& source) const {
    return object(source.filename().string(), content_of_file(source));
  }

  std::string part(std::size_t i) const { return std::string(assignment_.parts[i].name); }
  fs::path solution(const std::string& part) const { return object_of(solution_of(assignment_, *this, part)); }
  fs::path starter(const std::string& part) const { return object_of(folder_ / "starter" / file_of(part)); }

  /// Sources that are linked with every part.
  std::vector<fs::path> shared_sources() const {
    std::vector<fs::path> sources = files_in(folder_, "calls", ".cpp");
    sources.push_back(check_ / "child_main.cpp");
    return sources;
  }
  std::vector<fs::path> shared() const {
    std::vector<fs::path> objects = shared_sources();
    for (fs::path& each : objects) each = object_of(each);
    return objects;
  }

  /// Compiles all of our sources that a program may need, so that they are in the cache.
  void prepare(unsigned jobs) const {
    std::vector<fs::path> sources = shared_sources();
    for (const Part& part : assignment_.parts) {
      sources.push_back(solution_of(assignment_, *this, std::string(part.name)));
      sources.push_back(folder_ / "starter" / file_of(std::string(part.name)));
    }
    parallel_for(sources.size(), jobs, [&](std::size_t i) { object_of(sources[i]); });
  }

  /// Runs the compiler in the sandbox on the files in `in`; failures name `file`.
  Built made_in_sandbox(const std::vector<std::string>& more, const fs::path& in, const fs::path& made,
                        const std::string& file, const std::vector<std::string>& own = {}) const {
    fs::create_directories(made.parent_path());
    std::vector<std::string> command = command_;
    command.insert(command.end(), more.begin(), more.end());
    command.insert(command.end(), {"-o", made.string()});
    const End end =
        sandbox_.run({.command = command, .readable = {in}, .writable = made.parent_path(), .limits = compile_limits});
    if (end.how == End::How::cpu || end.how == End::How::wall) return {{}, {"build.time", {file}}};
    if (end.how == End::How::memory || end.how == End::How::output) return {{}, too_large(file)};
    const bool there = fs::symlink_status(made).type() == fs::file_type::regular;
    if (end.how != End::How::exited || end.code != 0 || !there)
      return {{}, first_error(file, end.captured_output, own)};
    return {made};
  }

  Built compiled(const std::string& part, const Submission& submission, const fs::path& folder) const {
    const std::string file = file_of(part);
    if (const auto missing = submission.missing.find(file); missing != submission.missing.end())
      return {{}, missing->second, true};
    const auto at = submission.places.find(file);
    const fs::path place = at == submission.places.end() ? file : at->second;
    return compiled(file, place.parent_path() / file, submission, folder);
  }

  /// Compiles the student's source `file` at `path`, together with the student's own headers.
  Built compiled(const std::string& file, const fs::path& path, const Submission& submission,
                 const fs::path& folder) const {
    const fs::path in = folder / "in", here = (in / path).parent_path();
    std::vector<std::string> own;  // names of the student's other files
    for (const auto& [looked_for, other] : own_includes(submission.files, path.string(), submission.files.at(file)))
      try {
        crosscheck::write_file(in / looked_for, submission.files.at(other));
        own.push_back(base_name(looked_for));
      } catch (const std::exception&) {
        // an archive may contain a file and a folder of the same name; the compiler then reports the missing file
      }
    crosscheck::write_file(in / path, submission.files.at(file));
    // written last, so that our headers replace the student's files with the same names
    for (const fs::path& header : files_in(folder_ / "starter", "", ".h")) {
      crosscheck::write_file(here / header.filename(), content_of_file(header));
      for (const auto& entry : fs::recursive_directory_iterator(in))
        if (entry.path().filename() == header.filename()) crosscheck::write_file(entry.path(), content_of_file(header));
      own.erase(std::remove(own.begin(), own.end(), header.filename().string()), own.end());
    }
    return made_in_sandbox({"-I" + here.string(), as_student_folder(here), "-c", (in / path).string()}, in,
                           folder / "object" / (path.stem().string() + ".o"), base_name(path.string()), own);
  }

  /// Compiles the student's other sources, at most `most` to bound the time. Skips those that do not compile.
  std::vector<fs::path> other_objects(const Submission& submission, const fs::path& folder) const {
    constexpr int most = 8;
    std::vector<fs::path> made;
    int tried = 0;
    for (const auto& [path, content] : submission.files) {
      const bool is_part = std::any_of(assignment_.parts.begin(), assignment_.parts.end(),
                                       [&](const Part& one) { return file_of(std::string(one.name)) == path; });
      if (is_part || !is_source(path)) continue;
      const Built built = compiled(path, path, submission, folder / std::to_string(tried));
      if (!built.program.empty()) made.push_back(built.program);
      if (++tried == most || built.error.key == "build.time") break;
    }
    return made;
  }

  /// Links a part. Earlier parts are the official ones, so that mistakes in those cost nothing here. If the part
  /// needs the student's own functions from earlier parts or other sources, these are linked after the official ones,
  /// which take precedence. Later parts are never official, because the student's code could call a linked solution.
  /// They are the student's, because this part may depend on them, or the hand-out's starters if linking fails.
  Built linked(std::size_t i, const std::vector<Built>& objects, const Submission& submission, const fs::path& folder,
               const Around& around) const {
    if (objects[i].program.empty()) return objects[i];
    const bool has_later = std::any_of(objects.begin() + static_cast<std::ptrdiff_t>(i) + 1, objects.end(),
                                       [](const Built& one) { return !one.program.empty(); });
    Built built;
    std::optional<std::vector<fs::path>> others;  // compiled on first use
    for (const auto& [their_later, their_earlier] :
         {std::pair{true, false}, {true, true}, {false, false}, {false, true}}) {
      if (their_earlier && built.error.key != "build.undefined") continue;
      if (!their_later && !has_later) break;
      const std::string way = fmt::format("{:d}{:d}", their_later, their_earlier);
      const fs::path in = folder / ("in" + way);
      fs::create_directories(in);
      std::vector<std::string> words = around.words;
      const auto add = [&](const fs::path& object, const std::string& name) {
        fs::copy_file(object, in / name);
        words.push_back((in / name).string());
      };
      int number = 0;
      if (!their_earlier) add(objects[i].program, part(i) + ".o");
      if (!around.object.empty()) add(around.object, "around.o");
      for (const fs::path& object : shared()) add(object, "ours" + std::to_string(number++) + ".o");
      for (std::size_t k = 0; k < i; ++k) add(solution(part(k)), "ours-" + part(k) + ".o");
      if (their_earlier) {
        words.push_back("-Wl,--allow-multiple-definition");  // the first definition wins, which is ours
        for (std::size_t k = 0; k <= i; ++k)
          if (!objects[k].program.empty()) add(objects[k].program, part(k) + ".o");
        if (!others) others = other_objects(submission, folder / "other");
        for (const fs::path& object : *others) add(object, "other" + std::to_string(number++) + ".o");
      }
      for (std::size_t k = i + 1; k < objects.size(); ++k) {
        const bool theirs = their_later && !objects[k].program.empty();
        add(theirs ? objects[k].program : starter(part(k)), (theirs ? "" : "starter-") + part(k) + ".o");
      }
      built = made_in_sandbox(words, in, folder / ("out" + way) / "program", file_of(part(i)));
      if (!built.program.empty()) break;
    }
    return built;
  }

  const Assignment& assignment_;
  const Sandbox& trusted_;
  const Sandbox& sandbox_;
  const Compiler compiler_;
  fs::path folder_, check_;
  std::vector<std::string> command_;
  std::string surroundings_;  // fingerprint of the compiler, its options and all headers
};

}  // namespace

std::unique_ptr<Builder> builder_for(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox) {
  if (assignment.builder) return assignment.builder(assignment, trusted, sandbox);
  return std::make_unique<PartBuilder>(assignment, trusted, sandbox);
}

fs::path solution_of(const Assignment& assignment, const Builder& builder, const std::string& part) {
  return assignment.folder() / "solution" / builder.file_of(part);
}

std::string filled(const std::string& file, const std::vector<std::string>& with) {
  std::string text = content_of_file(folder_of_coursework() / "grader" / file);
  for (std::size_t i = 0; i < with.size(); ++i)
    for (std::size_t at; (at = text.find(fmt::format("{{{}}}", i))) != std::string::npos;) text.replace(at, 3, with[i]);
  return text;
}

std::string content_of_file(const fs::path& file) {
  if (std::optional<std::string> content = crosscheck::try_read_file(file)) return *std::move(content);
  throw crosscheck::InputError(fmt::format("{}: cannot be read", file.string()));
}

}  // namespace coursework
