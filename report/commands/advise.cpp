// Fits parameters marked "fit" to the scene's [wish], then finds the cheapest model, method and step for a tolerance.

#include "experiments/advise/advice.h"
#include "experiments/advise/fit.h"
#include "experiments/metrics.h"
#include "report/commands/command_line.h"
#include "report/commands/json_files.h"
#include "report/figures/figure.h"
#include "report/findings/report_data.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

struct AdviseOptions {
  std::string scene, methods, tolerance;  // if the tolerance is empty, only parameters are fitted
  fs::path out = "out/advise";
  std::string command_line;
};

/// Size (m) of the true motion in the comparison window, or else of the scene's own run. Throws InputError.
double motion_of_scene(const Scene& scene) {
  if (const auto truth = truth_of(scene, default_run(scene))) return motion_of(truth->trajectory);
  Recorder recorder;
  const Outcome own = run_method(find_method(scene.method), scene, default_run(scene), {&recorder});
  if (own.verdict != Verdict::ok)
    throw InputError(
        fmt::format("--tolerance: the motion of {} is not known, as its own method fails ({}): give a length in metres",
                    scene.name, in_words(own.verdict)));
  Trajectory& path = recorder.trajectory;
  while (path.t.back() > scene.window * (1 + 1e-9)) path.t.pop_back(), path.x.pop_back(), path.v.pop_back();
  return motion_of(path);
}

/// Parses a length, in metres or as a percentage of the motion. Throws InputError.
double tolerance_of(const std::string& text, const Scene& scene) {
  constexpr std::pair<std::string_view, double> lengths[] = {
      {"", 1}, {"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}};
  const auto [value, unit] = number_and_rest(text).value_or(std::pair{0., std::string()});
  const auto length = std::ranges::find(lengths, std::string_view(unit), &std::pair<std::string_view, double>::first);
  const bool of_motion = unit == "%";
  if (!(value > 0) || (length == std::end(lengths) && !of_motion))
    throw InputError(fmt::format(
        "--tolerance: expected a length above zero (m), such as 0.001 or 1mm, or a percentage of the motion such "
        "as 1%, got '{}'",
        text.substr(0, 60)));
  if (!of_motion) return value * length->second;
  const double motion = motion_of_scene(scene), tolerance = value / 100 * motion;
  fmt::print("{:g} % of the motion, {}, is {}\n", value, nice_length(motion), nice_length(tolerance));
  return tolerance;
}

std::string how_of(const Trial& t) {
  return t.relative > 0 ? fmt::format("{} at a relative tolerance of {:.3g}", t.method, t.relative)
                        : fmt::format("{} at a step of {:.6g} s", t.method, t.step);
}

/// Work-precision diagram of all trials. Failed runs are crosses at the cost they had reached.
Figure advice_figure(const Advice& a, const std::string& commit) {
  Figure f;
  f.name = a.scene.name + "-advice";
  f.title = fmt::format("{}: work-precision diagram of all trials", a.scene.name);
  f.x = {"force evaluations × springs", true};
  f.y = {a.under_contact_rule ? "largest RMS position difference / m" : "largest RMS position error / m", true};
  double highest = a.tolerance;
  for (const Trial& t : a.trials)
    if (t.error && *t.error > a.error_bar) highest = std::max(highest, *t.error);
  for (const Trial& t : a.trials) {
    if (t.outcome.verdict == Verdict::unsupported || t.outcome.evaluations == 0) continue;
    std::string title = short_name(t.method);
    MethodStyle style = style_of(t.method);
    if (t.model != "full") title += ", least model", style.dash = "(1,3)", style.marker = 6;
    if (!t.error) {
      f.failures.push_back(
          {title + ": " + failure_class(std::string(name_of(t.outcome.verdict))), style, t.cost(), 3 * highest});
      continue;
    }
    if (!(*t.error > a.error_bar)) continue;  // errors below the truth's error bar are unknown
    auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == title; });
    if (curve == f.curves.end()) curve = f.curves.insert(f.curves.end(), {title, style, {}, true, true});
    curve->points.emplace_back(t.cost(), *t.error);
  }
  const Trial& chosen = a.trials[a.chosen];
  double lowest = *chosen.error;
  for (Curve& c : f.curves) {
    std::ranges::sort(c.points);
    for (const auto& [x, y] : c.points) lowest = std::min(lowest, y);
  }
  // a line from the advised run down to the axis, because a marker is easily overlooked
  const double error = std::max(*chosen.error, a.error_bar);
  f.curves.push_back({"advised", {"#000000", "1", 3}, {{chosen.cost(), error}, {chosen.cost(), lowest / 2}}, true});
  f.floor = {fmt::format("tolerance: {}", nice_length(a.tolerance)), a.tolerance};
  f.finding = fmt::format("{} meets {} at the least cost.", how_of(chosen), nice_length(a.tolerance));
  f.caption = fmt::format("Scene {}, until {:.3g} s; reference: {}, error bar {} ({}); commit {}.", a.scene.name,
                          a.until, a.under_contact_rule ? "limit of mysim's contact rule" : name_of(a.tier),
                          nice_length(a.error_bar), a.truth, commit);
  return f;
}

