// The commands of crosscheck-grade. Each returns the exit status; throws InputError or std::invalid_argument for
// invalid usage.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace coursework {

struct GradeCommand {
  std::string assignment, submission;
  bool all = false, no_sandbox = false;
  std::optional<std::uint64_t> seed;
  std::string secret_file, report, engines, charts, out, format = "text", language = "en", sandbox, gradebook, roster,
                                                         column, rubric;
  std::vector<std::string> only;
};
int grade_command(const GradeCommand& command);

/// The secret: the first line of the file that --secret names. Throws InputError if the line is empty.
std::string secret_in(const std::string& file);

struct AssignmentCommand {
  std::string assignment, out, pack, check, secret_file, language = "cpp";
};
int assignment_command(const AssignmentCommand& command);

struct EngineCommand {
  std::string program, part, scene, folder, sandbox;
};
int engine_command(const EngineCommand& command);

int list_command(bool json);

}  // namespace coursework
