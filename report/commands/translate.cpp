// Converts a scene's parameters to another engine's, or back. Exit 1 if the engine has no such parameters or refuses to
// run the scene.

#include "experiments/translate/translated_run.h"
#include "report/commands/command_line.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

struct TranslateOptions {
  std::string scene, to, run;
  std::vector<std::string> from;  // method and file
  double step = 0;                // s
  int iterations = 0;
  std::filesystem::path out;
  bool json = false;
};

std::string range(const std::vector<double>& values, std::string_view unit) {
  const auto [least, most] = std::ranges::minmax(values);
  return crosscheck::range(fmt::format("{:.6g}", least), fmt::format("{:.6g}", most)) +
         (unit == "1" ? "" : fmt::format(" {}", unit));
}

void print(const TranslatedNumber& number) {
  const NumberRule& rule = *number.rule;
  fmt::print("  {}: {}\n", name_of(rule.quantity), range(number.scene, unit_of(rule.quantity)));
  fmt::print("    {} = {}\n", rule.name, rule.formula);
  fmt::print("    {} = {}{}\n", rule.name, range(number.engine, rule.unit),
             std::ranges::count(number.engine, number.engine[0]) < std::ssize(number.engine)
                 ? fmt::format(", one for each {}", holder_of(rule.quantity))
             : number.scene.size() > 1 ? ", one for all"
                                       : "");
  fmt::print("    holds {}\n", rule.holds);
  if (!number.here.empty()) fmt::print("    {}\n", number.here);
  fmt::print("    converted back (within {:.2g}): {}\n", number.stated, range(number.back, unit_of(rule.quantity)));
}

void print(const TranslatedRun& run) {
  fmt::print("\nmeasured by {}: ", run.method);
  if (run.outcome.verdict != Verdict::ok) {
    fmt::print("{}{}\n", in_words(run.outcome.verdict), run.outcome.reason.empty() ? "" : ": " + run.outcome.reason);
  } else if (const auto distance = run.error ? run.error : run.difference) {
    fmt::print(
        "{} {}, {:.3g} % of the motion of {}\n  largest RMS over the particles until {:.3g} s, compared with {}{}\n",
        run.error ? "error" : "difference", nice_length(*distance), 100 * *distance / run.motion,
        nice_length(run.motion), run.until, run.beside,
        run.bar ? fmt::format(", error bar {}", nice_length(*run.bar)) : "");
  } else {
    fmt::print("it ran; there is nothing to compare it with\n");
  }
  for (const std::string& law : run.outcome.different_law) fmt::print("  different law: {}\n", law);
}

Json json_of(const TranslatedNumber& number) {
  const NumberRule& rule = *number.rule;
  return {{"quantity", name_of(rule.quantity)},
          {"unit", unit_of(rule.quantity)},
          {"scene", number.scene},
          {"name", rule.name},
          {"engine_unit", rule.unit},
          {"formula", rule.formula},
          {"inverse", rule.inverse},
          {"engine", number.engine},
          {"back", number.back},
          {"holds", rule.holds},
          {"here", number.here},
          {"stated_error", number.stated}};
}

Json json_of(const TranslatedRun& run) {
  const auto or_null = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  return {{"method", run.method},
          {"verdict", name_of(run.outcome.verdict)},
          {"reason", run.outcome.reason},
          {"error", or_null(run.error)},
          {"difference", or_null(run.difference)},
          {"beside", run.beside},
          {"bar", or_null(run.bar)},
          {"motion", run.motion},
          {"until", run.until},
          {"different_law", run.outcome.different_law}};
}

int to_engine(const TranslateOptions& options) {
  const Scene scene = load_scene(options.scene);
  const TranslationTarget target = find_target(options.to, options.iterations);
  Run run = default_run(scene);
  if (options.step > 0) run.step = options.step;
  const std::optional<Method> method = options.run.empty() ? target.runs : find_method(options.run);
  Translation t;
  try {
    t = translate(scene, target, time_grid(run).h);
  } catch (const Unsupported& why) {
    fmt::print(stderr, "crosscheck: {} has no parameters for {}: {}\n", target.name, options.scene, why.what());
    return 1;
  }
  std::optional<TranslatedRun> measured;
  if (method) {
    require_resources_to_keep({find_method(scene.method), *method}, scene, run);
    Progress progress(1);
    progress.begin(fmt::format("running {}, and finding the reference solution of {}", method->name, scene.name));
    measured = run_translated(scene, t, *method);
    progress.done();
  }
  if (!options.out.empty()) write_file(options.out, numbers_toml(scene, t));

  const bool stand_in = target.stand_in && options.run.empty();
  if (options.json) {
    Json json{{"format", 1},
              {"scene", options.scene},
              {"scene_hash", scene.hash},
              {"to", target.name},
              {"engine", target.numbers->title},
              {"source", target.numbers->source},
              {"step", t.h},
              {"step_asked", run.step},
              {"iterations", target.numbers->iterations.empty() ? Json() : Json(target.iterations)},
              {"numbers", Json::array()},
              {"lost", t.lost},
              {"measured", measured ? json_of(*measured) : Json()},
              {"stand_in", stand_in}};
    for (const TranslatedNumber& number : t.numbers) json["numbers"].push_back(json_of(number));
    fmt::print("{}\n", dump(json, 1));
  } else {
    fmt::print("{} in the parameters of {}: {}\n", scene.name, target.name, target.numbers->title);
    fmt::print("  step h = {:.6g} s{}\n", t.h,
               target.numbers->iterations.empty()
                   ? ""
                   : fmt::format(", n = {} ({})", target.iterations, target.numbers->iterations));
    if (std::abs(t.h - run.step) > 1e-9 * run.step)
      fmt::print(
          "  the requested step is {:.6g} s, the step used is {:.6g} s: it must divide the {:.6g} s between samples\n",
          run.step, t.h, run.duration / run.samples);
    for (const TranslatedNumber& number : t.numbers) print(number);
    for (const std::string& lost : t.lost) fmt::print("  lost: {}\n", lost);
    if (!target.numbers->source.empty()) fmt::print("  formulas from {}\n", target.numbers->source);
    if (measured)
      print(*measured);
    else
      fmt::print("\nnot measured here: this build does not run {}; --run exec:PROGRAM measures it with a program\n",
                 target.numbers->title);
    if (stand_in)
      fmt::print("  {} follows the same rule with the same numbers in double precision; {} itself was not run\n",
                 measured->method, target.numbers->title);
    if (!options.out.empty()) fmt::print("\n{}\n", options.out.string());
  }
  return measured && measured->outcome.verdict == Verdict::unsupported ? 1 : 0;
}

