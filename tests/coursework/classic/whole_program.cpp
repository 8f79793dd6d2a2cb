// Runs a build plan in a sandbox, finds the parts in the whole program, and says what is wrong.
#include "tests/coursework/classic/whole_program.h"

#include <algorithm>
#include <atomic>
#include <sstream>

#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "tests/coursework/check/judge.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/parallel.h"
#include "tests/coursework/grader/run.h"

namespace coursework::classic {
namespace fs = std::filesystem;
namespace {

bool there(const fs::path& file) { return fs::symlink_status(file).type() == fs::file_type::regular; }

/// What of ours is compiled around a student's classes, as a folder like tests/coursework.
void copy_ours(const fs::path& coursework, const fs::path& to) {
  fs::create_directories(to / "classic");
  for (const char* folder : {"base", "probe", "stubs"})
    fs::copy(coursework / "classic" / folder, to / "classic" / folder, fs::copy_options::recursive);
  for (const auto& entry : fs::directory_iterator(coursework / "classic"))
    if (entry.path().filename().string().starts_with("calls_")) fs::copy(entry.path(), to / "classic");
  fs::create_directories(to / "check");
  for (const auto& entry : fs::directory_iterator(coursework / "check"))
    if (entry.path().extension() == ".h") fs::copy(entry.path(), to / "check");
}

/// The sandbox may run the compiler as another user, who must get to all of it.
void show(const fs::path& folder) {
  fs::permissions(folder, fs::perms(0755));
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    fs::permissions(entry.path(), fs::perms(entry.is_directory() ? 0755 : 0644));
}

class StepRunner {
 public:
  StepRunner(const Sandbox& sandbox, const Toolchain& tools, const fs::path& tree)
      : sandbox_(sandbox), tools_(tools), tree_(tree) {
    if (tools.cache.empty()) return;
    for (const auto& [path, content] : files_below(tree_ / "in"))
      if (is_header(path)) headers_ += path + "\n" + content;
  }

  /// Lets calls run for so much longer, s, all together.
  void allow(double seconds) { more_ += seconds; }

  /// What was said; empty where the file was made.
  std::string operator()(const BuildStep& step) {
    const fs::path kept = step.source.empty() || tools_.cache.empty() ? fs::path() : tools_.cache / (key(step) + ".o");
    if (!kept.empty() && there(kept)) {
      fs::copy_file(kept, step.makes);
      return "";
    }
    std::vector<std::string> command = step.archive ? std::vector{tools_.ar.string()} : tools_.compiler;
    command.insert(command.end(), step.words.begin(), step.words.end());
    // in a folder of its own: side by side with others, and what others made stays as it is
    const fs::path work = tree_ / "work" / step.makes.filename(), made = work / step.makes.filename();
    fs::create_directories(work);
    show(work);
    std::replace(command.begin(), command.end(), step.makes.string(), made.string());
    Limits limits = compile_limits;
    limits.cpu = std::min(limits.cpu, tools_.seconds + more_ - spent_);
    if (!(limits.cpu > 0)) return std::string(too_long);
    const End end = sandbox_.run(
        {.command = command, .readable = {tree_ / "in", tree_ / "out"}, .writable = work, .limits = limits});
    spent_ += end.cpu;
    if (end.how == End::How::cpu || end.how == End::How::wall) return std::string(too_long);
    if (end.how == End::How::memory || end.how == End::How::output) return std::string(too_much);
    if (end.how != End::How::exited || end.code != 0 || !there(made))
      return end.captured_output.empty() ? "it ended and said nothing" : end.captured_output;
    fs::rename(made, step.makes);
    if (!kept.empty()) {
      // the tree's own name is everybody's; its folder's is nobody else's
      const fs::path temporary = kept.string() + "." + tree_.parent_path().filename().string();
      fs::copy_file(step.makes, temporary, fs::copy_options::overwrite_existing);
      fs::rename(temporary, kept);
    }
    return "";
  }

