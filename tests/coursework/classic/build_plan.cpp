#include "tests/coursework/classic/build_plan.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "mysim/base/files.h"
#include "mysim/base/pattern.h"
#include "tests/coursework/grader/build.h"

namespace coursework::classic {
namespace fs = std::filesystem;
namespace {

std::string defined(const std::string& name, const fs::path& path) {
  return "-D" + name + "=\"" + path.string() + "\"";
}

/// Our headers: lower-case path -> path, both relative to `folder`.
std::map<std::string, std::string> headers_below(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (const std::string path = entry.path().lexically_relative(folder).generic_string(); entry.is_regular_file())
      all[lower(path)] = path;
  return all;
}

}  // namespace

BuildPlan::BuildPlan(const Files& files, const fs::path& tree, const fs::path& coursework)
    : tree_(fs::absolute(tree)), ours_(fs::absolute(coursework) / "classic"), files_(files) {
  fs::create_directories(tree_ / "out");
  for (const auto& [path, content] : files_) tokens_[path] = tokens_of(content);
  write_files();
  plan_objects();
}

/// All files are in one folder under their flat names, and includes are redirected there whatever folder and case they
/// use. Errors and crashes still report the student's own paths (#line).
void BuildPlan::write_files() {
  const fs::path here = tree_ / "in" / "his";
  bool newer = false;
  std::set<std::string> his;
  for (const auto& [path, words] : tokens_) {
    his.insert(flat_name(path));
    newer = newer || std::count(words.begin(), words.end(), "GLProgram") > 0 || base_name(path) == "timestepper.cpp";
  }
  const fs::path course = ours_ / (newer ? "stubs/course2016" : "starter");
  auto base = headers_below(course);
  const auto stubs = headers_below(ours_ / "stubs");
  std::erase_if(base, [&](const auto& one) {
    return !newer && one.first != "timestepper.hpp" && one.first != "particlesystem.h";
  });
  std::vector<std::string> left_to_the_course;  // headers of `base` that the student's files include
  const auto lead = [&](const std::string& written, bool in_brackets) -> std::string {
    std::string name = written;
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::string last = base_name(name), flat = lower(last);
    if (const auto known = stubs.find(lower(name)); known != stubs.end() && (!his.count(flat) || flat != lower(name)))
      return "<" + known->second + ">";
    // a system header such as <time.h>, even if the student has a file Time.h
    if (in_brackets && (fs::exists(fs::path("/usr/include") / name) || name.starts_with("sys/")))
      return "<" + name + ">";
    if (base.count(flat) && !his.count(flat)) left_to_the_course.push_back(flat);
    if (base.count(flat) || his.count(flat)) return "\"" + flat + "\"";
    for (const auto& [lower_case, path] : stubs)
      if (base_name(lower_case) == flat) return "<" + path + ">";
    const bool leads_out = name.starts_with("/") || name.find("..") != name.npos || name.find(':') != name.npos;
    return leads_out ? "\"" + last + "\"" : "";
  };
  const auto list = [&](const std::vector<std::string>& tokens, const std::string& path, bool ours) {
    for (ClassInfo& one : classes_in(tokens, path)) one.ours = ours, classes_.push_back(std::move(one));
  };
  for (const bool headers : {true, false})
    for (const auto& [path, content] : files_) {
      if (is_header(path) != headers) continue;
      const std::string named = "#line 1 \"" + std::string(student_folder) + "/" + path + "\"\n";
      crosscheck::write_file(here / flat_name(path), named + with_includes(content, lead));
      list(tokens_.at(path), path, false);
    }
  for (std::size_t i = 0; i < left_to_the_course.size(); ++i) {
    const std::string name = left_to_the_course[i], content = content_of_file(course / base.at(name));
    if (fs::exists(here / name)) continue;
    crosscheck::write_file(here / name, with_includes(content, lead));
    list(tokens_of(content), name, true);
  }
  // the class may be defined by a macro, a typedef or an alias
  for (const Role& role : roles())
    for (const std::string_view name : role.names)
      for (const auto& [path, words] : tokens_) {
        const auto at = std::find(words.begin(), words.end(), name);
        if (at == words.end() || at == words.begin() || named(classes_, name)) continue;
        static const std::set<std::string> makers = {"using", "(", ",", ">"};
        if (makers.count(at[-1]) ||
            std::find(at - std::min<std::ptrdiff_t>(8, at - words.begin()), at, "typedef") != at)
          classes_.push_back({std::string(name), "", path, {}});
      }
  crosscheck::write_file(tree_ / "in" / "names.h", "");
}

BuildStep BuildPlan::compile(const fs::path& source, const std::string& object, const std::string& standard,
                             const std::vector<std::string>& more) const {
  // no-strict-aliasing and no-lifetime-dse, because old code may violate aliasing rules and rely on zeroed memory;
  // permissive, because students' code may have been accepted by Visual Studio
  BuildStep step;
  step.words = {"-std=" + standard, "-O1", "-w", "-fpermissive", "-fno-strict-aliasing", "-fno-lifetime-dse"};
  for (const fs::path& forced : {ours_ / "stubs" / "prelude.h", tree_ / "in" / "names.h"})
    step.words.insert(step.words.end(), {"-include", forced.string()});
  step.words.push_back("-I" + (ours_ / "stubs").string());
  step.words.insert(step.words.end(), more.begin(), more.end());
  step.makes = tree_ / "out" / object;
  step.source = source;
  step.words.insert(step.words.end(), {"-c", source.string(), "-o", step.makes.string()});
  return step;
}

void BuildPlan::plan_objects() {
  for (const auto& [path, content] : files_)
    if (is_source(path)) {
      objects_.push_back(compile(tree_ / "in" / "his" / flat_name(path), "his" + std::to_string(objects_.size()) + ".o",
                                 "gnu++14", {"-Dmain=main_of_the_student"}));
      objects_.back().file = path;
    }
  // compiles main.cpp last, because nothing depends on it
  std::stable_partition(objects_.begin(), objects_.end(),
                        [](const BuildStep& step) { return !flat_name(step.file).starts_with("main."); });
  for (const auto& [owner, member] : {std::pair{"RK4", "takeStep"}, {"ParticleSystem", "ParticleSystem"}})
    if (const ClassInfo* one = named(classes_, owner);
        one && std::none_of(tokens_.begin(), tokens_.end(),
                            [&](const auto& file) { return defines_member(file.second, owner, member); }))
      objects_.push_back(compile(ours_ / "base" / "given.cpp", std::string("given") + owner + ".o", "gnu++14",
                                 {defined("GIVEN", file_on_disk(*one)), std::string("-DGIVEN_") + owner}));
}

fs::path BuildPlan::file_on_disk(const ClassInfo& one) const { return tree_ / "in" / "his" / flat_name(one.file); }

BuildStep BuildPlan::calls(const ClassInfo& of, bool stepper, const ClassInfo* chain) const {
  std::vector<std::string> more = {defined("STUDENT_HEADER", file_on_disk(of)), "-DSTUDENT_CLASS=" + of.full(),
                                   "-DOWN_PROCESS", "-I" + ours_.string(), "-I" + (ours_ / ".." / "check").string()};
  if (stepper) more.push_back("-DSTEPPER");
  if (of.name == "SimpleSystem") more.push_back("-DFIELD");  // the class's only role; compiling all roles costs 2 s
  if (chain)
    more.insert(more.end(),
                {defined("STUDENT_CHAIN_HEADER", file_on_disk(*chain)), "-DSTUDENT_CHAIN=" + chain->full()});
  // the class may be defined in a file that has its own main
  if (!is_header(of.file)) more.push_back("-Dmain=main_of_the_student");
  if (const ClassInfo* base = named(classes_, "ParticleSystem")) {
    // a source that contains both classes has no include guard, so it must be included only once
    if (base->file != of.file) more.push_back(defined("PARTICLE_HEADER", file_on_disk(*base)));
    if (!base->scope.empty()) more.push_back("-DPARTICLE_SCOPE=" + base->scope);
  }
  const std::string object = chain ? "both.o" : "class" + std::to_string(&of - classes_.data()) + ".o";
  return compile(ours_ / "base" / "class_calls.cpp", object, "gnu++20", more);
}

bool BuildPlan::concerns(const std::string& file, const ClassInfo& of) const {
  return file == of.file || defines_member(tokens_.at(file), of.name, "evalF") ||
         defines_member(tokens_.at(file), of.name, "takeStep") || defines_member(tokens_.at(file), of.name, of.name);
}

BuildStep BuildPlan::archive() const {
  // The linker extracts an object only if something needs the object, so a missing symbol affects only its users. Ours
  // come last, because the linker takes the first of several definitions.
  const fs::path all = tree_ / "out" / "liball.a";
  BuildStep step{{"rcs", all.string()}, all, "", true};
  for (const BuildStep& object : objects_)
    if (fs::symlink_status(object.makes).type() == fs::file_type::regular) step.words.push_back(object.makes.string());
  return step;
}

BuildStep BuildPlan::link(const BuildStep& calls, const fs::path& child) const {
  const fs::path out = fs::path(calls.makes).replace_extension();
  return {{child.string(), calls.makes.string(), (tree_ / "out" / "liball.a").string(), "-o", out.string()}, out};
}

bool BuildPlan::declare_drawing(const std::string& captured_output) const {
  const fs::path names = tree_ / "in" / "names.h";
  std::string text = content_of_file(names), line;
  if (text.empty()) text = "#pragma once\n#include <GL/glut.h>\n";
  bool added = false;
  const crosscheck::Pattern missing(
      ".*error: [^']*'((?:gl|glu|glut|glfw)[A-Z]\\w*|(?:GL|GLU|GLUT|GLFW)_[A-Z]\\w*)['( ].*");
  for (std::istringstream lines(captured_output); std::getline(lines, line);) {
    // matches "'glFoo' was not declared in this scope" and "use of undeclared identifier 'GL_FOO'"
    const auto found = line.find("declared") == line.npos ? std::nullopt : missing.match(line);
    if (!found) continue;
    const std::string& word = (*found)[1];
    const bool constant = word[0] == 'G';
    const std::string one =
        constant ? "#define " + word + " " + std::to_string(text.size()) : "CLASSIC_NOTHING(" + word + ")";
    if (text.find(constant ? "#define " + word + " " : one) != text.npos) continue;
    text += one + "\n", added = true;
  }
  if (added) crosscheck::write_file(names, text), fs::permissions(names, fs::perms(0644));
  return added;
}

}  // namespace coursework::classic
