// assignment: the hand-out for the students, the package for a grading service, and its rehearsal.
#include <fmt/format.h>

#include <random>

#include "mysim/errors.h"
#include "mysim/output_folder.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/commands.h"
#include "tests/coursework/grader/handout.h"
#include "tests/coursework/grader/pack.h"

namespace coursework {
namespace {

std::string secret_of(const AssignmentCommand& command) {
  if (!command.secret_file.empty()) return secret_in(command.secret_file);
  std::random_device device;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", device(), device(), device(), device());
}

}  // namespace

int assignment_command(const AssignmentCommand& command) {
  const Assignment& assignment = find_assignment(command.assignment);
  if (!command.check.empty()) return rehearse(assignment, command.check) ? 0 : 1;
  if (command.out.empty()) throw crosscheck::InputError("assignment: expected --out FOLDER, or --check FILE.zip");
  if (command.pack.empty()) {
    crosscheck::OutputFolder folder(command.out, "assignment " + std::string(assignment.name));
    write_handout(assignment, folder.path());
    folder.finish();
  } else {
    write_package(assignment, secret_of(command), command.out);
  }
  fmt::print("{}: {}\n", command.out, assignment.title);
  return 0;
}

}  // namespace coursework