 private:
  /// Of the command, the source and every header; the tree's own name counts for nothing.
  std::string key(const BuildStep& step) const {
    std::string text = headers_;
    for (const std::string& word : tools_.compiler) text += word + "\n";
    for (std::string word : step.words) {
      for (std::size_t at; (at = word.find(tree_.string())) != std::string::npos;)
        word.replace(at, tree_.string().size(), "@");
      text += word + "\n";
    }
    text += content_of_file(step.source);
    std::stringstream hex;
    hex << std::hex << crosscheck::Fnv1a::of(text) << crosscheck::Fnv1a::of(text + "/");
    return hex.str();
  }

  const Sandbox& sandbox_;
  const Toolchain& tools_;
  fs::path tree_;
  std::string headers_;
  double more_ = 0;                // s of processor time, for what is built beside the parts
  std::atomic<double> spent_ = 0;  // s of processor time, by all that ran
};

}  // namespace

std::string file_of_part(const std::string& part) {
  if (part == "simple") return "simpleSystem.cpp";
  if (part == "pendulum") return "pendulumSystem.cpp";
  return part == "cloth" ? "ClothSystem.cpp" : "TimeStepper.cpp";
}

Files files_below(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(folder).generic_string()] = content_of_file(entry.path());
  }
  return files;
}

namespace {

Remark untried(const BuildPlan& plan, const Scout& scout, const std::string& captured_output);

/// Builds each class that may be meant by several parts and has it tried; none where names leave no choice. `notes`:
/// those that cannot be.
std::map<int, Fits> try_classes(const BuildPlan& plan, StepRunner& run, const Trial& trial, const fs::path& child,
                                unsigned jobs, std::vector<Remark>& notes) {
  const std::vector<Scout> scouts = plan.scouts();
  std::vector<Fits> fits(scouts.size());
  std::vector<std::string> captured(scouts.size());
  // each is one call more than a program without a choice has; half a minute is ten times what it takes
  run.allow(30.0 * static_cast<double>(scouts.size()));
  parallel_for(scouts.size(), jobs, [&](std::size_t i) {
    const BuildStep link = plan.link(scouts[i].build, child);
    captured[i] = run(scouts[i].build.calls);
    if (captured[i].empty()) captured[i] = run(link);
    if (captured[i].empty()) fits[i] = trial(link.makes, scouts[i].stepper);
  });
  for (std::size_t i = 0; i < scouts.size(); ++i)
    if (!captured[i].empty()) notes.push_back(untried(plan, scouts[i], captured[i]));
  std::map<int, Fits> all;
  for (std::size_t i = 0; i < scouts.size(); ++i) all[scouts[i].of] = fits[i];
  return all;
}

}  // namespace

Programs build_programs(const Files& files, const fs::path& tree, const fs::path& coursework, const Sandbox& sandbox,
                        const Toolchain& tools, const std::vector<std::string>& wanted, const Trial& trial,
                        const std::map<std::string, std::string>& classes) {
  const fs::path whole = fs::absolute(tree), ours = whole / "in" / "ours", child = whole / "in" / "child.o";
  copy_ours(fs::absolute(coursework), ours);
  fs::copy_file(tools.child, child);
  BuildPlan plan(files, whole, ours, classes);
  show(whole);
  StepRunner run(sandbox, tools, whole);
  std::vector<std::string> said(plan.objects().size());
  parallel_for(said.size(), tools.jobs, [&](std::size_t i) { said[i] = run(plan.objects()[i]); });
  for (const BuildStep& archive : plan.archives()) run(archive);
  std::vector<Remark> tried;
  plan.choose(trial ? try_classes(plan, run, trial, child, tools.jobs, tried) : std::map<int, Fits>());

  std::vector<const PartBuild*> parts;
  Programs made{{}, plan.notes(), plan.base_file()};
  made.notes.insert(made.notes.end(), tried.begin(), tried.end());
  std::map<std::string, Program>& programs = made.of;
  for (const PartBuild& part : plan.parts()) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), part.part) == wanted.end()) continue;
    programs[part.part].missing = part.missing;
    if (part.missing.empty()) parts.push_back(&part);
  }
  parallel_for(parts.size(), tools.jobs, [&](std::size_t i) {
    Program& program = programs.at(parts[i]->part);
    const BuildStep link = plan.link(*parts[i], child);
    program.captured_output = run(parts[i]->calls);
    if (program.captured_output.empty()) program.captured_output = run(link);
    if (program.captured_output.empty()) {
      program.file = link.makes;
      return;
    }
    // a file of the student's that does not compile explains more than what is missing because of it
    for (std::size_t k = 0; k < said.size(); ++k)
      if (const std::string& file = plan.objects()[k].file;
          !said[k].empty() && std::count(parts[i]->files.begin(), parts[i]->files.end(), file)) {
        program.source = file;
        program.captured_output = said[k];
        return;
      }
  });
  return made;
}

