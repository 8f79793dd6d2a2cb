// Lays a submission out so that every include of it is met, and plans the compiler's calls.
#include "tests/coursework/classic/build_plan.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/coursework/grader/build.h"

namespace coursework::classic {
namespace fs = std::filesystem;
namespace {

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

BuildPlan::BuildPlan(const Files& submitted, fs::path tree, fs::path coursework,
                     std::map<std::string, std::string> wanted)
    : tree_(fs::absolute(tree)),
      ours_(fs::absolute(coursework) / "classic"),
      coursework_(fs::absolute(coursework)),
      wanted_(std::move(wanted)) {
  files_ = choose_files(submitted, notes_);
  for (auto& [path, content] : files_) {
    content = with_includes(content, inside);
    tokens_[path] = tokens_of(content);
  }
  lay_out();
  plan_objects();
  list_classes();
  plan_parts(classes_.choose({}, wanted_));
}

BuildStep BuildPlan::compile(const std::string& source, const std::string& object, const std::string& standard,
                             const std::vector<std::string>& more) const {
  // no-strict-aliasing and no-lifetime-dse: old code reads memory as it likes, and finds it zeroed
  BuildStep step;
  step.words = {"-std=" + standard,
                "-O1",
                "-w",
                "-fno-strict-aliasing",
                "-fno-lifetime-dse",
                as_student_folder(tree_ / "in" / "his")};
  step.words.insert(step.words.end(), options_.begin(), options_.end());
  step.words.insert(step.words.end(), more.begin(), more.end());
  step.makes = tree_ / "out" / object;
  step.source = source;
  step.words.insert(step.words.end(), {"-c", source, "-o", step.makes.string()});
  return step;
}

void BuildPlan::plan_objects() {
  int number = 0;
  for (const auto& [path, content] : files_) {
    if (!is_source(path)) continue;
    BuildStep step = compile((tree_ / "in" / "his" / path).string(), "his" + std::to_string(number++) + ".o", "gnu++14",
                             {"-fpermissive", "-Dmain=main_of_the_student"});
    step.file = path;
    objects_.push_back(step);
  }
  // tests/coursework/grader/main.cpp last: nobody waits for it
  std::stable_partition(objects_.begin(), objects_.end(),
                        [](const BuildStep& step) { return lower(base_name(step.file)).rfind("main.", 0) != 0; });
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

bool BuildPlan::find(const std::vector<std::string_view>& names, std::string& file, std::string& name) const {
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

void BuildPlan::list_classes() {
  std::vector<ClassInfo> all;
  for (const int round : {0, 1, 2})  // the student's headers, his sources, ours
    for (const auto& [path, words] : tokens_) {
      const bool his = files_.count(path) > 0;
      if (round != (his ? (is_header(path) ? 0 : 1) : 2)) continue;
      for (ClassInfo& one : classes_in(words, path)) {
        one.ours = !his;
        all.push_back(std::move(one));
      }
    }
  classes_ = ClassList(std::move(all));
}

std::string BuildPlan::file_on_disk(const ClassInfo& one) const {
  return one.ours ? one.file : (tree_ / "in" / "his" / one.file).string();
}

std::string BuildPlan::base_file() const {
  const auto base = classes_.named("ParticleSystem");
  return base && !classes_.at(*base).ours ? classes_.at(*base).file : "";
}

std::vector<std::string> BuildPlan::names_of(int of) const {
  const ClassInfo& one = classes_.at(of);
  std::vector<std::string> more = {defined("STUDENT_HEADER", file_on_disk(one)),
                                   "-DSTUDENT_CLASS=" + one.full(),
                                   "-DANSWER=answer",
                                   "-DOWN_PROCESS",
                                   "-I" + ours_.string(),
                                   "-I" + (coursework_ / "check").string()};
  // a class that stands in the file of a main of its own
  if (!is_header(one.file)) more.push_back("-Dmain=main_of_the_student");
  const auto base = classes_.named("ParticleSystem");
  if (!base) return more;
  // a source that holds both has no guard against being included twice
  if (classes_.at(*base).file != one.file) more.push_back(defined("PARTICLE_HEADER", file_on_disk(classes_.at(*base))));
  if (const std::string& scope = classes_.at(*base).scope; !scope.empty()) more.push_back("-DPARTICLE_SCOPE=" + scope);
  return more;
}

std::vector<Scout> BuildPlan::scouts() const {
  std::vector<Scout> all;
  constexpr std::size_t most = 16;  // of each kind, a few seconds each; a course's program has four
  for (const bool stepper : {false, true}) {
    if (!classes_.ambiguous(stepper)) continue;
    std::vector<int> candidates = classes_.candidates(stepper);
    candidates.resize(std::min(candidates.size(), most));
    for (const int of : candidates) {
      Scout scout{of, stepper, {}};
      scout.build.part = "scout" + std::to_string(of);
      std::vector<std::string> more = names_of(of);
      if (stepper) more.push_back("-DSTEPPER");
      scout.build.calls = compile((ours_ / "base" / "scout.cpp").string(), scout.build.part + ".o", "gnu++20", more);
      all.push_back(std::move(scout));
    }
  }
  return all;
}

void BuildPlan::choose(const std::map<int, Fits>& fits) {
  parts_.clear();
  const Chosen chosen = classes_.choose(fits, wanted_);
  plan_parts(chosen);
  if (!fits.empty() || !wanted_.empty()) tell_choice(chosen, !fits.empty());
}

void BuildPlan::tell_choice(const Chosen& chosen, bool tried) {
  for (const auto& [role, name] : wanted_) {
    const auto of = chosen.of.find(role);
    const bool met =
        of != chosen.of.end() && (classes_.at(of->second).name == name || classes_.at(of->second).full() == name);
    if (!met) notes_.insert(notes_.begin(), {"choice.class", {role, name}});
  }
  std::string graded, others;
  for (const Role& role : roles())
    if (const auto of = chosen.of.find(role.name); of != chosen.of.end()) {
      const ClassInfo& one = classes_.at(of->second);
      graded += (graded.empty() ? "" : ", ") + std::string(role.name) + " = " + one.full();
      if (!one.ours) graded += " (" + one.file + ")";
    }
  for (const int i : chosen.others)
    if (!classes_.at(i).ours && classes_.at(i).name != "RK4")
      others += (others.empty() ? "" : ", ") + classes_.at(i).full();
  const bool all = others.empty() || !tried;
  notes_.insert(notes_.begin(), {all ? "whole.graded" : "whole.graded_of", {graded, others}});
}

void BuildPlan::plan_parts(const Chosen& chosen) {
  for (const Role& role : roles()) {
    if (role.name != role.part) continue;  // the chain, which the pendulum's program calls
    PartBuild plan;
    plan.part = role.part;
    const auto of = chosen.of.find(role.name);
    if (of == chosen.of.end()) {
      plan.missing = role.names.front();
      parts_.push_back(plan);
      continue;
    }
    std::vector<std::string> more = names_of(of->second), names = {classes_.at(of->second).name};
    const auto chain = chosen.of.find("chain");
    if (role.part == "pendulum" && chain != chosen.of.end() && chain->second != of->second) {
      const ClassInfo& other = classes_.at(chain->second);
      more.insert(more.end(),
                  {defined("STUDENT_CHAIN_HEADER", file_on_disk(other)), "-DSTUDENT_CHAIN=" + other.full()});
      names.push_back(other.name);
    }
    plan.calls =
        compile((ours_ / ("calls_" + plan.part + ".cpp")).string(), "calls_" + plan.part + ".o", "gnu++20", more);
    for (const auto& [path, content] : files_) {
      const std::vector<std::string>& words = tokens_.at(path);
      for (const std::string& name : names)
        if (defines_class(words, name) || defines_member(words, name, "evalF") ||
            defines_member(words, name, "takeStep") || defines_member(words, name, name)) {
          plan.files.push_back(path);
          break;
        }
    }
    parts_.push_back(plan);
  }
}

std::vector<BuildStep> BuildPlan::archives() const {
  // an object is taken out only where something needs it: one that lacks a symbol of its own costs nobody else
  BuildStep his{{"rcs", (tree_ / "out" / "libhis.a").string()}, tree_ / "out" / "libhis.a", "", true};
  BuildStep base{{"rcs", (tree_ / "out" / "libbase.a").string()}, tree_ / "out" / "libbase.a", "", true};
  for (const BuildStep& step : objects_)
    if (fs::symlink_status(step.makes).type() == fs::file_type::regular)
      (step.file.empty() ? base : his).words.push_back(step.makes.string());
  return {his, base};
}

BuildStep BuildPlan::link(const PartBuild& part, const fs::path& child) const {
  const fs::path out = tree_ / "out" / part.part;
  return {{child.string(), part.calls.makes.string(), (tree_ / "out" / "libhis.a").string(),
           (tree_ / "out" / "libbase.a").string(), "-o", out.string()},
          out,
          "",
          false};
}

// Lays a submission out so that every include of it is met: the student's files, ours for what is missing, and headers
// that lead to those written in another case.

namespace {

void write(const fs::path& file, const std::string& content) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << content;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

bool has_control(const std::string& name) {
  return std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 32; });
}

/// Whether a file can be written there: nothing above it is a file, and it is no folder.
bool free_place(const fs::path& top, const fs::path& name) {
  fs::path at = top;
  for (const fs::path& part : name.parent_path())
    if (fs::is_regular_file(at /= part)) return false;
  return !fs::is_directory(top / name);
}

}  // namespace

void BuildPlan::lay_out() {
  fs::create_directories(tree_ / "out");
  for (const auto& [path, content] : files_) write(tree_ / "in" / "his" / path, content);
  bool newer = false;
  for (const auto& [path, words] : tokens_)
    newer = newer || std::count(words.begin(), words.end(), "GLProgram") > 0 || base_name(path) == "timestepper.cpp";
  add_base(ours_ / "base" / (newer ? "2016" : "2012"));

  std::vector<std::string> folders = this->folders();
  folders.insert(folders.end(), {(tree_ / "in" / "base").string(), (ours_ / "stubs").string()});
  add_forwarders(folders);
  folders.insert(folders.begin(), (tree_ / "in" / "case").string());
  options_ = {"-include", (ours_ / "stubs" / "prelude.h").string()};
  add_drawing();
  for (const std::string& folder : folders) options_.push_back("-I" + folder);
}

/// Headers of ours for what the student left to the course. One whose name or class is the student's own is none.
void BuildPlan::add_base(const fs::path& base) {
  fs::create_directories(tree_ / "in" / "base");
  std::map<std::string, std::vector<std::string>> ours;
  for (const auto& entry : fs::directory_iterator(base)) {
    const std::string name = entry.path().filename().string();
    bool his = !is_header(name);
    for (const auto& [path, words] : tokens_) {
      his = his || lower(base_name(path)) == lower(name);
      for (const char* known : {"ParticleSystem", "TimeStepper", "GLProgram"})
        his = his || (defines_class(tokens_of(content_of_file(entry.path())), known) && defines_class(words, known));
    }
    if (his) continue;
    const fs::path copy = tree_ / "in" / "base" / name;
    write(copy, content_of_file(entry.path()));
    ours[copy.string()] = tokens_of(content_of_file(copy));
  }
  tokens_.insert(ours.begin(), ours.end());
}

/// Those of the student's that hold headers, those with most first, and the folders above them.
std::vector<std::string> BuildPlan::folders() const {
  std::map<std::string, int> counts;
  for (const auto& [path, content] : files_)
    if (is_header(path)) ++counts[folder_name(path)];
  std::vector<std::pair<int, std::string>> order;
  for (const auto& [folder, count] : counts) order.push_back({-count, folder});
  for (const auto& [folder, count] : counts)
    for (std::string up = folder; !up.empty();) {
      up = folder_name(up);
      if (!counts.count(up)) order.push_back({0, up});
    }
  std::sort(order.begin(), order.end());
  order.erase(std::unique(order.begin(), order.end()), order.end());
  std::vector<std::string> folders;
  for (const auto& [count, folder] : order) folders.push_back((tree_ / "in" / "his" / folder).string());
  return folders;
}

/// For an include that is met only when letters' case is forgotten, or by its last name: a file that leads there.
void BuildPlan::add_forwarders(const std::vector<std::string>& folders) {
  std::map<std::string, fs::path> known;  // lower-case name -> file
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
    if (!fs::is_directory(*folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(*folder)) {
      if (!entry.is_regular_file()) continue;
      const fs::path within = entry.path().lexically_relative(*folder);
      if (within.has_parent_path()) known[lower(within.generic_string())] = entry.path();
      // the stubs' gl.h in its folder is not what "gl.h" alone means
      if (!within.has_parent_path() || *folder != folders.back())
        known[lower(entry.path().filename().string())] = entry.path();
    }
  }
  Files all = files_;
  for (const auto& entry : fs::directory_iterator(tree_ / "in" / "base"))
    all["../base/" + entry.path().filename().string()] = content_of_file(entry.path());
  for (const auto& [path, content] : all)
    for (const std::string& name : includes_of(content)) {
      // nothing that we would make is called so
      if (name.empty() || name.size() > 200 || has_control(name)) continue;
      bool met = fs::exists(tree_ / "in" / "his" / folder_name(path) / name);
      for (const std::string& folder : folders) met = met || fs::exists(fs::path(folder) / name);
      if (met) continue;
      auto found = known.find(lower(name));
      if (found == known.end()) found = known.find(lower(base_name(name)));
      // <string> stays the standard's
      if (found == known.end() || name.find('.') == std::string::npos) continue;
      if (!free_place(tree_ / "in" / "case", name)) {
        notes_.push_back({"whole.include", {path, name}});
        continue;
      }
      write(tree_ / "in" / "case" / name, "#include \"" + found->second.string() + "\"\n");
    }
}

/// Names of OpenGL that our stubs lack.
void BuildPlan::add_drawing() {
  GlNames used;
  for (const auto& [path, content] : files_) {
    const GlNames here = gl_names_in(tokens_.at(path));
    used.functions.insert(here.functions.begin(), here.functions.end());
    used.constants.insert(here.constants.begin(), here.constants.end());
  }
  std::set<std::string> known;
  for (const char* name : {"GL/gl.h", "GL/glu.h", "GL/glut.h", "GLFW/glfw3.h"}) {
    const std::string text = content_of_file(ours_ / "stubs" / name);
    for (std::string word : tokens_of(text)) known.insert(std::move(word));
    std::istringstream lines(text);
    for (std::string define, word; lines >> define;)
      if (define == "#define" && lines >> word) known.insert(word);
  }
  // a function that the student defines in another file is his as well
  for (const auto& [path, words] : tokens_)
    for (std::size_t i = 1; i + 1 < words.size(); ++i)
      if (used.functions.count(words[i]) && words[i + 1] == "(" && words[i - 1] == "void")
        used.functions.erase(words[i]);
  std::string text;
  for (const std::string& name : used.functions)
    if (!known.count(name)) text += "CLASSIC_NOTHING(" + name + ")\n";
  int value = 0x50000;
  for (const std::string& name : used.constants)
    if (!known.count(name))
      text += "#ifndef " + name + "\n#define " + name + " " + std::to_string(value++) + "\n#endif\n";
  if (text.empty()) return;
  const fs::path file = tree_ / "in" / "names.h";
  write(file, "#pragma once\n#include <GL/glut.h>\n" + text);
  options_.insert(options_.end(), {"-include", file.string()});
}

}  // namespace coursework::classic
