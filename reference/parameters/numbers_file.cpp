// Files with an engine's numbers, and scene files with numbers converted back.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mysim/base/errors.h"
#include "mysim/scene/toml.h"
#include "reference/parameters/parameters.h"

namespace crosscheck {
namespace {

/// The number with all digits needed to restore its bits.
std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// A single number if all are equal, otherwise a list, ten per line.
std::string toml_numbers(const std::vector<double>& values) {
  if (std::ranges::all_of(values, [&](double v) { return v == values[0]; })) return toml_number(values[0]);
  std::string text = "[";
  for (size_t i = 0; i < values.size(); ++i)
    text += (i == 0 ? "" : i % 10 == 0 ? ",\n  " : ", ") + toml_number(values[i]);
  return text + "]";
}

}  // namespace

std::string numbers_toml(const Scene& scene, const Translation& t) {
  const EngineNumbers& engine = *t.target.numbers;
  std::string text = fmt::format(
      "# The scene {} in the parameters of {}: {}.\n# A list follows the scene's order of springs or particles, "
      "without pins.\nmethod = \"{}\"\nstep = {}  # s\n",
      scene.name, t.target.name, engine.title, t.target.name, toml_number(t.h));
  if (!engine.iterations.empty())
    text += fmt::format("iterations = {}  # {}\n", t.target.iterations, engine.iterations);
  for (const TranslatedNumber& number : t.numbers)
    text += fmt::format("\n# {} = {}; unit {}\n{} = {}\n", number.rule->name, number.rule->formula, number.rule->unit,
                        number.rule->name, toml_numbers(number.engine));
  for (const std::string& lost : t.lost) text += fmt::format("\n# {}\n", lost);
  return text;
}

NumbersFile read_numbers(const std::string& text, const std::string& name, const Scene& scene,
                         const TranslationTarget& target, double step) {
  const TomlTable file = TomlTable::parse_text(text, name);
  const TomlDocument document(text, name);  // distinguishes lists from numbers
  const EngineNumbers& engine = *target.numbers;
  NumbersFile numbers{step, target.iterations, {}};
  if (file.has("method")) {
    const std::string method = file.text("method");
    if (find_target(method, 0).numbers != &engine)
      file.fail("method", fmt::format("parameters of {}, got those of {}", target.name, method));
  }
  if (file.has("step") && step == 0) numbers.h = file.positive("step");
  if (!(numbers.h > 0)) file.fail("step", "the engine's time step (s), here or as --step");
  if (file.has("iterations")) {
    const int n = file.count("iterations", 1000);
    if (engine.iterations.empty() && n != 1)
      file.fail("iterations", fmt::format("1 or no such key: {} takes one pass per step", target.name));
    if (!target.iterations_given) numbers.iterations = n;
  }
  for (const NumberRule& rule : engine.rules) {
    if (!rule.to || !file.has(rule.name)) continue;
    const int count = static_cast<int>(values_of(scene, rule.quantity).size());
    if (count == 0) file.fail(rule.name, fmt::format("no such key: the scene has no {}", name_of(rule.quantity)));
    const bool one = rule.gather != NumberRule::Gather::each;
    const bool list = document.has(fmt::format("{}[0]", rule.name));
    if (list && one) file.fail(rule.name, fmt::format("one number for the whole body ({})", rule.unit));
    const Eigen::VectorXd read =
        list ? file.numbers(rule.name, count) : Eigen::VectorXd::Constant(1, file.number(rule.name));
    for (Eigen::Index i = 0; i < read.size(); ++i) {
      const double v = read[i];
      const bool pinned =
          v == 1 && rule.quantity == SceneNumber::stiffness;  // between two pins, in a list written by this program
      if (rule.valid ? rule.valid(v) || (pinned && read.size() > 1) : v >= 0 && std::isfinite(v)) continue;
      file.fail(read.size() > 1 ? fmt::format("{}[{}]", rule.name, i) : std::string(rule.name),
                fmt::format("{}, got {:.17g}", rule.expected.empty() ? "a number not below zero" : rule.expected, v));
    }
    numbers.numbers.emplace_back(&rule, std::vector<double>(read.begin(), read.end()));
  }
  file.finish();
  if (numbers.numbers.empty()) {
    std::vector<std::string_view> names;
    for (const NumberRule& rule : engine.rules)
      if (rule.to) names.push_back(rule.name);
    throw InputError(fmt::format("{}: expected at least one of {}, the parameters of {}", name, fmt::join(names, ", "),
                                 target.name));
  }
  return numbers;
}

namespace {

class SceneFile {
 public:
  SceneFile(const Scene& source, double within) : file_(source.source, source.name), within_(within), scene_(source) {}