Table trials_table(const Advice& a) {
  Table table{"advice",
              columns_of("model, method, step [s], relative tolerance, error [m], asked [m], truth bar [m], meets, "
                         "advised, verdict, stability limit [s], evaluations, springs, cost [spring evaluations]"),
              {}};
  for (size_t i = 0; i < a.trials.size(); ++i) {
    const Trial& t = a.trials[i];
    table.add({t.model, t.method, t.step, t.relative > 0 ? Cell(t.relative) : Cell(), cell_of(t.error), a.tolerance,
               a.error_bar,
               std::string(t.meets        ? "yes"
                           : t.accidental ? "by luck"
                                          : "no"),
               i == a.chosen ? 1l : 0l, std::string(name_of(t.outcome.verdict)), cell_of(t.limit),
               t.outcome.evaluations, t.springs, t.cost()});
  }
  return table;
}

Table costs_table(const Advice& a) {
  Table table{"advice-cost", columns_of("model, method, step [s], cpu [s]"), {}};
  for (const Trial& t : a.trials) table.add({t.model, t.method, t.step, t.outcome.cpu_seconds});
  return table;
}

std::string_view bound_text(StepBound bound) {
  return bound == StepBound::stability  ? "stability: the next longer step that was tried blew up"
         : bound == StepBound::accuracy ? "accuracy: the next longer step that was tried misses the tolerance"
         : bound == StepBound::failure  ? "a failure of the next longer step that was tried"
                                        : "the time between samples";
}

std::string margin_text(const Trial& t) {
  if (t.relative > 0) return "its steps follow the tolerance";
  if (!t.limit) return "no limit is predicted";
  if (*t.limit == 0) return "theory predicts no stable step";
  return fmt::format("{:.3g} times the step ({:.4g} s)", *t.limit / t.step, *t.limit);
}

Json json_of(const Trial& t) {
  return {{"model", t.model},
          {"method", t.method},
          {"step", t.step},
          {"relative_tolerance", t.relative > 0 ? Json(t.relative) : Json()},
          {"error", *t.error},
          {"stability_limit", t.limit ? Json(*t.limit) : Json()},
          {"force_evaluations", t.outcome.evaluations},
          {"cost", t.cost()}};
}

std::string json_of(const Advice& a) {
  Json json{{"scene", a.scene.name},
            {"scene_hash", a.scene.hash},
            {"tolerance", a.tolerance},
            {"truth", a.truth},
            {"tier", static_cast<int>(a.tier)},
            {"of_contact_rule", a.under_contact_rule},
            {"bar", a.error_bar},
            {"until", a.until},
            {"left_out", a.left_out},
            {"advised", json_of(a.trials[a.chosen])},
            {"second", a.second ? json_of(a.trials[*a.second]) : Json()},
            {"full_model", a.of_full ? json_of(a.trials[*a.of_full]) : Json()},
            {"bound_by", std::string(name_of(a.bound))},
            {"error_of_the_file", a.checked},
            {"caveats", a.caveats}};
  return dump(json, 1) + "\n";
}

void print(const std::vector<WishResult>& wishes) {
  for (const WishResult& w : wishes) {
    fmt::print("  {}: wished {:.6g}{}, reached {:.6g} ({:+.2g} %), by the file's method and step {:.6g} ({:+.2g} %)\n",
               w.name, w.wished, w.unit == "1" ? "" : " " + w.unit, w.reached, 100 * (w.reached / w.wished - 1), w.own,
               100 * (w.own / w.reached - 1));
    if (!w.kept())
      fmt::print("  note: no step of the file's method keeps the {} within {} % of the scene's own\n", w.name,
                 100 * WishResult::tolerance);
  }
}

