// Plans the compiler's calls.
#include "tests/coursework/classic/build.h"

#include <algorithm>

namespace coursework::classic {
namespace fs = std::filesystem;
namespace {

/// The names under which each part's class has been seen. The chain is the pendulum's class where it has none.
const std::vector<std::pair<std::string_view, std::vector<std::string_view>>> classes = {
    {"euler", {"ForwardEuler", "Euler", "ExplicitEuler", "EulerStepper"}},
    {"trapezoidal", {"Trapzoidal", "Trapezoidal", "Trapezoid", "TrapezoidalRule"}},
    {"simple", {"SimpleSystem"}},
    {"pendulum", {"PendulumSystem", "Pendulum", "SimplePendulum"}},
    {"cloth", {"ClothSystem", "Cloth"}},
};
const std::vector<std::string_view> chain_names = {"ChainSystem", "ParticleChain", "PendulumChain", "ChainPendulum"};

/// Paths that lead out of the folder, or to another machine's disk, keep their last name, which is then looked for.
std::string inside(const std::string& written) {
  std::string name = written;
  std::replace(name.begin(), name.end(), '\\', '/');
  const bool leads_out =
      name.find("..") != std::string::npos || name.find(':') != std::string::npos || name.rfind('/', 0) == 0;
  return leads_out ? base_name(name) : name;
}

std::string defined(const std::string& name, const std::string& path) { return "-D" + name + "=\"" + path + "\""; }

}  // namespace

Plan::Plan(const Files& submitted, fs::path tree, fs::path coursework)
    : tree_(fs::absolute(tree)), ours_(fs::absolute(coursework) / "classic"), coursework_(fs::absolute(coursework)) {
  files_ = choose_files(submitted, notes_);
  for (auto& [path, content] : files_) {
    content = with_includes(content, inside);
    tokens_[path] = tokens_of(content);
  }
  lay_out();
  plan_objects();
  for (const auto& [part, names] : classes) plan_part(part, names);
}

Step Plan::compile(const std::string& source, const std::string& object, const std::string& standard,
                   const std::vector<std::string>& more) const {
  // no-strict-aliasing and no-lifetime-dse: old code reads memory as it likes, and finds it zeroed
  Step step;
  step.words = {"-std=" + standard, "-O1", "-g0", "-w", "-fno-strict-aliasing", "-fno-lifetime-dse"};
  step.words.insert(step.words.end(), options_.begin(), options_.end());
  step.words.insert(step.words.end(), more.begin(), more.end());
  step.makes = tree_ / "out" / object;
  step.source = source;
  step.words.insert(step.words.end(), {"-c", source, "-o", step.makes.string()});
  return step;
}

void Plan::plan_objects() {
  int number = 0;
  for (const auto& [path, content] : files_) {
    if (!is_source(path)) continue;
    Step step = compile((tree_ / "in" / "his" / path).string(), "his" + std::to_string(number++) + ".o", "gnu++14",
                        {"-fpermissive", "-Dmain=main_of_the_student"});
    step.file = path;
    objects_.push_back(step);
  }
  // main.cpp last: nobody waits for it
  std::stable_partition(objects_.begin(), objects_.end(),
                        [](const Step& step) { return lower(base_name(step.file)).rfind("main.", 0) != 0; });
  const auto lacks = [&](const char* owner, const char* name) {
    return std::none_of(files_.begin(), files_.end(),
                        [&](const auto& file) { return defines_member(tokens_.at(file.first), owner, name); });
  };
  std::string file, name;
  if (find({"RK4"}, file, name) && lacks("RK4", "takeStep"))
    objects_.push_back(
        compile((ours_ / "base" / "rk4.cpp").string(), "base_rk4.o", "gnu++14", {defined("STEPPERS", file)}));
  if (find({"ParticleSystem"}, file, name) && lacks("ParticleSystem", "ParticleSystem"))
    objects_.push_back(
        compile((ours_ / "base" / "system.cpp").string(), "base_system.o", "gnu++14", {defined("SYSTEM", file)}));
}

bool Plan::find(const std::vector<std::string_view>& names, std::string& file, std::string& name) const {
  for (const int round : {0, 1, 2})  // the student's headers, his sources, ours
    for (const std::string_view wanted : names)
      for (const auto& [path, words] : tokens_) {
        const bool his = files_.count(path) > 0;
        if (round != (his ? (is_header(path) ? 0 : 1) : 2)) continue;
        const auto found = defines_class(words, std::string(wanted));
        if (!found) continue;
        file = his ? (tree_ / "in" / "his" / path).string() : path;
        name = *found;
        return true;
      }
  return false;
}

void Plan::plan_part(std::string_view part, const std::vector<std::string_view>& names) {
  PartPlan plan;
  plan.part = part;
  std::string file, name;
  if (!find(names, file, name)) {
    plan.missing = names.front();
    parts_.push_back(plan);
    return;
  }
  std::vector<std::string> more = {defined("STUDENT_HEADER", file),
                                   "-DSTUDENT_CLASS=" + name,
                                   "-DANSWER=answer",
                                   "-DOWN_PROCESS",
                                   "-I" + ours_.string(),
                                   "-I" + (coursework_ / "check").string()};
  // a class that stands in the file of a main of its own
  if (!is_header(file)) more.push_back("-Dmain=main_of_the_student");
  std::string other_file, other;
  if (part == "pendulum" && find(chain_names, other_file, other))
    more.insert(more.end(), {defined("STUDENT_CHAIN_HEADER", other_file), "-DSTUDENT_CHAIN=" + other});
  if ((part == "euler" || part == "trapezoidal") && find({"ParticleSystem"}, other_file, other))
    more.push_back(defined("PARTICLE_HEADER", other_file));
  plan.calls =
      compile((ours_ / ("calls_" + plan.part + ".cpp")).string(), "calls_" + plan.part + ".o", "gnu++20", more);
  for (const auto& [path, content] : files_) {
    const std::vector<std::string>& words = tokens_.at(path);
    if (defines_class(words, name) || defines_member(words, name, "evalF") || defines_member(words, name, "takeStep") ||
        defines_member(words, name, name))
      plan.files.push_back(path);
  }
  parts_.push_back(plan);
}

std::vector<Step> Plan::archives() const {
  // an object is taken out only where something needs it: one that lacks a symbol of its own costs nobody else
  Step his{{"rcs", (tree_ / "out" / "libhis.a").string()}, tree_ / "out" / "libhis.a", "", true};
  Step base{{"rcs", (tree_ / "out" / "libbase.a").string()}, tree_ / "out" / "libbase.a", "", true};
  for (const Step& step : objects_)
    if (fs::symlink_status(step.makes).type() == fs::file_type::regular)
      (step.file.empty() ? base : his).words.push_back(step.makes.string());
  return {his, base};
}

Step Plan::link(const PartPlan& part, const fs::path& child) const {
  const fs::path out = tree_ / "out" / part.part;
  return {{child.string(), part.calls.makes.string(), (tree_ / "out" / "libhis.a").string(),
           (tree_ / "out" / "libbase.a").string(), "-o", out.string()},
          out,
          "",
          false};
}

}  // namespace coursework::classic
