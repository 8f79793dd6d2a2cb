// Picks rows from tables.
#include "report/facts.h"

#include <fmt/format.h>

#include <cmath>

namespace crosscheck {

std::string failure_word(const std::string& verdict) {
  static constexpr std::pair<std::string_view, const char*> table[] = {{"stretch", "overstretched"},
                                                                       {"solver", "solver gave up"},
                                                                       {"frozen", "froze"},
                                                                       {"timeout", "out of time"},
                                                                       {"crash", "program failed"}};
  for (const auto& [name, word] : table)
    if (verdict == name) return word;
  return "blew up";
}
namespace {

std::string text(const Cell& cell) {
  const auto* value = std::get_if<std::string>(&cell);
  return value ? *value : "";
}

std::optional<double> number(const Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return *value;
  return std::nullopt;
}

long whole(const Cell& cell) {
  const auto* value = std::get_if<long>(&cell);
  return value ? *value : 0;
}

}  // namespace

const MethodFacts* SceneFacts::find(const std::string& method) const {
  for (const MethodFacts& m : methods)
    if (m.method == method) return &m;
  return nullptr;
}

bool SceneFacts::touched() const {
  for (const MethodFacts& m : methods)
    if (m.ok() && m.clearance && *m.clearance < 1e-3) return true;
  return false;
}

SceneFacts facts_of(const std::string& scene, const Rows& result) {
  SceneFacts facts;
  facts.scene = scene;
  const Table& engines = *result.table("engines");
  for (size_t i = 0; i < engines.rows.size(); ++i) {
    if (text(engines.at(i, "scene")) != scene) continue;
    facts.motion = number(engines.at(i, "motion")).value_or(0);
    facts.window = number(engines.at(i, "window")).value_or(0);
    facts.measured_window = number(engines.at(i, "measured window")).value_or(0);
    facts.growth = number(engines.at(i, "perturbation growth")).value_or(0);
    facts.round_off = number(engines.at(i, "round-off bound"));
    facts.truth = text(engines.at(i, "truth"));
    facts.contact_until = number(engines.at(i, "truth until"));
    if (!facts.contact_until) facts.tier = text(engines.at(i, "truth tier"));
    facts.bar = number(engines.at(i, "truth bar")).value_or(0);
    MethodFacts m;
    m.method = text(engines.at(i, "method"));
    m.verdict = text(engines.at(i, "verdict"));
    m.reason = text(engines.at(i, "reason"));
    m.different_law = text(engines.at(i, "different law"));
    m.end = number(engines.at(i, "end")).value_or(0);
    m.step = number(engines.at(i, "step")).value_or(0);
    m.evaluations = whole(engines.at(i, "evaluations"));
    m.coincident = whole(engines.at(i, "coincident springs"));
    m.error = number(engines.at(i, "largest error"));
    m.from_contact = number(engines.at(i, "largest difference from converged contact"));
    m.difference = number(engines.at(i, "largest difference"));
    m.centres = number(engines.at(i, "largest difference of centres"));
    m.clearance = number(engines.at(i, "smallest clearance"));
    m.creep = number(engines.at(i, "creep at end"));
    m.limit = number(engines.at(i, "predicted step limit"));
    facts.methods.push_back(std::move(m));
  }
  for (MethodFacts& m : facts.methods) {
    if (const Table* cost = result.table("engines-cost"))
      for (size_t i = 0; i < cost->rows.size(); ++i)
        if (text(cost->at(i, "scene")) == scene && text(cost->at(i, "method")) == m.method) {
          m.cpu = number(cost->at(i, "cpu"));
          m.cpu_per_step = number(cost->at(i, "cpu per step"));
        }
    if (const Table* energy = result.table("engines-energy"))
      for (size_t i = 0; i < energy->rows.size(); ++i)
        if (text(energy->at(i, "scene")) == scene && text(energy->at(i, "method")) == m.method)
          m.energy_error = number(energy->at(i, "relative balance error"));
  }
  return facts;
}

std::string nice(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
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
  if (size >= 1e-4) return two_digits(metres * 1e3) + " mm";
  if (size >= 1e-6) return two_digits(metres * 1e6) + " µm";
  return nice(metres) + " m";
}

bool costs_compare(const Scene& scene) {
  return scene.model.particles.size() >= 50 && !scene.model.find<Aerodynamics>();
}

}  // namespace crosscheck
