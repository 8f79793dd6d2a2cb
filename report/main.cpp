// crosscheck: the subcommands, and nothing else.

#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "report/commands/command_line.h"
#include "report/commands/commands.h"

using namespace crosscheck;

namespace {

int run(int argc, char** argv) {
  const CLI::Validator above_zero = number(false), not_below_zero = number(true);
  CLI::App app{
      "Crosscheck sets mysim, an in-house mass-spring and cloth engine, beside matching Bullet soft-body scenes."};
  app.require_subcommand(1);
  app.set_version_flag("--version", version(), "the version of this program");
  const std::string line = command_line(argc, argv);
  int status = 0;
  auto quick_or_full = [](CLI::App* command, bool& full) {
    auto* quick = command->add_flag("--quick")->description("the short form (the default)");
    command->add_flag("--full", full, "more points and finer pictures")->excludes(quick);
  };

  app.add_subcommand("doctor", "what is installed, what is missing, what each is for")->callback([&] {
    status = doctor_command();
  });

  std::string what;
  bool json = false;
  auto* list = app.add_subcommand("list", "what there is: scenes, methods, experiments, assignments");
  list->add_option("WHAT", what, "scenes, methods, experiments or assignments")->required();
  list->add_flag("--json", json, "for programs");
  list->callback([&] { status = list_command(what, json); });

  add_single_run(app, line, status);

  CompareOptions compare_options;
  auto* compare = app.add_subcommand("compare", "parity certificate, then methods side by side");
  compare->add_option("SCENE", compare_options.scene, "a shipped scene or a TOML file")->required();
  compare->add_option("--methods", compare_options.methods, "A,B,...");
  compare->add_option("--step", compare_options.step, "s")->check(above_zero);
  compare->add_option("--trajectory", compare_options.trajectory, "FILE.npy of an engine that cannot be driven");
  compare->add_option("--out", compare_options.out, "folder (out/compare)");
  compare->callback([&] { compare_options.command_line = line, status = compare_command(compare_options); });

  ExperimentOptions experiment_options;
  auto* experiment = app.add_subcommand("experiment", "runs experiments and writes their tables");
  experiment
      ->add_option("NAME", experiment_options.names,
                   "experiments, then scenes (default: those that stand for the others; all with --full)")
      ->required();
  experiment->add_option("--methods", experiment_options.methods, "A,B,...");
  experiment->add_option("--out", experiment_options.out, "folder (out/experiment)");
  experiment->add_option("--shard", experiment_options.shard, "I/N: only this part of the points; join with merge");
  experiment->add_flag("--resume", experiment_options.resume, "keep the points that an earlier run finished");
  experiment->add_option("--jobs", experiment_options.jobs, "processes at a time (one per core)")
      ->check(CLI::Range(1, 256));
  quick_or_full(experiment, experiment_options.full);
  experiment->callback(
      [&] { experiment_options.command_line = line, status = experiment_command(experiment_options); });

  MergeOptions merge_options;
  auto* merge = app.add_subcommand("merge", "joins the shards of an experiment into its tables");
  merge->add_option("DIR", merge_options.folders, "output folders of `experiment --shard`")->required();
  merge->add_option("--out", merge_options.out, "folder")->required();
  merge->callback([&] { status = merge_command(merge_options); });

  ReportOptions report_options;
  auto* report = app.add_subcommand("report", "the main job: a page with findings, figures, pictures and data");
  report->add_option("SCENE", report_options.scenes, "default: those that stand for the others; all with --full");
  report->add_option("--methods", report_options.methods, "A,B,...");
  report->add_option("--out", report_options.out, "folder (out/report)");
  quick_or_full(report, report_options.full);
  report->add_option("--against", report_options.against, "an earlier report: the page says what changed since");
  std::filesystem::path verified;
  report->add_option("--verify", verified, "DIR: recomputes every finding of the report in it from its data, no more");
  report->callback([&] {
    report_options.command_line = line;
    status = verified.empty() ? report_command(report_options) : verify_command(verified);
  });

  FiguresOptions figures_options;
  auto* figures =
      app.add_subcommand("figures", "charts and pictures fit to print, with captions, for a paper or a lecture");
  figures->add_option("NAME", figures_options.names,
                      "experiments whose charts are asked for, or SCENE-picture; default: all");
  figures->add_option("--scene", figures_options.scenes, "a shipped scene or a TOML file; again for more");
  figures->add_option("--set", figures_options.set, "paper (8.5 cm, 8 pt) or lecture (24 cm, 20 pt)");
  figures->add_option("--width", figures_options.width, "8.5cm, 85mm, 3.3in");
  figures->add_option("--out", figures_options.out, "folder (out/figures)");
  quick_or_full(figures, figures_options.full);
  figures->callback([&] { figures_options.command_line = line, status = figures_command(figures_options); });

  RenderOptions render_options;
  auto* render = app.add_subcommand("render", "a picture of a scene, or a clip of its run, methods side by side");
  render->add_option("SCENE", render_options.scene, "a shipped scene or a TOML file")->required();
  render->add_option("--methods", render_options.methods, "A,B,...");
  render->add_option("--mode", render_options.mode, "shaded (default), stretch, springs, difference or strip");
  render->add_option("--at", render_options.at, "s (default: the end)")->check(not_below_zero);
  render->add_option("--quality", render_options.quality, "fast or still (default: still; of clips fast)");
  render->add_option("--size", render_options.size, "WxH, pixels (1280x720)");
  render->add_option("-o", render_options.file, "FILE.png, or FILE.mp4: 30 frames for each second of the scene")
      ->required();
  render->callback([&] { status = render_command(render_options); });

  AdviseOptions advise_options;
  auto* advise = app.add_subcommand("advise", "cheapest model, method and step that meet a tolerance, with the proof");
  advise->add_option("SCENE", advise_options.scene, "a shipped scene or a TOML file; \"fit\" values follow its [wish]")
      ->required();
  advise->add_option("--tolerance", advise_options.tolerance, "m, RMS over the particles; may be left out when fitting")
      ->check(above_zero);
  advise->add_option("--methods", advise_options.methods, "A,B,... (default: all of mysim)");
  advise->add_option("--out", advise_options.out, "folder (out/advise)");
  advise->callback([&] { advise_options.command_line = line, status = advise_command(advise_options); });

  RegressOptions regress_options;
  auto* regress = app.add_subcommand("regress", "what moved since somebody last said that it is right");
  regress->add_option("scenes", regress_options.scenes, "names or files (default: all that come with Crosscheck)");
  regress->add_option("--filter", regress_options.filter, "GLOB on SCENE or SCENE/METHOD");
  regress->add_option("--method", regress_options.methods, "A,B,... (default: all of mysim and Bullet)");
  auto* against = regress->add_option("--against", regress_options.against,
                                      "a method to set --method beside, instead of baselines");
  regress->add_option("--baselines", regress_options.baselines, "folder (default: those that come with Crosscheck)");
  auto* bless = regress->add_flag("--bless", regress_options.bless, "makes today's answers the baseline");
  regress->add_option("--reason", regress_options.reason, "why they are right")->needs(bless);
  regress->add_option("--figures", regress_options.figures, "of so many failed questions (6); 0: no page")
      ->check(CLI::Range(0, 100));
  regress->add_flag("--bisect", regress_options.bisect, "exit 125 where nothing can be said, for git bisect run");
  auto* prove = regress->add_flag("--prove", regress_options.prove, "runs wrong changes to mysim: all must be caught")
                    ->excludes(bless);
  regress->add_option("--mutant", regress_options.mutant, "only this one of them")->needs(prove);
  auto* no_speed = regress->add_flag("--no-speed", regress_options.no_speed, "answers only");
  regress->add_flag("--speed", regress_options.speed, "with --bisect: speeds too")->excludes(no_speed);
  auto* prove_speed = regress->add_flag("--prove-speed", regress_options.prove_speed,
                                        "measures this program's speeds beside its own: none should differ");
  prove_speed->excludes(bless)->excludes(prove)->excludes(no_speed);
  regress->add_option("--repetitions", regress_options.repetitions, "how often (200)")
      ->needs(prove_speed)
      ->check(CLI::Range(1, 100000));
  auto* prove_builds = regress
                           ->add_flag("--prove-builds", regress_options.prove_builds,
                                      "builds with other compilers and options, and runs each: all must pass")
                           ->excludes(bless)
                           ->excludes(prove)
                           ->excludes(against);
  regress->add_option("--build", regress_options.build, "only this one of the builds")->needs(prove_builds);
  regress->add_option("--out", regress_options.out, "folder (out/regress)");
  quick_or_full(regress, regress_options.full);
  regress->callback([&] {
    regress_options.command_line = line;
    status = regress_options.prove          ? prove_command(regress_options)
             : regress_options.prove_speed  ? prove_speed_command(regress_options)
             : regress_options.prove_builds ? prove_builds_command(regress_options)
                                            : regress_command(regress_options);
  });

  BenchOptions bench_options;
  auto* bench = app.add_subcommand("bench", "speed, as ratios against the peers, in one run");
  bench->add_option("--out", bench_options.out, "folder (out/bench)");
  quick_or_full(bench, bench_options.full);
  bench->callback([&] { bench_options.command_line = line, status = bench_command(bench_options); });

  EngineOptions engine_options;
  auto* engine = app.add_subcommand("engine", "builds the Bullet adapter against another Bullet tree, for exec:");
  engine->add_option("NAME", engine_options.what, "bullet")->required();
  engine->add_option("--prefix", engine_options.prefix, "an installation or a source tree of Bullet")->required();
  engine->add_option("-o", engine_options.program, "PROG")->required();
  engine->callback([&] { status = engine_command(engine_options); });

  // read by the grader, which knows their options
  app.add_subcommand("grade", "grades coursework: a submission, or a class with --all");
  app.add_subcommand("assignment", "writes the hand-out of an assignment, or the package of a grading service");
  if (argc > 1 && (argv[1] == std::string("grade") || argv[1] == std::string("assignment")))
    return grader_command({argv + 1, argv + argc});

  return parse(app, argc, argv, status);
}

}  // namespace

int main(int argc, char** argv) {
  return run_supervised([&] { return run_reporting_errors("crosscheck", [&] { return run(argc, argv); }); });
}
