#include "tests/coursework/classic/whole_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <set>

#include "tests/coursework/check/judge.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/parallel.h"
#include "tests/coursework/grader/run.h"

namespace coursework::classic {
namespace fs = std::filesystem;
namespace {

// replace the compiler's output if it was stopped or not started because time was up, or if it ran out of memory
constexpr std::string_view too_long = "the compiler did not come to an end in time";
constexpr std::string_view too_much = "the compiler needed more memory than there is";

bool there(const fs::path& file) { return fs::symlink_status(file).type() == fs::file_type::regular; }

/// Copies our files that are compiled around a student's classes, in the layout of tests/coursework.
void copy_ours(const fs::path& coursework, const fs::path& to) {
  fs::create_directories(to / "classic");
  for (const char* folder : {"base", "probe", "starter", "stubs"})
    fs::copy(coursework / "classic" / folder, to / "classic" / folder, fs::copy_options::recursive);
  fs::create_directories(to / "check");
  for (const auto& entry : fs::directory_iterator(coursework / "check"))
    if (entry.path().extension() == ".h") fs::copy(entry.path(), to / "check");
}

/// Makes the folder accessible to the sandbox, which may run the compiler as another user.
void show(const fs::path& folder) {
  fs::permissions(folder, fs::perms(0755));
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    fs::permissions(entry.path(), fs::perms(entry.is_directory() ? 0755 : 0644));
}

class StepRunner {
 public:
  StepRunner(const Sandbox& sandbox, const Toolchain& tools, const fs::path& tree)
      : sandbox_(sandbox), tools_(tools), tree_(tree) {
    for (const auto& [path, content] : tools.cache ? files_below(tree_ / "in") : Files())
      if (is_header(path)) headers_ += path + "\n" + content;
  }

  /// Extends the total CPU time of all calls by `seconds`.
  void allow(double seconds) { more_ += seconds; }

  /// Runs the step; returns its output, or an empty text if the file was made.
  std::string operator()(const BuildStep& step) {
    if (!tools_.cache || step.source.empty()) return run(step, step.makes);
    // the key contains the command, the source and every header, but not the tree's own path
    std::string said, key = headers_ +
                            fmt::format("{} {}", fmt::join(tools_.compiler, " "), fmt::join(step.words, " ")) +
                            content_of_file(step.source);
    for (std::size_t at; (at = key.find(tree_.string())) != key.npos;) key.replace(at, tree_.string().size(), "@");
    struct Failed {};
    try {
      fs::copy_file(tools_.cache->cached(key_of(key), ".o",
                                         [&](const fs::path& made) {
                                           if (!(said = run(step, made)).empty()) throw Failed();
                                         }),
                    step.makes);
    } catch (const Failed&) {
    }
    return said;
  }

 private:
  std::string run(const BuildStep& step, const fs::path& makes) {
    std::vector<std::string> command = step.archive ? std::vector{tools_.ar.string()} : tools_.compiler;
    command.insert(command.end(), step.words.begin(), step.words.end());
    // runs in a separate folder, so that parallel steps do not interfere and their output is preserved
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
    fs::rename(made, makes);
    return "";
  }

