// Finds the parts in a whole program (build.h), compiles them (programs.h), and says what is wrong.
#include "tests/coursework/classic/whole.h"

#include <sstream>

#include "mysim/temporary_folder.h"
#include "tests/coursework/classic/programs.h"
#include "tests/coursework/grader/compiler.h"
#include "tests/coursework/grader/diagnostics.h"

namespace coursework::classic {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_notes = 20;

/// The first file and line of the student's that a compiler's output names beside an error.
std::string first_place(const std::string& said) {
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("/in/his/");
    if (at != std::string::npos && line.find("error: ") != std::string::npos) return line.substr(at + 8, 300);
  }
  const std::size_t error = said.find("error: ");
  const std::string from = said.substr(error == std::string::npos ? 0 : error + 7);
  return from.substr(0, from.find('\n')).substr(0, 300);
}

Remark remark_on(const Program& program, const std::string& part) {
  const std::string file = program.source.empty() ? file_of_part(part) : base_name(program.source);
  if (program.chatter == too_long) return {"build.time", {file}};
  if (!program.source.empty() || program.chatter.find("undefined reference to") != std::string::npos ||
      program.chatter.find("multiple definition of") != std::string::npos)
    return first_error(file, program.chatter);
  return {"whole.interface", {file, first_place(program.chatter)}};
}

class WholeBuilder : public Builder {
 public:
  WholeBuilder(const Assignment& assignment, const Lane& trusted, const Lane& lane)
      : trusted_(trusted),
        lane_(lane),
        solution_(files_below(assignment.folder() / "solution")),
        coursework_(folder_of_coursework()) {
    for (const Part& part : assignment.parts) parts_.emplace_back(part.name);
    surroundings_ = compiler_.fingerprint();
    for (const char* folder : {"base", "probe", "stubs"})
      for (const auto& [path, content] : files_below(assignment.folder() / folder)) surroundings_ += path + content;
    for (const auto& entry : fs::directory_iterator(assignment.folder()))
      if (entry.path().filename().string().starts_with("calls_")) surroundings_ += content_of_file(entry.path());
    for (const auto& entry : fs::directory_iterator(coursework_ / "check"))
      if (entry.path().extension() == ".h") surroundings_ += content_of_file(entry.path());
    surroundings_ = key_of(surroundings_ + content_of_file(child_source()));
  }

  fs::path ours(const std::string& part, const std::string& source) const override {
    Files files = solution_;
    files[file_of(part)] = source;
    std::string key = surroundings_ + part;
    for (const auto& [path, content] : files) key += path + content;
    return compiler_.cached(key_of(key), "", [&](const fs::path& made) {
      const auto programs = build_programs(files, made.parent_path() / "tree", coursework_, trusted_,
                                           tools(compiler_.cache(), 1), {part});
      const Program& program = programs.of.at(part);
      if (program.file.empty()) throw std::runtime_error("classic, " + part + ": " + program.chatter);
      fs::copy_file(program.file, made);
    });
  }

  std::map<std::string, Built> theirs(const Submission& submission, const fs::path& folder,
                                      unsigned jobs) const override {
    std::map<std::string, Built> all;
    const Programs programs =
        build_programs(submission.files, folder / "tree", coursework_, lane_, tools({}, jobs), parts_);
    for (const auto& [part, program] : programs.of) {
      Built& one = all[part];
      if (!program.missing.empty())
        one = {{}, {"whole.missing", {program.missing}}, true};
      else if (program.file.empty())
        one = {{}, remark_on(program, part)};
      else
        one = {program.file};
    }
    // one part tells it for all; whoever reads more than a few has to tidy up first
    std::vector<Remark>& notes = all.begin()->second.notes;
    notes = programs.notes;
    if (notes.size() > most_notes) notes.resize(most_notes);
    return all;
  }

  std::string file_of(const std::string& part) const override { return file_of_part(part); }

 private:
  fs::path child_source() const { return coursework_ / "check" / "child_main.cpp"; }

  Tools tools(const fs::path& cache, unsigned jobs) const {
    const fs::path child = compiler_.cached(key_of(surroundings_ + "child"), ".o", [&](const fs::path& made) {
      std::vector<std::string> command = compiler_.command();
      command.insert(command.end(), {"-std=c++17", "-O1", "-c", child_source().string(), "-o", made.string()});
      compile_ours(trusted_, command, made.parent_path(), "child_main.cpp");
    });
    return {compiler_.command(), "/usr/bin/ar", child, cache, jobs};
  }

  const Lane& trusted_;
  const Lane& lane_;
  const Compiler compiler_;
  Files solution_;
  fs::path coursework_;
  std::vector<std::string> parts_;
  std::string surroundings_;  // fingerprint of all that is compiled around a solution
};

}  // namespace

std::unique_ptr<Builder> whole_builder(const Assignment& assignment, const Lane& trusted, const Lane& lane) {
  return std::make_unique<WholeBuilder>(assignment, trusted, lane);
}

}  // namespace coursework::classic
