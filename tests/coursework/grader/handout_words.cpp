// Plain text with the assignment's names and numbers filled in.
#include "tests/coursework/grader/handout_words.h"

#include <fmt/format.h>

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

}  // namespace coursework
