// crosscheck-grade: the subcommands, and nothing else.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "mysim/base/command_line.h"
#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "tests/coursework/grader/commands.h"

using namespace coursework;

namespace {

int run(int argc, char** argv) {
  CLI::App app{"crosscheck-grade grades coursework: one process per test, away from tests, results and network."};
  app.require_subcommand(1);
  int status = 0;

  GradeCommand command;
  std::uint64_t seed = 0;
  auto* grade = app.add_subcommand("grade", "grades a submission (a folder, zip or tar), or with --all a class");
  grade->add_option("ASSIGNMENT", command.assignment, "crosscheck list assignments names them")->required();
  grade->add_option("SUBMISSION", command.submission, "a folder, a zip or a tar.gz; with --all a folder of these")
      ->required();
  grade->add_flag("--all", command.all, "every entry of the folder is a submission; goes on where it was stopped");
  auto* seeded = grade->add_option("--seed", seed, "of the hidden tests (default: from the secret, else a fresh one)");
  grade->add_option("--secret", command.secret_file, "FILE that the hidden tests' seed is made from")->excludes(seeded);
  grade->add_option("--report", command.report, "FILE.html: a page with plots");
  grade->add_option("--engines", command.engines, "DIR: leaves the parts there as programs of the engine protocol")
      ->group("");
  grade->add_option("--charts", command.charts, "the page's link to charts of these")->group("");
  grade->add_option("--out", command.out, "FILE; with --all the folder of results (out/grade/ASSIGNMENT)");
  grade->add_option("--format", command.format, "text, gradescope, autolab or junit");
  grade->add_option("--lang", command.language, "en or zh")->check(CLI::IsMember({"en", "zh"}));
  grade->add_option("--lane", command.sandbox, "bwrap, uid or bare (default: the first that keeps submissions in)");
  grade->add_flag("--no-sandbox", command.no_sandbox, "run it as yourself, with limits only");
  grade->callback([&] {
    if (seeded->count()) command.seed = seed;
    status = grade_command(command);
  });

  AssignmentCommand given;
  auto* assignment = app.add_subcommand("assignment", "what an assignment consists of, for students and for harnesses");
  assignment->add_option("NAME", given.assignment, "crosscheck list assignments names them")->required();
  auto* out = assignment->add_option("--out", given.out,
                                     "the hand-out's folder, empty, new or an earlier one of it; with --pack FILE.zip");
  assignment->add_option("--pack", given.pack, "the package of a grading service instead")
      ->check(CLI::IsMember({"gradescope"}))
      ->needs(out);
  assignment->add_option("--secret", given.secret_file,
                         "FILE that hidden tests are made from (default: a fresh secret)");
  assignment->add_option("--check", given.check, "FILE.zip: rehearses a package and says whether it is ready")
      ->excludes(out);
  assignment->callback([&] { status = assignment_command(given); });

  EngineCommand engine;
  auto* runs = app.add_subcommand("engine", "a part as a program of the engine protocol")->group("");
  runs->add_option("PROGRAM", engine.program)->required();
  runs->add_option("PART", engine.part)->required();
  runs->add_option("SCENE", engine.scene)->required();
  runs->add_option("DIR", engine.folder)->required();
  runs->add_option("--lane", engine.sandbox);
  runs->callback([&] { status = engine_command(engine); });

  bool json = false;
  auto* list = app.add_subcommand("list", "the assignments");
  list->add_flag("--json", json, "for programs");
  list->callback([&] { status = list_command(json); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    throw crosscheck::InputError(crosscheck::usage_error("crosscheck", app, error));
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  return crosscheck::run_supervised(
      [&] { return crosscheck::run_reporting_errors("crosscheck-grade", [&] { return run(argc, argv); }); });
}