void print(const Advice& a) {
  const Trial& t = a.trials[a.chosen];
  fmt::print("{} to {} until {:.3g} s\n", a.scene.name, nice_length(a.tolerance), a.until);
  fmt::print("  model     {}\n", a.left_out.empty() ? "full" : t.model);
  fmt::print("  method    {}\n", how_of(t));
  fmt::print("  {} {} (largest RMS over time; reference: {}, error bar {})\n",
             a.under_contact_rule ? "differs  " : "error    ", nice_length(a.checked),
             a.under_contact_rule ? "mysim's contact rule" : name_of(a.tier), nice_length(a.error_bar));
  fmt::print("  margin    stability limit: {}\n", margin_text(t));
  if (t.relative == 0) fmt::print("  bound by  {}\n", bound_text(a.bound));
  fmt::print("  cost      {} force evaluations x {} springs; {:.2g} s of CPU time here\n", t.outcome.evaluations,
             t.springs, t.outcome.cpu_seconds);
  if (a.second) {
    const Trial& s = a.trials[*a.second];
    fmt::print("  next best {}, {:.3g} times the cost\n", how_of(s), s.cost() / t.cost());
  }
  if (a.of_full) {
    const Trial& full = a.trials[*a.of_full];
    fmt::print("  full      {} with the whole scene, {:.3g} times the cost\n", how_of(full), full.cost() / t.cost());
  }
  if (a.between_samples)
    fmt::print("  note: the largest errors are between the samples, where a report does not measure\n");
  print(a.wishes);
  for (const std::string& c : a.caveats) fmt::print("  note: {}\n", c);
}

void print(const FitResult& fitted) {
  fmt::print("{}: values fitted to the wishes\n", fitted.scene.name);
  for (const Unknown& u : fitted.unknowns) fmt::print("  {} = {:.6g} {}\n", u.name, u.value, u.unit);
  print(fitted.wishes);
}

int advised(const AdviseOptions& options, OutputFolder& folder) {
  std::optional<Scene> scene;
  std::string toml;
  if (options.scene.ends_with(".toml") && fs::exists(options.scene)) {
    const std::string text = read_file(options.scene, "a scene file (TOML)");
    if (has_unknowns(text, options.scene)) {
      Progress progress(1);
      progress.begin(fmt::format("fitting {}", options.scene));
      FitResult fitted = fit_to_wishes(text, options.scene);
      fitted.scene.name = file_name_of(fs::path(options.scene).stem().string());
      progress.done();
      print(fitted);
      toml = fitted.toml;
      scene = std::move(fitted.scene);
    }
  }
  if (!scene) scene = load_scene(options.scene, options.methods);
  if (options.tolerance.empty() && toml.empty())
    throw InputError(
        fmt::format("--tolerance: expected a length above zero (m), as {} has nothing to fit", options.scene));
  const fs::path& out = folder.path();
  const auto file = out / "advice.toml";
  if (!toml.empty()) write_file(file, toml);
  if (!options.tolerance.empty()) {
    const double tolerance = tolerance_of(options.tolerance, *scene);
    std::vector<Method> methods = options.methods.empty() ? candidates(*scene) : find_methods(options.methods);
    // the memory must hold two runs: the truth, and the trial that is compared with the truth
    require_resources_to_keep({find_method(scene->method), find_method(scene->method)}, *scene, default_run(*scene));
    Progress progress(0);
    progress.begin(fmt::format("reference solution of {}", scene->name));
    for (Method& method : methods) method = with_progress(method, progress);
    const Advice a = advise(*scene, tolerance, std::move(methods));
    progress.done();
    const Provenance lines = with_scene(provenance(options.command_line), *scene);
    write_csv(trials_table(a), lines, out);
    write_csv(costs_table(a), lines, out);
    write_file(file, a.toml);
    write_file(out / "advice.json", json_of(a));
    draw(drawing_of(advice_figure(a, value_of(lines, "commit"))), lines, out);
    folder.finish();
    print(a);
  } else {
    folder.finish();
  }
  fmt::print("  {}\n", (options.out / "advice.toml").string());
  return 0;
}

int advise_command(const AdviseOptions& options) {
  OutputFolder folder(options.out, "advise");
  try {
    return advised(options, folder);
  } catch (const CannotGuarantee& why) {
    // finish() removes an earlier advice.toml; keep that file if it is the scene of this command
    const fs::path old = options.out / "advice.toml", now = folder.path() / "advice.toml";
    if (!fs::exists(now) && fs::exists(old) && fs::exists(options.scene) && fs::equivalent(old, options.scene))
      fs::copy_file(old, now);
    folder.finish();
    fmt::print(stderr, "crosscheck: no guaranteed advice for {}: {}\n", options.scene, why.what());
    return 1;
  }
}

}  // namespace

void add_advise(CLI::App& app, Invocation& call) {
  auto [advise, options] = add_command(
      app, call, "advise", "finds the cheapest model, method and time step within a tolerance, with a verifying run",
      advise_command);
  advise
      .add_option("SCENE", options.scene,
                  "a shipped scene or a TOML file; values \"fit\" are determined from its [wish]")
      ->required();
  advise.add_option("--tolerance", options.tolerance,
                    "largest RMS position error, m, or in per cent of the motion (1%); not needed if only a "
                    "scene's parameters are fitted");
  advise.add_option("--methods", options.methods, "methods to try: A,B,... (default: all of mysim)");
  advise.add_option("--out", options.out, "folder (out/advise)");
}

}  // namespace crosscheck