  /// Sets the number at each path. Entries of the same path must agree, because the file has one number for them.
  void set(const std::vector<std::pair<std::string, double>>& values) {
    for (size_t i = 0; i < values.size(); ++i) {
      const auto& [path, value] = values[i];
      const auto first = std::ranges::find(values, path, &std::pair<std::string, double>::first);
      if (first != values.begin() + static_cast<std::ptrdiff_t>(i)) {
        if (!(std::abs(value - first->second) <= within_ * std::abs(value)))
          throw InputError(
              fmt::format("{}: {}: expected a common value, got {:.6g} and {:.6g}, which --out cannot "
                          "write; list the elements one by one in the scene",
                          scene_.name, path, first->second, value));
        continue;
      }
      file_.set(path, value);
    }
  }
  bool has(const std::string& path) const { return file_.has(path); }
  std::string text() const { return file_.text(); }

 private:
  TomlDocument file_;
  double within_;
  const Scene& scene_;
};

}  // namespace

std::string scene_toml(const Scene& source, const Scene& changed, double within) {
  SceneFile file(source, within);
  // numbers that agree to rounding keep the file's own digits
  const auto same = [&](SceneNumber quantity) {
    return std::ranges::equal(values_of(source, quantity), values_of(changed, quantity),
                              [&](double a, double b) { return std::abs(a - b) <= within * std::abs(a); });
  };
  if (!same(SceneNumber::gravity))
    throw InputError(fmt::format(
        "{}: gravity.acceleration: the parameters correspond to {:.6g} m/s^2, but the scene has {:.6g}; "
        "change the scene first",
        source.name, values_of(changed, SceneNumber::gravity)[0], values_of(source, SceneNumber::gravity)[0]));
  const Particles& particles = changed.model.particles;
  int single = 0;
  while (file.has(fmt::format("particle[{}]", single))) ++single;
  const int on_grid = particles.size() - single;  // grid particles come first

  std::vector<std::pair<std::string, double>> values;
  if (!same(SceneNumber::mass))
    for (int i = 0; i < particles.size(); ++i) {
      if (particles.pinned[i]) continue;
      if (i < on_grid)
        values.emplace_back("grid.mass", particles.mass[i] * on_grid);
      else
        values.emplace_back(fmt::format("particle[{}].mass", i - on_grid), particles.mass[i]);
    }
  const auto* springs = changed.model.find<Springs>();
  int listed = 0;  // [[spring]] entries so far
  if (springs && !same(SceneNumber::stiffness))
    for (const Spring& s : springs->list)
      values.emplace_back(s.family == Family::single ? fmt::format("spring[{}].stiffness", listed++)
                                                     : fmt::format("grid.stiffness.{}", name_of(s.family)),
                          s.k);
  if (const auto* dashpots = changed.model.find<Dashpots>(); dashpots && !same(SceneNumber::dashpot)) {
    size_t of_grid = dashpots->list.size();  // dashpots of single springs come last
    std::vector<int> with_dashpot;
    for (int i = 0; file.has(fmt::format("spring[{}]", i)); ++i)
      if (file.has(fmt::format("spring[{}].dashpot", i))) with_dashpot.push_back(i);
    of_grid -= with_dashpot.size();
    for (size_t i = 0; i < dashpots->list.size(); ++i)
      values.emplace_back(i < of_grid ? "grid.dashpot" : fmt::format("spring[{}].dashpot", with_dashpot[i - of_grid]),
                          dashpots->list[i].c);
  }
  if (const auto* drag = changed.model.find<Drag>(); drag && !same(SceneNumber::drag)) {
    const bool rate = file.has("drag.gamma");
    for (int i = 0; i < particles.size(); ++i)
      if (!particles.pinned[i])
        values.emplace_back(rate ? "drag.gamma" : "drag.coefficient",
                            rate ? drag->c[i] / particles.mass[i] : drag->c[i]);
  }
  const auto add_frictions = [&](const auto* surfaces, std::string_view name) {
    for (size_t i = 0; surfaces && i < surfaces->list.size(); ++i) {
      const std::string one = fmt::format("{}[{}]", name, i);
      values.emplace_back(fmt::format("{}.friction", file.has(one) ? one : name), surfaces->list[i].friction);
    }
  };
  if (!same(SceneNumber::friction)) {
    add_frictions(changed.model.find<Spheres>(), Spheres::name);
    add_frictions(changed.model.find<Planes>(), Planes::name);
  }
  file.set(values);
  return file.text();
}

}  // namespace crosscheck