  const Sandbox& sandbox_;
  const Toolchain& tools_;
  fs::path tree_;
  std::string headers_;
  double more_ = 0;                // s of CPU time in addition to `seconds`, for classes that are compiled later
  std::atomic<double> spent_ = 0;  // s of CPU time of all calls so far
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

constexpr std::size_t most_notes = 20, most_tried = 16;  // limits on remarks and on classes tried per role
constexpr int most_versions = 4;                         // complete versions of the program that are tried
/// Limits of a trial. The wall-clock limit is large, because the choice must not depend on the load of the machine.
constexpr Limits trial_limits{.cpu = 10, .wall = 600};

/// Reason why there is no program around a class. `file` is the student's file that does not compile, or empty if our
/// calls of the class fail to compile.
Remark remark_on(const ClassInfo& of, const std::string& file, const std::string& said) {
  const std::string name = base_name(file.empty() ? of.file : file);
  if (said == too_long) return {"build.time", {name}};
  if (said == too_much) return too_large(name);
  if (!file.empty()) return first_error(name, said);
  const Remark error = first_error(name, said);
  if (error.key == "build.twice") return error;
  if (error.key == "build.compile")
    return {"whole.interface", {of.full(), name, fmt::format("{}", fmt::join(error.with, ":"))}};
  if (error.key != "build.undefined") return {"whole.interface", {of.full(), name, error.with.back()}};
  const std::string table = "vtable for ", &missing = error.with.at(1);
  return missing.starts_with(table) ? Remark{"whole.no_functions", {missing.substr(table.size())}}
                                    : Remark{"whole.undefined", {missing}};
}

/// Assigns classes to roles. Compiles the calls of a class on first use.
class Choice {
 public:
  struct Made {
    fs::path program;
    std::string said;  // reason why there is no program
  };

  Choice(const BuildPlan& plan, StepRunner& run, const Toolchain& tools, const fs::path& child, const Trial& trial,
         const std::map<std::string, std::string>& wanted)
      : plan_(plan), run_(run), tools_(tools), child_(child), trial_(trial), wanted_(wanted) {}

  void decide(const std::vector<std::string>& parts) {
    std::map<std::string_view, std::vector<Candidate>> open;
    std::map<const ClassInfo*, bool> first;
    for (const Role& role : roles()) {
      if (!parts.empty() && std::find(parts.begin(), parts.end(), role.part) == parts.end()) continue;
      auto& all = open[role.name] = candidates(plan_.classes(), role, wanted_);
      all.resize(std::min(all.size(), most_tried));
      if (!all.empty()) first.emplace(all.front().of, role.stepper);
    }
    build(first);
    // In order of preference: 0 the only candidate, if likely, or the first that earns all points; 1 the first that has
    // the role's name and can be built; 2 the one that earns most points; 3 the first likely one, for its error
    // message.
    for (const int wish : {0, 1, 2, 3})
      for (const Role& role : roles()) {
        const std::vector<Candidate>& all = open[role.name];
        std::pair<int, const ClassInfo*> best;
        for (const Candidate& one : all) {
          if (chosen.count(role.name) || taken(one.of, role) || (wish == 0 && best.second)) continue;
          const int here = wish == 0   ? (all.size() == 1 && one.likely) || earned(one.of, role, true)
                           : wish == 1 ? one.named && !made(one.of, role.stepper).program.empty()
                           : wish == 2 ? earned(one.of, role)
                                       : one.likely;
          if (here > best.first) best = {here, one.of};
        }
        if (best.second) chosen[role.name] = best.second;
      }
    for (const auto& [role, all] : open)
      for (const Candidate& one : all)
        if (!chosen.count(role) && made_.count(one.of)) failed.insert(one.of);
  }

  const Made& made(const ClassInfo* of, bool stepper) {
    if (!made_.count(of)) run_.allow(30), build({{of, stepper}});
    return made_.at(of);
  }

  /// Points earned in a role; with `all`, 1 if these are all points, otherwise 0.
  int earned(const ClassInfo* of, const Role& role, bool all = false) {
    const auto [at, added] = earned_.try_emplace({of, role.name});
    if (added && trial_) {
      tried = true;
      if (const Made& one = made(of, role.stepper); !one.program.empty()) at->second = trial_(one.program, role);
    }
    return all ? at->second.of > 0 && at->second.points == at->second.of : at->second.points;
  }

  Made built(const BuildStep& calls) const {
    const BuildStep link = plan_.link(calls, child_);
    Made one{link.makes, run_(calls)};
    if (one.said.empty()) one.said = run_(link);
    if (!one.said.empty()) one.program.clear();
    return one;
  }

