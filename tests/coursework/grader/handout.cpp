#include "tests/coursework/grader/handout.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/grade.h"

namespace coursework {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::stringstream content;
  std::ifstream in(file, std::ios::binary);
  content << in.rdbuf();
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return content.str();
}

void write(const fs::path& file, const std::string& content) {
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

bool is_of_vecmath(const std::string& name) {
  for (const char* begin : {"vecmath", "Vector", "Matrix", "Quat"})
    if (name.starts_with(begin)) return true;
  return false;
}

std::set<fs::path> sorted(const fs::path& folder) { return {fs::directory_iterator(folder), fs::directory_iterator()}; }

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
  int points = 0, here = 0;
  for (const PublicTest& test : tests.tests) points += test.points, here += !test.cases.empty();
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

std::string readme_of_whole(const Assignment& assignment) {
  int seen = 0, all = 0;
  for (const Test& test : assignment.tests) seen += test.points, all += test.points + test.hidden;
  return fmt::format(R"(# {0}

Read `handout.md` first. Then fill in the sources and hand in the whole folder, or your own program if it has the same
classes: what files are called and where they lie does not matter, and `main` is not run.

There is no `check` program here: masses, stiffnesses and sizes are yours to choose, so there are no numbers to compare
with. The grader asks your classes and looks at shares, signs and shapes: {1} of {2} points with questions whose titles
you see at once, the others with the same questions at other states.

`vecmath/` holds vectors and matrices under their usual names. With OpenGL and GLUT (Debian: freeglut3-dev) the starter
is built, in this folder, by

    g++ -std=c++17 -g -Ivecmath *.cpp -lglut -lGLU -lGL -o particles
)",
                     assignment.title, seen, all);
}

}  // namespace

PublicTests public_tests(const Assignment& assignment) {
  PublicTests all{std::string(assignment.name), std::string(assignment.title), 0, {}};
  for (const Test& test : assignment.tests) {
    all.hidden += test.hidden > 0;
    if (test.points == 0) continue;
    Random random(public_seed(assignment, test));
    all.tests.push_back({std::string(test.id), std::string(test.part), std::string(test.read), test.points, {}});
    if (!test.reduce) all.tests.back().cases = test.cases(random);
  }
  return all;
}

void write_handout(const Assignment& assignment, const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_empty(folder))
    throw std::runtime_error(folder.string() + ": there is something in it already");
  const fs::path from = assignment.folder(), shared = from.parent_path() / "check";
  fs::create_directories(folder);
  write(folder / "handout.md", content_of(from / "handout.md"));
  for (const fs::path& file : sorted(from / "starter")) write(folder / file.filename(), content_of(file));
  if (assignment.takes_whole_program()) {
    fs::create_directories(folder / "vecmath");
    for (const fs::path& file : sorted(from / "stubs"))
      if (is_of_vecmath(file.filename().string())) write(folder / "vecmath" / file.filename(), content_of(file));
    return write(folder / "README.md", readme_of_whole(assignment));
  }
  fs::create_directories(folder / "check");
  const PublicTests tests = public_tests(assignment);
  for (const fs::path& file : sorted(from))
    if (file.filename().string().starts_with("calls") && ends(file, {".cpp", ".h"}))
      write(folder / "check" / file.filename(), content_of(file));
  for (const fs::path& file : sorted(shared))
    if (file.filename() != "child_main.cpp") write(folder / "check" / file.filename(), content_of(file));
  for (const fs::path& file : sorted(from))
    if (file.filename().string().starts_with("texts.") && ends(file, {".txt"}))
      write(folder / "check" / file.filename(), shown_texts(file));
  std::ofstream cases(folder / "check" / "public_cases.txt", std::ios::binary);
  write_cases(cases, tests);
  if (!cases.flush()) throw std::runtime_error((folder / "check/public_cases.txt").string() + ": cannot be written");
  write(folder / "CMakeLists.txt", cmake_lists(assignment));
  write(folder / "README.md", readme(assignment, tests));
}

}  // namespace coursework
