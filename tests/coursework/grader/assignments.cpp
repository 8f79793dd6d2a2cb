// The table of assignments. A new one needs a folder, the declaration of its function and a row.

#include <cstdlib>
#include <stdexcept>

#include "mysim/base/installation.h"
#include "mysim/base/text.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {

const Assignment& a1_steppers();
const Assignment& a2_pendulum();
const Assignment& a3_cloth();
const Assignment& a4_collision();
const Assignment& a5_stiff();
const Assignment& a6_solvers();
const Assignment& m1_misconceptions();
const Assignment& classic_particles();

std::filesystem::path folder_of_coursework() {
  const char* named = std::getenv("CROSSCHECK_COURSEWORK");
  return named && *named ? named : crosscheck::data_folder() / "tests" / "coursework";
}

std::filesystem::path Assignment::folder() const { return folder_of_coursework() / name; }

std::span<const Assignment> assignments() {
  static const Assignment all[] = {
      a1_steppers(),        // first-order systems
      a2_pendulum(),        // forces on few particles
      a3_cloth(),           // a grid of springs
      a4_collision(),       // collision with a sphere
      a5_stiff(),           // implicit Euler
      a6_solvers(),         // implicit Euler, solved iteratively
      m1_misconceptions(),  // tests of five common beliefs
      classic_particles(),  // all topics, in the interface of the classic course
  };
  return all;
}

const Assignment& find_assignment(const std::string& name) {
  std::vector<std::string> known;
  for (const Assignment& assignment : assignments()) {
    if (assignment.name == name) return assignment;
    known.emplace_back(assignment.name);
  }
  throw std::invalid_argument(crosscheck::unknown_name("assignment", name, known, "crosscheck list assignments"));
}

}  // namespace coursework
