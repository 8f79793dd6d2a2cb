#include "report/findings/report_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crosscheck {

std::string failure_class(std::string_view verdict) {
  static constexpr std::pair<std::string_view, const char*> table[] = {
      {"stretch", "overstretched"}, {"solver", "solver gave up"}, {"frozen", "froze"},
      {"timeout", "out of time"},   {"crash", "program failed"},  {"unsupported", "unsupported"}};
  for (const auto& [name, word] : table)
    if (verdict == name) return word;
  return "blew up";
}

const MethodData* SceneData::find(const std::string& method) const {
  for (const MethodData& m : methods)
    if (m.method == method) return &m;
  return nullptr;
}

std::optional<double> SceneData::round_off() const {
  std::optional<double> least;
  for (const MethodData& m : methods)
    if (m.round_off_bound && (!least || *m.round_off_bound < *least)) least = m.round_off_bound;
  return least;
}

bool SceneData::touched() const {
  for (const MethodData& m : methods)
    if (m.ok() && m.clearance && *m.clearance < 1e-3) return true;
  return false;
}

bool is_useless(const MethodData& run, const SceneData& scene) {
  return run.judged() && *run.error > useless_from * scene.motion;
}

SceneData scene_data(const std::string& scene, const TableSet& result) {
  SceneData facts;
  facts.scene = scene;
  // if the scene has no row, the page's list of problems gives the reason
  for (EngineRow& run : rows_of<EngineRow>(result)) {
    if (run.scene != scene) continue;
    facts.motion = run.motion, facts.window = run.window;
    facts.measured_window = run.measured_window, facts.growth = run.growth;
    facts.truth = run.truth.value_or("");
    facts.truth_until = run.truth_until;
    if (run.truth_kind && run.truth_kind->of_contact_rule)
      facts.contact_until = run.truth_until;
    else if (run.truth_kind)
      facts.tier = name_of(run.truth_kind->tier);
    facts.error_bar = run.truth_bar.value_or(0);
    facts.methods.push_back({std::move(run)});
  }
  const auto energies = rows_of<EngineEnergyRow>(result);
  for (MethodData& m : facts.methods)
    for (const EngineEnergyRow& row : energies)
      if (row.scene == scene && row.method == m.method) m.energy_error = row.relative_balance_error;
  return facts;
}

bool is_adaptive(const std::string& method) {
  const Method* m = builtin_method(method);
  return m && m->adaptive;
}

std::string nice(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 999.5 && size < 1e4) return fmt::format("{:.0f}", value);  // 3518, not 3.52e+03
  if (size >= 1e-3 && size < 1e4) return fmt::format("{:.3g}", value);
  std::string text = fmt::format("{:.1e}", value);
  const size_t e = text.find('e');
  std::string exponent = text.substr(e + 2);
  exponent.erase(0, std::min(exponent.find_first_not_of('0'), exponent.size() - 1));
  return text.substr(0, e) + "e" + (text[e + 1] == '-' ? "-" : "") + exponent;
}

std::string nice_length(double metres) {
  const double size = std::abs(metres);
  if (size == 0) return "0 m";
  // without an exponent: 810, not 8.1e+02
  auto two_digits = [](double value) {
    const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 1);
    return fmt::format("{:g}", std::round(value / unit) * unit);
  };
  if (size >= 1) return fmt::format("{:.3g} m", metres);
  if (size >= 0.995e-4) return two_digits(metres * 1e3) + " mm";
  if (size >= 0.995e-6) return two_digits(metres * 1e6) + " µm";
  if (size >= 0.995e-9) return two_digits(metres * 1e9) + " nm";
  return nice(metres) + " m";
}

std::string step_text(double seconds) {
  if (seconds == 0) return "0 s";
  if (seconds >= 1) return nice(seconds) + " s";
  if (seconds >= 1e-3) return nice(1e3 * seconds) + " ms";
  if (seconds >= 1e-6) return nice(1e6 * seconds) + " µs";
  return nice(1e9 * seconds) + " ns";
}

std::string own_step_text(const Scene& scene) {
  const double taken = time_grid(default_run(scene)).h;
  const std::string requested = step_text(scene.step), text = step_text(taken);
  return text == requested ? requested : fmt::format("{} (requested: {})", text, requested);
}

std::string setting_text(std::string_view setting, double value) {
  return setting.starts_with("tolerance") ? "tolerance " + nice(value) : step_text(value);
}

}  // namespace crosscheck
