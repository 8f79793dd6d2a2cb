// Writes the hand-out, with its README and CMakeLists.
#include "tests/coursework/grader/handout.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>

#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"

namespace coursework {

std::string cmake_lists(const Assignment& assignment) {
  std::string parts;
  for (const Part& part : assignment.parts) parts += fmt::format("  {}.cpp\n", part.name);
  return fmt::format(
      R"(# Builds `check`: your files, and ours in check/. Needs CMake 3.10 and any C++17 compiler, nothing else.
cmake_minimum_required(VERSION 3.10)
project({0} CXX)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

file(GLOB check_sources ${{CMAKE_CURRENT_SOURCE_DIR}}/check/*.cpp)
add_executable(check
{1}  ${{check_sources}})
set_target_properties(check PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
target_include_directories(check PRIVATE ${{CMAKE_CURRENT_SOURCE_DIR}} ${{CMAKE_CURRENT_SOURCE_DIR}}/check)
target_compile_definitions(check PRIVATE "HANDOUT_FOLDER=\"${{CMAKE_CURRENT_SOURCE_DIR}}\"")
if(MSVC)
  target_compile_options(check PRIVATE /utf-8 /W3)
else()
  target_compile_options(check PRIVATE -Wall -Wextra)
endif()
)",
      assignment.name, parts);
}

std::string readme(const Assignment& assignment, const PublicTests& tests) {
  std::string parts;
  for (const Part& part : assignment.parts) parts += fmt::format("- `{}.cpp`\n", part.name);
  int points = 0, here = 0;  // as `check` counts: some tests are the grader's alone
  for (const PublicTest& test : tests.tests)
    if (!test.cases.empty()) points += test.points, ++here;
  return fmt::format(R"(# {0}

Read `handout.md` first. Then fill in these files, in this order, and hand them in:

{1}
The headers and everything in `check/` are ours: the grader uses its own copies, so changes there do not count.

## Build and check

With CMake 3.10 or newer and any C++17 compiler:

    cmake -S . -B build
    cmake --build build
    build/check

(With an older CMake: make the folder `build`, go there, `cmake ..`, `cmake --build .`. Visual Studio and Xcode put the
program into `build/Debug`.) Without CMake, in this folder:

    g++ -std=c++17 -g -I. -Icheck *.cpp check/*.cpp -o check-it
    ./check-it

`check` runs the {2} public tests, {3} points in all, and says of each what was expected, what came, and where to read.
`build/check 2.1` runs one test, `build/check {4}` one part. It writes `mine.html`: your curve on the right one. If the
program ends in the middle, the last line names the test in which it did.

{5} more tests run when you have handed in. They ask for the same properties with other numbers, so code that does what
the handout says passes them too. All parts must compile for `check` to be built; the grader builds each part by itself, so
there one part that does not compile costs its own points only.

Tried with g++ and clang++ on Linux. Windows and macOS: not tested.
)",
                     assignment.title, parts, here, points, assignment.parts.front().name, tests.hidden);
}

std::string readme_of_whole(const Assignment& assignment, const PublicTests& tests) {
  int points = 0;
  for (const PublicTest& test : tests.tests) points += test.points;
  return fmt::format(R"(# {0}

Read `handout.md` first. Then fill in the sources and hand in the whole folder, or your own program if it has the same
classes: for the grader it does not matter what files are called and where they lie, and `main` is not run.

## Build and check

With CMake 3.13 or newer and a compiler that knows C++20 (g++ 10, clang 10, Visual Studio 2019 16.10, or newer: `check`
tries in which of many ways your classes can be called; your own files are compiled as C++14, as the grader does):

    cmake -S . -B build
    cmake --build build
    build/check

(Visual Studio and Xcode put the program into `build/Debug`.) Without CMake, in this folder:

    g++ -std=c++20 -g -I. -Ivecmath -Icheck -Icheck/stubs $(ls *.cpp | grep -vx main.cpp) check/*.cpp -o check-it
    ./check-it

`check` asks your classes the grader's {1} public questions, {2} points in all, and says of each what was expected, what
came, and where to read. Masses, stiffnesses and sizes are yours to choose, so it looks at shares, signs and shapes.
`build/check 2.1` runs one test, `build/check {3}` one part. It writes `mine.html`: the curves of your steppers on the
right ones, and, moved by your trapezoidal rule, your simple system and your pendulum, let go straight below its anchor,
on the exact motion with your own masses and lengths. Those two are for the eye: no points depend on them. If the program
ends in the middle, the last line names the test in which it did.

`check` expects the classes in files with the starter's names in this folder, beside as many more as you like, and leaves
`main.cpp` out. All of them must compile for it to be built; in the grader a class that does not compile costs its own
part only. Everything in `check/` is ours: changes there do not count. Nothing is drawn, so it needs no OpenGL; a
function that it does not know gets a line in `check/stubs/GL/gl.h`. The grader needs no such line.

{4} more tests run when you have handed in. They ask the same questions at other states, so code that does what the
handout says passes them too.

## The window

`vecmath/` holds vectors and matrices under their usual names. With OpenGL and GLUT (Debian: freeglut3-dev) the starter
is built, in this folder, by

    g++ -std=c++17 -g -Ivecmath *.cpp -lglut -lGLU -lGL -o particles

Tried with g++ and clang++ on Linux. Windows and macOS: not tested.
)",
                     assignment.title, tests.tests.size(), points, assignment.parts.front().name, tests.hidden);
}

namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::string& content) {
  std::ofstream out(file, std::ios::binary);
  out << content;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

/// The texts without what they say of the known mistakes, and without comments.
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

/// Calls of the student's code, and for a whole program what finds features in its answers.
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

/// A source of the grader's as it stands in `check`, where its headers are in no folders of their own.
std::string source_in_check(const fs::path& file) {
  std::string text = content_of_file(file);
  for (const std::string folder : {"tests/coursework/classic/", "tests/coursework/check/", "../../check/"})
    for (std::size_t at; (at = text.find("#include \"" + folder)) != std::string::npos;)
      text.erase(at + std::string_view("#include \"").size(), folder.size());
  return text;
}

std::set<fs::path> sorted(const fs::path& folder) { return {fs::directory_iterator(folder), fs::directory_iterator()}; }

/// What is compiled around a whole program: vectors under their usual names, drawing that does nothing, and the probes.
void write_surroundings(const fs::path& from, const fs::path& folder) {
  fs::create_directories(folder / "vecmath");
  for (const fs::path& file : sorted(from / "stubs"))
    if (is_of_vecmath(file.filename().string()))
      write_text(folder / "vecmath" / file.filename(), content_of_file(file));
  for (const char* drawing : {"GL", "GLUT", "OpenGL"}) {
    fs::create_directories(folder / "check/stubs" / drawing);
    for (const fs::path& file : sorted(from / "stubs" / drawing))
      write_text(folder / "check/stubs" / drawing / file.filename(), content_of_file(file));
  }
  fs::create_directories(folder / "check/probe");
  for (const fs::path& file : sorted(from / "probe"))
    write_text(folder / "check/probe" / file.filename(), source_in_check(file));
}

}  // namespace

PublicTests public_tests(const Assignment& assignment) {
  PublicTests all{std::string(assignment.name), std::string(assignment.title), 0, {}};
  for (const Test& test : assignment.tests) {
    all.hidden += test.hidden > 0;
    if (test.points == 0) continue;
    all.tests.push_back({std::string(test.id), std::string(test.part), std::string(test.read), test.points, {}, {}});
    // of files per part `check` has the calls alone; of a whole program also what finds features in its answers
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
  const PublicTests tests = public_tests(assignment);
  fs::create_directories(check);
  write_text(folder / "handout.md", content_of_file(from / "handout.md"));
  for (const fs::path& file : sorted(from / "starter")) write_text(folder / file.filename(), content_of_file(file));
  for (const fs::path& file : sorted(shared))
    if (file.filename() != "child_main.cpp" && !(whole && file.filename() == "as_given.cpp"))
      write_text(check / file.filename(), content_of_file(file));
  for (const fs::path& file : sorted(from)) {
    const std::string name = file.filename().string();
    if (name.starts_with("texts.") && ends(file, {".txt"})) write_text(check / name, shown_texts(file));
    if (is_of_check(name) && ends(file, {".cpp", ".h"})) write_text(check / name, source_in_check(file));
  }
  if (whole) write_surroundings(from, folder);
  std::ofstream cases(check / "public_cases.txt", std::ios::binary);
  write_cases(cases, tests);
  if (!cases.flush()) throw std::runtime_error((check / "public_cases.txt").string() + ": cannot be written");
  if (!whole) write_text(folder / "CMakeLists.txt", cmake_lists(assignment));
  write_text(folder / "README.md", whole ? readme_of_whole(assignment, tests) : readme(assignment, tests));
}

}  // namespace coursework
