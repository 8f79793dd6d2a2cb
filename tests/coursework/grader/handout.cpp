#include "tests/coursework/grader/handout.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/python.h"

namespace coursework {

namespace fs = std::filesystem;
using crosscheck::write_file;
namespace {

/// Writes the public cases, and a README.md that lists the parts' files with this ending.
void write_tests(const Assignment& assignment, const char* readme, const char* ending, const fs::path& folder) {
  const PublicTests tests = public_tests(assignment);
  std::ostringstream cases;
  write_cases(cases, tests);
  write_file(folder / "check/public_cases.txt", cases.str());
  int points = 0, here = 0;  // some tests exist only in the grader
  for (const PublicTest& test : tests.tests)
    if (assignment.takes_whole_program() || !test.cases.empty()) points += test.points, ++here;
  std::string listed;
  for (const Part& part : assignment.parts) listed += fmt::format("- `{}{}`\n", part.name, ending);
  write_file(folder / "README.md",
             filled(readme, {std::string(assignment.title), listed, std::to_string(here), std::to_string(points),
                             std::string(assignment.parts.front().name), std::to_string(tests.hidden)}));
}

/// The texts without descriptions of known mistakes, and without comments.
std::string shown_texts(const fs::path& file) {
  std::string out;
  const Texts texts = Texts::read(file.string());
  for (const auto& [key, text] : texts.all())
    if (!key.starts_with("mistake.")) out += fmt::format("[{}]\n{}\n\n", key, text);
  return out;
}

bool ends(const fs::path& file, std::initializer_list<std::string_view> endings) {
  const std::string name = file.filename().string();
  return std::any_of(endings.begin(), endings.end(), [&](std::string_view end) { return name.ends_with(end); });
}

/// True for files that call the student's code, and for code that extracts features from a whole program's answers.
bool is_of_check(const std::string& name) {
  for (const char* begin : {"calls", "looks", "motion", "oracles", "replay", "shapes", "springs"})
    if (name.starts_with(begin)) return true;
  return false;
}

bool is_of_vecmath(const std::string& name) {
  for (const char* begin : {"vecmath", "Vector", "Matrix", "Quat"})
    if (name.starts_with(begin)) return true;
  return false;
}

/// A grader source as it appears in `check`, where all headers are in the same folder.
std::string source_in_check(const fs::path& file) {
  std::string text = content_of_file(file);
  for (const std::string folder : {"tests/coursework/classic/", "tests/coursework/check/", "../../check/"})
    for (std::size_t at; (at = text.find("#include \"" + folder)) != std::string::npos;)
      text.erase(at + std::string_view("#include \"").size(), folder.size());
  return text;
}

std::set<fs::path> sorted(const fs::path& folder) { return {fs::directory_iterator(folder), fs::directory_iterator()}; }

/// Writes the files around a whole program: vectors under their usual names, drawing functions that do nothing, and the
/// probes.
void write_surroundings(const fs::path& from, const fs::path& folder) {
  for (const fs::path& file : sorted(from / "stubs"))
    if (is_of_vecmath(file.filename().string()))
      write_file(folder / "vecmath" / file.filename(), content_of_file(file));
  for (const char* drawing : {"GL", "GLUT", "OpenGL"})
    for (const fs::path& file : sorted(from / "stubs" / drawing))
      write_file(folder / "check/stubs" / drawing / file.filename(), content_of_file(file));
  for (const fs::path& file : sorted(from / "probe"))
    write_file(folder / "check/probe" / file.filename(), source_in_check(file));
}

}  // namespace

PublicTests public_tests(const Assignment& assignment) {
  PublicTests all{std::string(assignment.name), std::string(assignment.title), 0, {}};
  for (const Test& test : assignment.tests) {
    all.hidden += test.hidden > 0;
    if (test.points == 0) continue;
    all.tests.push_back({std::string(test.id), std::string(test.part), std::string(test.read), test.points, {}, {}});
    // With a file per part, `check` contains only the calls. For a whole program it also contains the code that
    // extracts features from answers.
    if (!test.reduce || assignment.takes_whole_program()) {
      all.tests.back().cases = public_cases(assignment, test);
      all.tests.back().small = small_cases(assignment, test);
    }
  }
  return all;
}

void write_handout(const Assignment& assignment, const fs::path& folder) {
  const fs::path from = assignment.folder(), shared = from.parent_path() / "check", check = folder / "check";
  const bool whole = assignment.takes_whole_program();
  for (const fs::path& file : sorted(from / "starter"))
    if (!ends(file, {".py"})) write_file(folder / file.filename(), content_of_file(file));
  for (const fs::path& file : sorted(shared))
    if (file.filename() != "child_main.cpp" && !(whole && file.filename() == "as_given.cpp"))
      write_file(check / file.filename(), content_of_file(file));
  for (const fs::path& file : sorted(from)) {
    const std::string name = file.filename().string();
    if (name.starts_with("handout.") && ends(file, {".md"}))
      write_file(folder / name, content_of_file(file));  // also the translated handout.zh.md, if there is one
    if (name.starts_with("texts.") && ends(file, {".txt"})) write_file(check / name, shown_texts(file));
    if (is_of_check(name) && ends(file, {".cpp", ".h"})) write_file(check / name, source_in_check(file));
  }
  if (whole) {
    write_surroundings(from, folder);
  } else {
    std::string built;
    for (const Part& part : assignment.parts) built += fmt::format("  {}.cpp\n", part.name);
    write_file(folder / "CMakeLists.txt", filled("handout/CMakeLists.txt", {std::string(assignment.name), built}));
  }
  write_tests(assignment, whole ? "handout/README-whole.md" : "handout/README.md", ".cpp", folder);
}

void write_python_handout(const Assignment& assignment, const fs::path& folder) {
  if (!has_python(assignment))
    throw crosscheck::InputError(fmt::format(
        "--language python: {} is in C++ only; a1-steppers and a2-pendulum are also in Python", assignment.name));
  const fs::path from = assignment.folder(), shared = from.parent_path() / "check", check = folder / "check";
  std::string lecture = content_of_file(from / "handout.md");
  for (const Part& part : assignment.parts) {
    const std::string file = std::string(part.name) + ".py";
    write_file(folder / file, content_of_file(from / "starter" / file));
  }
  for (const Mistake& one : read_mistakes(from / "handout.python.txt")) lecture = with_mistake(lecture, one);
  write_file(folder / "handout.md", lecture);
  write_file(folder / "check.py", content_of_file(from.parent_path() / "python/check.py"));
  write_file(check / "calls.py", content_of_file(from / "calls.py"));
  write_file(check / "drawing_stubs.py", content_of_file(from.parent_path() / "python/drawing_stubs.py"));
  for (const char* language : {"en", "zh"}) {
    const std::string common = fmt::format("common.{}.txt", language), own = fmt::format("texts.{}.txt", language);
    write_file(check / common, content_of_file(shared / common));
    write_file(check / own, shown_texts(from / own));
  }
  write_tests(assignment, "handout/README-python.md", ".py", folder);
}

}  // namespace coursework
