// crosscheck-grade: dispatches the subcommands.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "mysim/base/command_line.h"
#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "tests/coursework/grader/commands.h"

using namespace coursework;

namespace {

int run(int argc, char** argv) {
  CLI::App app{"crosscheck-grade grades coursework: one process per test, without access to results and network."};
  app.require_subcommand(1);
  int status = 0;

  GradeCommand command;
  std::uint64_t seed = 0;
  auto* grade = app.add_subcommand("grade", "grades a submission (a folder or an archive), or with --all a class");
  grade
      ->add_option("ASSIGNMENT", command.assignment,
                   "name of the assignment (`crosscheck list assignments` shows them)")
      ->required();
  grade
      ->add_option("SUBMISSION", command.submission,
                   "a folder, or an archive (zip, 7z, rar, tar); with --all a folder of these")
      ->required();
  auto* all = grade->add_flag("--all", command.all,
                              "grades every entry of the folder; continues where an earlier run was stopped");
  auto* seeded =
      grade->add_option("--seed", seed, "seed of the hidden tests (default: from the secret, else a new one)");
  grade->add_option("--secret", command.secret_file, "FILE: the seed of the hidden tests is made from its first line")
      ->excludes(seeded);
  auto* roster = grade->add_option("--roster", command.roster, "FILE.csv: the export that --gradebook fills in");
  grade
      ->add_option("--gradebook", command.gradebook,
                   "moodle, canvas or csv: writes the points into a copy of --roster, gradebook.csv")
      ->check(CLI::IsMember({"moodle", "canvas", "csv"}))
      ->needs(all, roster);
  roster->needs("--gradebook");
  grade->add_option("--column", command.column, "NAME of the roster's column for points (default: the assignment's)")
      ->needs(roster);
  grade->add_option("--rubric", command.rubric, "FILE.toml: points of tests, and of single students with a reason");
  grade
      ->add_option("--only", command.only,
                   "GLOB: grades only tests of this number or part again, and lists changed points (repeatable)")
      ->allow_extra_args(false)
      ->needs(all);
  grade->add_option("--report", command.report, "FILE.html: writes a page with plots for the student");
  grade->add_option("--engines", command.engines, "DIR: writes the parts there as programs of the engine protocol")
      ->group("");
  grade->add_option("--charts", command.charts, "the page's link to charts of these")->group("");
  grade->add_option("--out", command.out, "FILE; with --all the folder of results (out/grade/ASSIGNMENT)");
  grade->add_option("--format", command.format, "text, gradescope, autolab or junit");
  grade->add_option("--lang", command.language, "en or zh")->check(CLI::IsMember({"en", "zh"}));
  grade->add_option("--lane", command.sandbox,
                    "sandbox: bwrap, uid or bare (default: the first of bwrap and uid that works here)");
  grade->add_flag("--no-sandbox", command.no_sandbox, "runs submissions as yourself, with limits only");
  grade->callback([&] {
    if (seeded->count()) command.seed = seed;
    status = grade_command(command);
  });

  AssignmentCommand given;
  auto* assignment =
      app.add_subcommand("assignment", "writes an assignment's hand-out, or its package for a grading service");
  assignment->add_option("NAME", given.assignment, "name of the assignment (`crosscheck list assignments` shows them)")
      ->required();
  auto* out = assignment->add_option("--out", given.out,
                                     "folder of the hand-out: new, empty or an earlier hand-out; with --pack FILE.zip");
  assignment
      ->add_option("--language", given.language, "of the hand-out: cpp (default) or python (a1-steppers, a2-pendulum)")
      ->check(CLI::IsMember({"cpp", "python"}));
  assignment->add_option("--pack", given.pack, "writes a package for this grading service: gradescope")
      ->check(CLI::IsMember({"gradescope"}))
      ->needs(out);
  assignment->add_option("--secret", given.secret_file,
                         "FILE: the hidden tests are made from its first line (default: a new secret)");
  assignment->add_option("--check", given.check, "FILE.zip: rehearses a package and reports whether it is ready")
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

  app.add_subcommand("manual", "the table of the commands above, for the manual")->group("")->callback([&] {
    fmt::print("{}", crosscheck::command_table(app));
  });

  bool json = false;
  auto* list = app.add_subcommand("list", "lists the assignments");
  list->add_flag("--json", json, "prints JSON");
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
