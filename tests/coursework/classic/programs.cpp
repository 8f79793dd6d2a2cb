#include "tests/coursework/classic/programs.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <sstream>

#include "mysim/fnv.h"
#include "tests/coursework/grader/compiler.h"
#include "tests/coursework/grader/parallel.h"

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

/// The lane may run the compiler as another user, who must get to all of it.
void show(const fs::path& folder) {
  fs::permissions(folder, fs::perms(0755));
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    fs::permissions(entry.path(), fs::perms(entry.is_directory() ? 0755 : 0644));
}

class Run {
 public:
  Run(const Lane& lane, const Tools& tools, const fs::path& tree) : lane_(lane), tools_(tools), tree_(tree) {
    if (tools.cache.empty()) return;
    for (const auto& [path, content] : files_below(tree_ / "in"))
      if (is_header(path)) headers_ += path + "\n" + content;
  }

  /// What was said; empty where the file was made.
  std::string operator()(const Step& step) {
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
    limits.wall = std::min(limits.wall, tools_.seconds - spent_);
    if (!(limits.wall > 0)) return std::string(too_long);
    const auto begin = std::chrono::steady_clock::now();
    const End end =
        lane_.run({.command = command, .readable = {tree_ / "in", tree_ / "out"}, .writable = work, .limits = limits});
    spent_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (end.how == End::How::cpu || end.how == End::How::wall) return std::string(too_long);
    if (end.how != End::How::exited || end.code != 0 || !there(made))
      return end.chatter.empty() ? "it ended and said nothing" : end.chatter;
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
  std::string key(const Step& step) const {
    std::string text = headers_;
    for (const std::string& word : tools_.compiler) text += word + "\n";
    for (std::string word : step.words) {
      for (std::size_t at; (at = word.find(tree_.string())) != std::string::npos;)
        word.replace(at, tree_.string().size(), "@");
      text += word + "\n";
    }
    std::ifstream in(step.source, std::ios::binary);
    std::stringstream content;
    content << in.rdbuf();
    text += content.str();
    std::stringstream hex;
    hex << std::hex << crosscheck::Fnv1a::of(text) << crosscheck::Fnv1a::of(text + "/");
    return hex.str();
  }

  const Lane& lane_;
  const Tools& tools_;
  fs::path tree_;
  std::string headers_;
  std::atomic<double> spent_ = 0;  // s, by all that ran, side by side or not
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
    std::ifstream in(entry.path(), std::ios::binary);
    std::stringstream content;
    content << in.rdbuf();
    files[entry.path().lexically_relative(folder).generic_string()] = content.str();
  }
  return files;
}

Programs build_programs(const Files& files, const fs::path& tree, const fs::path& coursework, const Lane& lane,
                        const Tools& tools, const std::vector<std::string>& wanted) {
  const fs::path whole = fs::absolute(tree), ours = whole / "in" / "ours", child = whole / "in" / "child.o";
  copy_ours(fs::absolute(coursework), ours);
  fs::copy_file(tools.child, child);
  const Plan plan(files, whole, ours);
  show(whole);
  Run run(lane, tools, whole);
  std::vector<const PartPlan*> parts;
  Programs made{{}, plan.notes()};
  std::map<std::string, Program>& programs = made.of;
  for (const PartPlan& part : plan.parts()) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), part.part) == wanted.end()) continue;
    programs[part.part].missing = part.missing;
    if (part.missing.empty()) parts.push_back(&part);
  }
  std::vector<const Step*> steps;
  for (const PartPlan* part : parts) steps.push_back(&part->calls);
  for (const Step& step : plan.objects()) steps.push_back(&step);
  std::vector<std::string> said(steps.size());
  in_parallel(steps.size(), tools.jobs, [&](std::size_t i) { said[i] = run(*steps[i]); });
  for (const Step& archive : plan.archives()) run(archive);

  in_parallel(parts.size(), tools.jobs, [&](std::size_t i) {
    Program& program = programs.at(parts[i]->part);
    const Step link = plan.link(*parts[i], child);
    program.chatter = said[i].empty() ? run(link) : said[i];
    if (program.chatter.empty()) {
      program.file = link.makes;
      return;
    }
    // a file of the student's that does not compile explains more than what is missing because of it
    for (std::size_t k = 0; k < steps.size(); ++k)
      if (!said[k].empty() && std::count(parts[i]->files.begin(), parts[i]->files.end(), steps[k]->file)) {
        program.source = steps[k]->file;
        program.chatter = said[k];
        return;
      }
  });
  return made;
}

}  // namespace coursework::classic
