// One file per part, compiled and linked with ours in the place of earlier parts.
#include "tests/coursework/grader/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/temporary_folder.h"
#include "tests/coursework/grader/compiler.h"
#include "tests/coursework/grader/diagnostics.h"
#include "tests/coursework/grader/parallel.h"

namespace coursework {
namespace fs = std::filesystem;
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
  PartBuilder(const Assignment& assignment, const Lane& trusted, const Lane& lane)
      : assignment_(assignment),
        trusted_(trusted),
        lane_(lane),
        folder_(assignment.folder()),
        check_(folder_of_coursework() / "check"),
        command_(compiler_.command()) {
    command_.insert(command_.end(), {"-std=c++17", "-O1"});
    surroundings_ = compiler_.fingerprint();
    for (const fs::path& folder : {check_, folder_, folder_ / "starter"})
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
    in_parallel(count, jobs, [&](std::size_t i) { objects[i] = compiled(part(i), submission, folder / part(i)); });
    in_parallel(count, jobs, [&](std::size_t i) { built[i] = linked(i, objects, folder / part(i)); });
    std::map<std::string, Built> all;
    for (std::size_t i = 0; i < count; ++i) all[part(i)] = built[i];
    return all;
  }

 private:
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

  /// What stands around the parts.
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

  /// Makes all of ours that a program may need, so that it is in the cache.
  void prepare(unsigned jobs) const {
    std::vector<fs::path> sources = shared_sources();
    for (const Part& part : assignment_.parts) {
      sources.push_back(solution_of(assignment_, *this, std::string(part.name)));
      sources.push_back(folder_ / "starter" / file_of(std::string(part.name)));
    }
    in_parallel(sources.size(), jobs, [&](std::size_t i) { object_of(sources[i]); });
  }

  /// The compiler in the lane, on what stands in `in`; `file` is what is talked about where nothing is made.
  Built made_in_lane(const std::vector<std::string>& more, const fs::path& in, const fs::path& made,
                     const std::string& file) const {
    fs::create_directories(made.parent_path());
    std::vector<std::string> command = command_;
    command.insert(command.end(), more.begin(), more.end());
    command.insert(command.end(), {"-o", made.string()});
    const End end =
        lane_.run({.command = command, .readable = {in}, .writable = made.parent_path(), .limits = compile_limits});
    if (end.how == End::How::cpu || end.how == End::How::wall) return {{}, {"build.time", {file}}};
    const bool there = fs::symlink_status(made).type() == fs::file_type::regular;
    if (end.how != End::How::exited || end.code != 0 || !there) return {{}, first_error(file, end.chatter)};
    return {made};
  }

  /// The student's part as an object.
  Built compiled(const std::string& part, const Submission& submission, const fs::path& folder) const {
    const std::string file = file_of(part);
    if (const auto missing = submission.missing.find(file); missing != submission.missing.end())
      return {{}, missing->second, true};
    const fs::path in = folder / "in";
    fs::create_directories(in);
    crosscheck::write_file(in / file, submission.files.at(file));
    for (const fs::path& header : files_in(folder_ / "starter", "", ".h"))
      fs::copy_file(header, in / header.filename());
    return made_in_lane({"-I" + in.string(), "-c", (in / file).string()}, in, folder / "object" / (part + ".o"), file);
  }

  /// Earlier parts are ours, so that a mistake in one costs nothing here. Later ones are never ours, since a solution
  /// that is linked in can be called: the student's, which an earlier part may build on; where that cannot be linked,
  /// those of the hand-out.
  Built linked(std::size_t i, const std::vector<Built>& objects, const fs::path& folder) const {
    if (objects[i].program.empty()) return objects[i];
    for (bool their_later = true;; their_later = false) {
      const fs::path in = folder / (their_later ? "in-theirs" : "in-starter");
      fs::create_directories(in);
      std::vector<std::string> words;
      const auto add = [&](const fs::path& object, const std::string& name) {
        fs::copy_file(object, in / name);
        words.push_back((in / name).string());
      };
      add(objects[i].program, part(i) + ".o");
      int number = 0;
      for (const fs::path& object : shared()) add(object, "ours" + std::to_string(number++) + ".o");
      for (std::size_t k = 0; k < i; ++k) add(solution(part(k)), "ours-" + part(k) + ".o");
      bool theirs_used = false;
      for (std::size_t k = i + 1; k < objects.size(); ++k) {
        const bool theirs = their_later && !objects[k].program.empty();
        add(theirs ? objects[k].program : starter(part(k)), (theirs ? "" : "starter-") + part(k) + ".o");
        theirs_used |= theirs;
      }
      Built built =
          made_in_lane(words, in, folder / (their_later ? "out" : "out-starter") / "program", file_of(part(i)));
      if (!built.program.empty() || !theirs_used) return built;
    }
  }

  const Assignment& assignment_;
  const Lane& trusted_;
  const Lane& lane_;
  const Compiler compiler_;
  fs::path folder_, check_;
  std::vector<std::string> command_;
  std::string surroundings_;  // fingerprint of compiler, options and all headers
};

}  // namespace

std::unique_ptr<Builder> builder_for(const Assignment& assignment, const Lane& trusted, const Lane& lane) {
  if (assignment.builder) return assignment.builder(assignment, trusted, lane);
  return std::make_unique<PartBuilder>(assignment, trusted, lane);
}

fs::path solution_of(const Assignment& assignment, const Builder& builder, const std::string& part) {
  return assignment.folder() / "solution" / builder.file_of(part);
}

std::string content_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream content;
  content << in.rdbuf();
  if (!in) throw crosscheck::InputError(fmt::format("{}: cannot be read", file.string()));
  return content.str();
}

}  // namespace coursework