namespace {

constexpr std::size_t most_notes = 20;
/// Of a class that is tried: the choice must not depend on how busy the machine is.
constexpr Limits trial_limits{.cpu = 10, .wall = 600};

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
  if (program.captured_output == too_long) return {"build.time", {file}};
  if (program.captured_output == too_much) return too_large(file);
  if (!program.source.empty() || program.captured_output.find("undefined reference to") != std::string::npos ||
      program.captured_output.find("multiple definition of") != std::string::npos)
    return first_error(file, program.captured_output);
  return {"whole.interface", {file, first_place(program.captured_output)}};
}

/// Why a class could not even be tried: the compiler's first error.
Remark untried(const BuildPlan& plan, const Scout& scout, const std::string& captured_output) {
  if (captured_output == too_long) return {"build.time", {plan.name_of(scout.of)}};
  if (captured_output == too_much) return too_large(plan.name_of(scout.of));
  if (captured_output.find("undefined reference to") != std::string::npos)
    return first_error(plan.name_of(scout.of), captured_output);
  return {"whole.untried", {plan.name_of(scout.of), first_place(captured_output)}};
}

class WholeBuilder : public Builder {
 public:
  WholeBuilder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox, bool checking = false)
      : assignment_(assignment),
        trusted_(trusted),
        sandbox_(sandbox),
        solution_(files_below(assignment.folder() / "solution")),
        coursework_(folder_of_coursework()) {
    for (const Part& part : assignment.parts) parts_.emplace_back(part.name);
    command_ = compiler_.command();
    if (checking) command_.insert(command_.end(), checking_options().begin(), checking_options().end());
    surroundings_ = compiler_.fingerprint() + (checking ? "checking" : "");
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
      if (program.file.empty()) throw std::runtime_error("classic, " + part + ": " + program.captured_output);
      fs::copy_file(program.file, made);
    });
  }

  std::map<std::string, Built> theirs(const Submission& submission, const fs::path& folder,
                                      unsigned jobs) const override {
    std::map<std::string, Built> all;
    Programs programs = build_programs(
        submission.files, folder / "tree", coursework_, sandbox_, tools({}, jobs), parts_,
        [&](const fs::path& program, bool stepper) { return tried(program, stepper); }, submission.choice.classes);
    mend_base(submission, programs, folder, jobs);
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

  Built checked(const Submission& submission, const std::string& part, const fs::path& folder) const override {
    return WholeBuilder(assignment_, trusted_, sandbox_, true).theirs(submission, folder, 1).at(part);
  }

  std::string file_of(const std::string& part) const override { return file_of_part(part); }

 private:
  fs::path child_source() const { return coursework_ / "check" / "child_main.cpp"; }

  Toolchain tools(const fs::path& cache, unsigned jobs) const {
    const fs::path child = compiler_.cached(key_of(surroundings_ + "child"), ".o", [&](const fs::path& made) {
      std::vector<std::string> command = command_;
      command.insert(command.end(), {"-std=c++17", "-O1", "-c", child_source().string(), "-o", made.string()});
      compile_ours(trusted_, command, made.parent_path(), "child_main.cpp");
    });
    return {command_, "/usr/bin/ar", child, cache, jobs};
  }

  /// The public tests of each role of the class's kind, in the sandbox: which of them it would pass.
  Fits tried(const fs::path& program, bool stepper) const {
    Fits fits;
    for (const Test& test : assignment_.tests) {
      Random random(public_seed(assignment_, test));
      bool all_right = true;
      const Role* role = nullptr;
      for (const Case& one : test.cases(random)) {
        const std::string begin = one.call == "field" ? "simple" : one.call.substr(0, one.call.find('.'));
        role = &role_of(begin);
        if (role->stepper != stepper) break;
        // one that is too slow is not tried again
        if (fits[role->name].slow) break;
        Answer answer = run_calls(sandbox_, program, {one}, trial_limits).front();
        fits[role->name].slow = answer.how == How::out_of_time;
        const double entries = answer.got.empty() ? 0 : answer.got.front();
        answer = reduced(test, one, answer);
        const bool right = judge(one, answer).right;
        all_right = all_right && right;
        Fit& fit = fits[role->name];
        const bool decides =
            stepper || begin == "simple" || one.column == "law" || one.column == "links" || one.column == "structural";
        if (!decides || answer.how != How::answered) continue;
        fit.alive = fit.alive || std::any_of(answer.got.begin(), answer.got.end(), [](double x) { return x != 0; });
        // of several cases that decide the last one counts only where those before it were right
        const bool first = fit.decided++ == 0;
        fit.shape =
            (first || fit.shape) && right && (begin != "pendulum" || entries == 4) && (begin != "chain" || entries > 4);
      }
      if (role && role->stepper == stepper && all_right) ++fits[role->name].right;
    }
    return fits;
  }

  /// Whether the steppers can be asked with the student's own base class: our system derives from it.
  bool base_holds(const Programs& programs, const std::vector<std::string>& steppers) const {
    for (const std::string& part : steppers) {
      const auto at = programs.of.find(part);
      if (at == programs.of.end() || !at->second.missing.empty() || !at->second.source.empty()) continue;
      if (at->second.file.empty()) return false;
      const Answer answer = run_calls(sandbox_, at->second.file, {{"base", {}, {1}}}).front();
      if (answer.how != How::answered || answer.got != Numbers{1}) return false;
    }
    return true;
  }

  /// A base class that cannot stand alone, or loses the state, is no fault of the steppers: they get the starter's in
  /// its place, where they can be built with it.
  void mend_base(const Submission& submission, Programs& programs, const fs::path& folder, unsigned jobs) const {
    const std::vector<std::string> steppers = {"euler", "trapezoidal"};
    if (programs.base_file.empty() || base_holds(programs, steppers)) return;
    Files files = submission.files;
    for (auto it = files.begin(); it != files.end();) {
      const std::vector<std::string> words = tokens_of(it->second);
      const bool is_base = defines_class(words, "ParticleSystem") ||
                           (is_source(it->first) && defines_member(words, "ParticleSystem", "ParticleSystem"));
      it = is_base ? files.erase(it) : std::next(it);
    }
    const Programs mended = build_programs(files, folder / "tree-base", coursework_, sandbox_, tools({}, jobs),
                                           steppers, nullptr, submission.choice.classes);
    bool all = true;
    for (const std::string& part : steppers) all = all && !mended.of.at(part).file.empty();
    if (all)
      for (const std::string& part : steppers) programs.of[part] = mended.of.at(part);
    programs.notes.insert(programs.notes.begin(), {all ? "whole.base" : "whole.base_kept", {programs.base_file}});
  }

  const Assignment& assignment_;
  const Sandbox& trusted_;
  const Sandbox& sandbox_;
  const Compiler compiler_;
  std::vector<std::string> command_;
  Files solution_;
  fs::path coursework_;
  std::vector<std::string> parts_;
  std::string surroundings_;  // fingerprint of all that is compiled around a solution
};

}  // namespace

std::unique_ptr<Builder> whole_builder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox) {
  return std::make_unique<WholeBuilder>(assignment, trusted, sandbox);
}

}  // namespace coursework::classic