  /// The class in a role, or null.
  const ClassInfo* in(std::string_view role) const {
    const auto at = chosen.find(role);
    return at == chosen.end() ? nullptr : at->second;
  }

  std::map<std::string_view, const ClassInfo*> chosen;  // role -> class; roles without a class have no entry
  std::set<const ClassInfo*> failed;                    // candidates that failed, for roles without a class
  bool tried = false;

 private:
  void build(const std::map<const ClassInfo*, bool>& classes) {
    std::vector<std::pair<const ClassInfo*, BuildStep>> steps;
    for (const auto& [of, stepper] : classes) steps.emplace_back(of, plan_.calls(*of, stepper));
    std::vector<Made> all(steps.size());
    parallel_for(steps.size(), tools_.jobs, [&](std::size_t i) { all[i] = built(steps[i].second); });
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (!all[i].said.empty() && plan_.declare_drawing(all[i].said)) all[i] = built(steps[i].second);
      made_[steps[i].first] = all[i];
    }
  }

  /// True if the class already has a role of another part.
  bool taken(const ClassInfo* of, const Role& role) const {
    return std::any_of(chosen.begin(), chosen.end(),
                       [&](const auto& one) { return one.second == of && role_of(one.first).part != role.part; });
  }

  const BuildPlan& plan_;
  StepRunner& run_;
  const Toolchain& tools_;
  const fs::path& child_;
  const Trial& trial_;
  const std::map<std::string, std::string>& wanted_;
  std::map<const ClassInfo*, Made> made_;
  std::map<std::pair<const ClassInfo*, std::string_view>, Earned> earned_;
};

/// Remarks on the chosen and the rejected classes and files, if there was a choice.
std::vector<Remark> choice_told(const ClassList& classes, const Choice& choice,
                                const std::map<std::string, std::string>& wanted) {
  std::vector<std::string> graded, others;
  std::set<const ClassInfo*> taken;
  for (const Role& role : roles())
    if (const ClassInfo* one = choice.in(role.name)) {
      taken.insert(one);
      graded.push_back(fmt::format("{} = {}{}", role.name, one->full(), one->ours ? "" : " (" + one->file + ")"));
    }
  for (const ClassInfo& one : classes)
    if (choice.tried && !taken.count(&one) && !one.ours && one.name != "RK4" &&
        (is_kind(classes, one, true) || is_kind(classes, one, false)))
      others.push_back(one.full());
  std::vector<Remark> notes;
  if (choice.tried || !wanted.empty())
    notes.push_back({others.empty() ? "whole.graded" : "whole.graded_of",
                     {fmt::format("{}", fmt::join(graded, ", ")), fmt::format("{}", fmt::join(others, ", "))}});
  for (const auto& [role, name] : wanted)
    if (const ClassInfo* one = choice.in(role); !one || (one->name != name && one->full() != name))
      notes.push_back({"choice.class", {role, name}});
  return notes;
}

}  // namespace

Programs build_programs(const Files& files, const fs::path& tree, const fs::path& coursework, const Sandbox& sandbox,
                        const Toolchain& tools, const std::vector<std::string>& parts, const Trial& trial,
                        const std::map<std::string, std::string>& wanted, bool rate) {
  const fs::path whole = fs::absolute(tree), ours = whole / "in" / "ours", child = whole / "in" / "child.o";
  copy_ours(fs::absolute(coursework), ours);
  fs::copy_file(tools.child, child);
  const BuildPlan plan(files, whole, ours);
  show(whole);
  StepRunner run(sandbox, tools, whole);
  const std::vector<BuildStep>& objects = plan.objects();
  std::vector<std::string> said(objects.size(), "not yet");
  std::string all_said;
  constexpr int most_rounds = 3;  // a round may reveal further names to declare
  for (int round = 0; round == 0 || (round < most_rounds && plan.declare_drawing(all_said)); ++round) {
    parallel_for(said.size(), tools.jobs, [&](std::size_t i) {
      if (!said[i].empty()) said[i] = run(objects[i]);
    });
    all_said.clear();
    for (const std::string& one : said) all_said += one;
  }
  run(plan.archive());

  Choice choice(plan, run, tools, child, trial, wanted);
  choice.decide(parts);
  Programs made;
  made.notes = choice_told(plan.classes(), choice, wanted);
  const auto why = [&](const ClassInfo& one, const std::string& captured) {
    // an error in a file of the student's explains more than the errors that follow from it
    for (std::size_t k = 0; k < said.size(); ++k)
      if (const std::string& file = objects[k].file; !said[k].empty() && !file.empty() && plan.concerns(file, one))
        return remark_on(one, file, said[k]);
    return remark_on(one, "", captured);
  };
  for (const ClassInfo* of : choice.failed)
    if (const Choice::Made& one = choice.made(of, is_kind(plan.classes(), *of, true)); one.program.empty())
      made.notes.push_back(why(*of, one.said));
  if (const ClassInfo* base = named(plan.classes(), "ParticleSystem"); base && !base->ours) made.base_file = base->file;
  for (const Role& role : roles()) {
    if (!parts.empty() && std::find(parts.begin(), parts.end(), role.part) == parts.end()) continue;
    const ClassInfo* of = choice.in(role.name);
    if (rate && of) made.points += choice.earned(of, role);
    if (role.name != role.part) continue;  // the pendulum's program also calls the chain
    Built& built = made.of[std::string(role.part)];
    if (!of) {
      built = {{}, {"whole.missing", {std::string(role.names.front())}}, true};
      continue;
    }
    Choice::Made one = choice.made(of, role.stepper);
    if (const ClassInfo* chain = choice.in("chain"); role.name == "pendulum" && chain && chain != of) {
      const Choice::Made both = choice.built(plan.calls(*of, false, chain));
      if (both.program.empty())
        made.notes.push_back(why(*chain, both.said));
      else
        one = both;
    }
    built.program = one.program;
    if (one.program.empty()) built.error = why(*of, one.said);
  }
  return made;
}

namespace {

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
    for (const char* folder : {"base", "probe", "starter", "stubs"})
      for (const auto& [path, content] : files_below(assignment.folder() / folder)) surroundings_ += path + content;
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
      const auto programs =
          build_programs(files, made.parent_path() / "tree", coursework_, trusted_, tools(&compiler_, 1), {part});
      const Built& built = programs.of.at(part);
      if (built.program.empty())
        throw std::runtime_error(
            fmt::format("classic, {}: {} {}", part, built.error.key, fmt::join(built.error.with, " ")));
      fs::copy_file(built.program, made);
    });
  }

  std::map<std::string, Built> theirs(const Submission& submission, const fs::path& folder,
                                      unsigned jobs) const override {
    Files files;
    Programs programs = best_version(submission, folder, jobs, files);
    mend_base(submission, std::move(files), programs, folder, jobs);
    // only the first part carries the remarks, and only as many as will be read
    programs.notes.resize(std::min(programs.notes.size(), most_notes));
    programs.of.begin()->second.notes = std::move(programs.notes);
    return std::move(programs.of);
  }

  Built checked(const Submission& submission, const std::string& part, const fs::path& folder) const override {
    return WholeBuilder(assignment_, trusted_, sandbox_, true).theirs(submission, folder, 1).at(part);
  }

  std::string file_of(const std::string& part) const override { return file_of_part(part); }

 private:
  fs::path child_source() const { return coursework_ / "check" / "child_main.cpp"; }

  Toolchain tools(const Compiler* cache, unsigned jobs) const {
    const fs::path child = compiler_.cached(key_of(surroundings_ + "child"), ".o", [&](const fs::path& made) {
      std::vector<std::string> command = command_;
      command.insert(command.end(), {"-std=c++17", "-O1", "-c", child_source().string(), "-o", made.string()});
      compile_ours(trusted_, command, made.parent_path(), "child_main.cpp");
    });
    return {command_, "/usr/bin/ar", child, cache, jobs};
  }

  /// Builds the whole program with each version of duplicate files, until one passes all public tests. `files` receives
  /// the files of the best version.
  Programs best_version(const Submission& submission, const fs::path& folder, unsigned jobs, Files& files) const {
    int all_points = 0;
    for (const Test& test : assignment_.tests) all_points += test.points;
    Programs best;
    std::vector<std::string> versions = {""};
    for (std::size_t i = 0; i < std::min<std::size_t>(versions.size(), most_versions); ++i) {
      const Selection selection = choose_files(submission.files, versions[i]);
      if (i == 0) versions.insert(versions.end(), selection.others.begin(), selection.others.end());
      Programs made = build_programs(
          selection.files, folder / ("tree" + std::to_string(i)), coursework_, sandbox_, tools(nullptr, jobs), parts_,
          [&](const fs::path& program, const Role& role) { return tried(program, role); }, submission.choice.classes,
          versions.size() > 1);
      made.notes.insert(made.notes.end(), selection.notes.begin(), selection.notes.end());
      if (i == 0 || made.points > best.points) best = std::move(made), files = selection.files;
      if (best.points == all_points) break;
    }
    return best;
  }

  /// Runs the role's public tests in the sandbox.
  Earned tried(const fs::path& program, const Role& role) const {
    Earned earned;
    for (const Test& test : assignment_.tests) {
      Random random(public_seed(assignment_, test));
      const std::vector<Case> cases = test.cases(random);
      const std::string& call = cases.front().call;
      if ((call == "field" ? "simple" : call.substr(0, call.find('.'))) != role.name) continue;
      const std::vector<Answer> answers = run_calls(sandbox_, program, cases, trial_limits);
      bool right = true;
      for (std::size_t i = 0; i < cases.size(); ++i) {
        if (answers[i].how == How::out_of_time) return {earned.points, 1000};  // too slow: not run again
        right = right && judge(cases[i], reduced(test, cases[i], answers[i])).right;
      }
      earned.of += test.points, earned.points += right ? test.points : 0;
    }
    return earned;
  }

  /// Replaces the student's base class by the starter's, if it cannot be used alone or loses the state, and if the
  /// steppers compile with the starter's. The steppers must not lose points for the student's base class.
  void mend_base(const Submission& submission, Files files, Programs& programs, const fs::path& folder,
                 unsigned jobs) const {
    const std::vector<std::string> steppers = {"euler", "trapezoidal"};
    const bool holds = std::all_of(programs.of.begin(), programs.of.end(), [&](const auto& one) {
      const auto& [part, built] = one;
      if (!role_of(part).stepper) return true;
      if (built.program.empty()) return built.error.key != "whole.interface";
      const Answer answer = run_calls(sandbox_, built.program, {{"base", {}, {1}}}).front();
      return answer.how == How::answered && answer.got == Numbers{1};
    });
    if (programs.base_file.empty() || holds) return;
    std::erase_if(files, [&](const auto& file) {
      return file.first == programs.base_file ||
             (is_source(file.first) && defines_member(tokens_of(file.second), "ParticleSystem", "ParticleSystem"));
    });
    Programs mended = build_programs(files, folder / "tree-base", coursework_, sandbox_, tools(nullptr, jobs), steppers,
                                     nullptr, submission.choice.classes);
    const bool all =
        std::all_of(mended.of.begin(), mended.of.end(), [](const auto& one) { return !one.second.program.empty(); });
    if (all) mended.of.merge(programs.of), programs.of.swap(mended.of);
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
  std::string surroundings_;  // fingerprint of everything that is compiled around a solution
};

}  // namespace

std::unique_ptr<Builder> whole_builder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox) {
  return std::make_unique<WholeBuilder>(assignment, trusted, sandbox);
}

}  // namespace coursework::classic