int from_engine(const TranslateOptions& options) {
  const Scene scene = load_scene(options.scene);
  const TranslationTarget target = find_target(options.from[0], options.iterations);
  const std::string& file = options.from[1];
  const NumbersFile numbers =
      read_numbers(read_file(file, "an engine's numbers (TOML)"), file, scene, target, options.step);
  const Scene changed = scene_of(scene, *target.numbers, numbers);
  if (!options.out.empty()) write_file(options.out, scene_toml(scene, changed, rounding_of(changed, target, numbers)));
  if (options.json) {
    Json json{{"format", 1},
              {"scene", options.scene},
              {"from", target.name},
              {"step", numbers.h},
              {"iterations", target.numbers->iterations.empty() ? Json() : Json(numbers.iterations)},
              {"numbers", Json::array()}};
    for (const auto& [rule, values] : numbers.numbers)
      json["numbers"].push_back({{"quantity", name_of(rule->quantity)},
                                 {"unit", unit_of(rule->quantity)},
                                 {"name", rule->name},
                                 {"inverse", rule->inverse},
                                 {"engine", values},
                                 {"scene", values_of(changed, rule->quantity)},
                                 {"was", values_of(scene, rule->quantity)}});
    fmt::print("{}\n", dump(json, 1));
    return 0;
  }
  fmt::print("{} of {} in {}: {}\n  step h = {:.6g} s{}\n", file, target.name, scene.name, target.numbers->title,
             numbers.h, target.numbers->iterations.empty() ? "" : fmt::format(", n = {}", numbers.iterations));
  for (const auto& [rule, values] : numbers.numbers) {
    fmt::print("  {} = {}: {}\n", rule->name, range(values, rule->unit), rule->inverse);
    fmt::print("    {} = {}; the scene had {}\n", name_of(rule->quantity),
               range(values_of(changed, rule->quantity), unit_of(rule->quantity)),
               range(values_of(scene, rule->quantity), unit_of(rule->quantity)));
  }
  if (!options.out.empty()) fmt::print("\n{}\n", options.out.string());
  return 0;
}

int translate_command(const TranslateOptions& options) {
  if (options.to.empty() == options.from.empty())
    throw InputError("translate: expected either --to METHOD or --from METHOD FILE");
  if (!options.from.empty() && !options.run.empty())
    throw InputError("--run: expected with --to only; --from yields a scene, which `run` runs");
  return options.to.empty() ? from_engine(options) : to_engine(options);
}

}  // namespace

void add_translate(CLI::App& app, Invocation& call) {
  auto [translate, options] =
      add_command(app, call, "translate",
                  "converts masses, drag, stiffness, dashpots and friction to another engine's parameters, and back",
                  translate_command);
  translate.add_option("SCENE", options.scene, "a shipped scene or a TOML file")->required();
  translate.add_option("--to", options.to,
                       "METHOD that receives the scene: a method of mysim or of Bullet, or jolt, rapier, box3d, "
                       "mujoco, godot; +n=N: iterations");
  translate.add_option("--from", options.from, "METHOD FILE: an engine's numbers (TOML, as --to --out writes them)")
      ->expected(2)
      ->type_name("METHOD FILE");
  translate.add_option("--step", options.step, "time step, s (default: that of the scene or of the file)")
      ->transform(time_above_zero());
  translate.add_option("--iterations", options.iterations, "iterations or sub-steps per step (default: the engine's)")
      ->check(CLI::Range(1, 1000));
  translate.add_option("--run", options.run,
                       "METHOD that runs the translated scene, such as exec:PROGRAM (default: that of --to)");
  translate.add_option("--out", options.out, "FILE.toml: with --to the engine's numbers, with --from the scene");
  translate.add_flag("--json", options.json, "prints JSON");
}

}  // namespace crosscheck
