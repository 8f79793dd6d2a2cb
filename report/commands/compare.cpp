// Prints parity certificates and a comparison of methods. Exit 1 on a mismatch, if methods of the same rule differ, or
// if all methods failed.

#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/stability/margin.h"
#include "experiments/tables/engines.h"
#include "reference/certificate/certificate.h"
#include "reference/engines/engines.h"
#include "reference/which_rule.h"
#include "report/commands/command_line.h"
#include "report/commands/json_files.h"
#include "report/findings/report_data.h"

namespace crosscheck {
namespace {

struct CompareOptions {
  std::string scene, methods, reference;
  double step = 0;
  std::filesystem::path trajectory;
  std::filesystem::path out = "out/compare";
  std::string command_line;
};

/// With `brief`, only counts matching rows.
void print(const Certificate& certificate, bool brief) {
  fmt::print("\nparity of {} with the scene {}\n", without_folders(certificate.method), certificate.scene);
  for (const CertificateRow& r : certificate.rows)
    if (!brief || r.parity != Parity::match)
      fmt::print("  {:<14} {:<14} requested: {}; passed: {}; read back: {}\n", name_of(r.parity), r.quantity,
                 r.requested, r.mapped, r.read_back);
  fmt::print("  {}\n", summary_of(certificate));
}

std::string shown(std::optional<double> value) { return value ? fmt::format("{:.3g}", *value) : "-"; }

/// Prints the differences between methods of the same rule. Returns true if one exceeds the allowed difference.
bool equal_rules_differ(const Request& request, const Scene& scene, MethodResults& answers) {
  const std::vector<Method> methods = methods_of(request, scene);
  const Run run = run_of(request, scene);
  const TimeGrid grid = time_grid(run);
  const auto judged = [](const MethodResult& r) {  // excludes methods with a different contact law
    return r.outcome.verdict == Verdict::ok && r.outcome.different_law.empty();
  };
  bool differ = false;
  for (size_t i = 0; i < methods.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const MethodResult &a = result_of(request, scene, methods[i], answers),
                         &b = result_of(request, scene, methods[j], answers);
      if (methods[i].name == methods[j].name || !same_rule(methods[i], methods[j], scene.model).value_or(false) ||
          !judged(a) || !judged(b))
        continue;
      double largest = 0;
      for (int k = 0;
           k < std::min(a.trajectory.frames(), b.trajectory.frames()) && a.trajectory.t[k] <= scene.window * (1 + 1e-9);
           ++k)
        largest = std::max(largest, largest_column(a.trajectory.x[k] - b.trajectory.x[k]));
      const double growth = perturbation_growth(methods[j], scene, run.step, scene.window);
      const auto bound = [&](const Method& method) {
        return round_off_bound_of(method, scene, motion_of(a.trajectory), growth,
                                  1L * grid.steps_per_sample * grid.samples);
      };
      const std::optional<double> allowed = std::max(bound(methods[i]), bound(methods[j]));
      const bool over = allowed && largest > *allowed;
      fmt::print("\n{} and {} use the same rule: they differ by {:.3g} m, {}\n", without_folders(b.method),
                 without_folders(a.method), largest,
                 allowed ? fmt::format("round-off allows {:.3g} m: {}", *allowed, over ? "NOT THE SAME" : "the same")
                         : fmt::format("but a perturbation grows {:.1g}-fold here: no conclusion", growth));
      differ |= over;
    }
  return differ;
}

int compare_command(const CompareOptions& options) {
  Request request;
  request.scenes.push_back(load_scene(options.scene, options.methods));
  if (!options.methods.empty()) request.methods = find_methods(options.methods);
  request.step = options.step;
  if (!options.reference.empty()) {
    const Method reference = find_method(options.reference);
    request.reference = reference.name;
    if (!request.methods.empty() &&
        std::ranges::find(request.methods, reference.name, &Method::name) == request.methods.end())
      request.methods.push_back(reference);
  }
  if (!options.trajectory.empty()) {
    const Scene& scene = request.scenes[0];
    if (request.methods.empty()) request.methods = methods_of(request, scene);
    request.methods.push_back(trajectory_method(options.trajectory, scene, run_of(request, scene)));
  }
  const Scene& scene = request.scenes[0];
  const std::vector<Method> methods = methods_of(request, scene);
  require_resources_to_keep(methods, scene, run_of(request, scene));
  ResumableOutput folder(options.out, "compare");
  const Provenance lines = with_scenes(provenance(options.command_line), request.scenes);

  MethodResults answers;
  TableSet result;
  Table so_far = table_of<EngineRow>();
  Progress progress(static_cast<int>(methods.size()) + 1);
  for (const Method& method : methods) {
    Request shown = request;
    shown.methods = {with_progress(method, progress)};
    const Outcome& out = result_of(shown, scene, shown.methods[0], answers).outcome;
    // write a table after each run, so that an interrupted comparison keeps its finished runs
    add(so_far, EngineRow{scene.name, method.name, out.verdict, out.reason, out.end, out.step, out.steps,
                          out.evaluations, out.degenerate_springs});
    write_file(folder.growing(so_far.name + ".csv"), csv(so_far, lines));
  }
  progress.begin(fmt::format("reference solution and certificates of {}", scene.name));
  engines_on(request, scene, answers, result);
  progress.done();
  for (const Table& table : result.tables) {
    folder.announce({table.name + ".csv"});
    write_csv(table, lines, options.out);
  }

  bool mismatch = false;  // true: a certificate failed; the other engines' numbers are still printed
  for (const Certificate& certificate : result.certificates) {
    print(certificate, result.certificates.size() > 3);
    const std::string file = file_name_of("certificate-" + certificate.method) + ".json";
    folder.announce({file});
    write_file(options.out / file, certificate_json(certificate));
    if (certificate.mismatch()) {
      fmt::print("  MISMATCH: {} was given another scene; its numbers are not compared\n", certificate.method);
      mismatch = true;
    }
  }
  folder.finish();

  const std::vector<EngineRow> runs = rows_of<EngineRow>(result);
  const std::optional<TruthKind> tier = runs.at(0).truth_kind;
  fmt::print("\n{}: {}\nreference solution: {}{}\n\n", scene.name, scene.question,
             tier ? std::get<std::string>(to_cell(*tier)) : "none",
             tier ? fmt::format(", error bar {} m{} ({})", shown(runs[0].truth_bar),
                                runs[0].truth_until ? fmt::format(" until {:.3g} s", *runs[0].truth_until) : "",
                                *runs[0].truth)
                  : "");
  // with contact there is no truth: a distance from the limit of mysim's rule is not an error
  const bool of_rule = tier && tier->of_contact_rule;
  fmt::print("{:<28} {:<12} {:>10} {:>10} {:>12} {:>10} {:>10}\n", "method", "verdict", of_rule ? "rule/m" : "error/m",
             "diff./m", "centres/m", "step/s", "until/s");
  for (const EngineRow& run : runs) {
    fmt::print("{:<28} {:<12} {:>10} {:>10} {:>12} {:>10} {:>10}\n", without_folders(run.method), name_of(run.verdict),
               shown(of_rule ? run.contact_difference : run.error), shown(run.difference), shown(run.centre_difference),
               shown(run.step), shown(run.end));
    if (run.verdict != Verdict::ok)
      fmt::print("    {}\n", run.reason.empty() ? std::string(in_words(run.verdict)) : run.reason);
  }
  for (const MethodResult& answer : answers)
    if (!answer.outcome.remark.empty()) fmt::print("\n{}: {}\n", answer.method, answer.outcome.remark);
  for (const Method& method : methods) {
    const Outcome& out = result_of(request, scene, method, answers).outcome;
    if (const std::string outlook = out.verdict == Verdict::ok ? stability_warning(method, scene, out.step) : "";
        !outlook.empty())
      fmt::print("\n{}: {}\n", method.name, outlook);
    if (method.adaptive && options.step > 0)
      fmt::print("\n{} chooses its own steps: --step does not apply to it\n", method.name);
  }
  fmt::print("\n{}; diff.: from {}; largest RMS over the particles up to {:.3g} s\n",
             of_rule ? "rule: from the limit of mysim's contact rule" : "error: from the reference solution",
             request.reference.empty() ? subject().representative : request.reference, scene.window);
  for (const Method& method : methods)
    if (method.identify) {
      const std::string& engine = result_of(request, scene, method, answers).outcome.engine;
      fmt::print("\n{}{}: its rule is {}\n", without_folders(method.name),
                 engine.empty() ? "" : fmt::format(" ({})", engine), sentence_of(method.identify()));
    }
  const bool differ = equal_rules_differ(request, scene, answers);
  const bool all_failed = std::ranges::none_of(runs, [](const EngineRow& run) { return run.verdict == Verdict::ok; });
  if (all_failed) fmt::print("\nno method has a result: each one failed or refused the scene\n");
  fmt::print("\n{}\n", options.out.string());
  return mismatch || differ || all_failed ? 1 : 0;
}

}  // namespace

void add_compare(CLI::App& app, Invocation& call) {
  auto [compare, options] =
      add_command(app, call, "compare",
                  "checks that all methods received the same scene (parity certificate), then compares their results",
                  compare_command);
  compare.add_option("SCENE", options.scene, "a shipped scene or a TOML file")->required();
  compare.add_option("--methods", options.methods, "methods to compare: A,B,...");
  compare.add_option("--reference", options.reference,
                     "method from which the others' differences are measured (default: symplectic-euler)");
  compare.add_option("--step", options.step, "time step, s")->transform(time_above_zero());
  compare.add_option("--trajectory", options.trajectory,
                     "FILE.npy: positions computed by another program, compared with the methods");
  compare.add_option("--out", options.out, "folder (out/compare)");
}

}  // namespace crosscheck
