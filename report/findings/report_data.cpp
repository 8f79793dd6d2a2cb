// Picks rows from tables.
#include "report/findings/report_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/table.h"

namespace crosscheck {

std::string failure_class(const std::string& verdict) {
  static constexpr std::pair<std::string_view, const char*> table[] = {{"stretch", "overstretched"},
                                                                       {"solver", "solver gave up"},
                                                                       {"frozen", "froze"},
                                                                       {"timeout", "out of time"},
                                                                       {"crash", "program failed"}};
  for (const auto& [name, word] : table)
    if (verdict == name) return word;
  return "blew up";
}

std::string failure_class_or_cannot(const std::string& verdict) {
  return verdict == "unsupported" ? "cannot" : failure_class(verdict);
}

const MethodData* SceneData::find(const std::string& method) const {
  for (const MethodData& m : methods)
    if (m.method == method) return &m;
  return nullptr;
}

bool SceneData::touched() const {
  for (const MethodData& m : methods)
    if (m.ok() && m.clearance && *m.clearance < 1e-3) return true;
  return false;
}

bool is_useless(const MethodData& run, const SceneData& scene) {
  return run.judged() && *run.error > 0.1 * scene.motion;
}

SceneData scene_data(const std::string& scene, const Rows& result) {
  SceneData facts;
  facts.scene = scene;
  const Table* runs = result.table("engines");
  if (!runs) return facts;  // no run of any scene came to a row: the page says why among what is missing
  const Table& engines = *runs;
  for (size_t i = 0; i < engines.rows.size(); ++i) {
    if (text_or_none(engines, i, "scene") != scene) continue;
    facts.motion = number_at(engines, i, "motion").value_or(0);
    facts.window = number_at(engines, i, "window").value_or(0);
    facts.measured_window = number_at(engines, i, "measured window").value_or(0);
    facts.growth = number_at(engines, i, "perturbation growth").value_or(0);
    facts.round_off = number_at(engines, i, "round-off bound");
    facts.truth = text_or_none(engines, i, "truth");
    facts.contact_until = number_at(engines, i, "truth until");
    if (!facts.contact_until) facts.tier = text_or_none(engines, i, "truth tier");
    facts.error_bar = number_at(engines, i, "truth bar").value_or(0);
    MethodData m;
    m.method = text_or_none(engines, i, "method");
    m.verdict = text_or_none(engines, i, "verdict");
    m.reason = text_or_none(engines, i, "reason");
    m.different_law = text_or_none(engines, i, "different law");
    m.end = number_at(engines, i, "end").value_or(0);
    m.step = number_at(engines, i, "step").value_or(0);
    m.evaluations = static_cast<long>(number_at(engines, i, "evaluations", 0));
    m.degenerate_springs = static_cast<long>(number_at(engines, i, "coincident springs", 0));
    m.error = number_at(engines, i, "largest error");
    m.from_contact = number_at(engines, i, "largest difference from converged contact");
    m.difference = number_at(engines, i, "largest difference");
    m.centres = number_at(engines, i, "largest difference of centres");
    m.clearance = number_at(engines, i, "smallest clearance");
    m.creep = number_at(engines, i, "creep at end");
    m.limit = number_at(engines, i, "predicted step limit");
    facts.methods.push_back(std::move(m));
  }
  for (MethodData& m : facts.methods) {
    if (const Table* cost = result.table("engines-cost"))
      for (size_t i = 0; i < cost->rows.size(); ++i)
        if (text_or_none(*cost, i, "scene") == scene && text_or_none(*cost, i, "method") == m.method) {
          m.cpu = number_at(*cost, i, "cpu");
        }
    if (const Table* energy = result.table("engines-energy"))
      for (size_t i = 0; i < energy->rows.size(); ++i)
        if (text_or_none(*energy, i, "scene") == scene && text_or_none(*energy, i, "method") == m.method)
          m.energy_error = number_at(*energy, i, "relative balance error");
  }
  return facts;
}

const MethodData* most_accurate(const SceneData& scene, bool (MethodFamily::*asked)() const) {
  const MethodData* best = nullptr;
  for (const MethodData& m : scene.methods)
    if (m.judged() && (!asked || (family_of(m.method).*asked)()) && (!best || *m.error < *best->error)) best = &m;
  return best;
}

bool ties_with(const MethodData& run, const MethodData& other, const SceneData& scene) {
  return *run.error <= std::max(1.05 * *other.error, scene.error_bar);
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
  // 1.2e-05 -> 1.2e-5
  const size_t e = text.find('e');
  std::string exponent = text.substr(e + 2);
  exponent.erase(0, std::min(exponent.find_first_not_of('0'), exponent.size() - 1));
  return text.substr(0, e) + "e" + (text[e + 1] == '-' ? "-" : "") + exponent;
}

std::string nice_length(double metres) {
  const double size = std::abs(metres);
  if (size == 0) return "0 m";
  // two digits, then plain: 810, not 8.1e+02
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
  return nice(1e6 * seconds) + " µs";
}

std::string own_step_text(const Scene& scene) {
  const double taken = time_grid(default_run(scene)).h;
  const std::string asked = step_text(scene.step), text = step_text(taken);
  return text == asked ? asked : fmt::format("{} (of the {} asked for)", text, asked);
}

std::string setting_text(const std::string& setting, double asked) {
  return setting.starts_with("tolerance") ? "tolerance " + nice(asked) : step_text(asked);
}

std::string scene_class(const Scene& scene) {
  const Model& model = scene.model;
  const std::pair<bool, const char*> table[] = {{model.find<Spheres>(), "ball"},
                                                {model.find<Constraints>(), "hard lengths"},
                                                {!scene.triangles.empty(), "cloth"},
                                                {model.find<Springs>(), "springs"},
                                                {model.find<Rotation>(), "rotation"}};
  for (const auto& [is, kind] : table)
    if (is) return kind;
  return "free flight";
}

}  // namespace crosscheck
