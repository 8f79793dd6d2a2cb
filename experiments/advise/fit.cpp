#include "experiments/advise/fit.h"

#include <fmt/ranges.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "experiments/advise/advice.h"
#include "experiments/measures.h"
#include "mysim/base/errors.h"
#include "mysim/model/moduli.h"
#include "mysim/model/system.h"
#include "mysim/scene/toml.h"

namespace crosscheck {
namespace {

/// Kinds of parameters that can be fitted. `ending`: last keys of the parameter's path. `low`, `high`: search range, in
/// a unit derived from the scene: M / T^`times`, where T is a typical time, and M a typical mass (1 if `mass` is
/// false).
struct Kind {
  std::string_view ending, name, unit;
  double low, high;
  bool mass;
  int times;
};
constexpr Kind kinds[] = {
    {"stiffness", "stiffness", "N/m", 1e-1, 1e6, true, 2},
    {"stiffness.structural", "stiffness", "N/m", 1e-1, 1e6, true, 2},
    {"stiffness.shear", "stiffness", "N/m", 1e-1, 1e6, true, 2},
    {"stiffness.bend", "stiffness", "N/m", 1e-1, 1e6, true, 2},
    {"mass", "mass", "kg", 1e-6, 1e1, true, 0},
    {"drag.gamma", "drag rate", "1/s", 1e-2, 1e3, false, 1},
    {"drag.coefficient", "drag coefficient", "N s/m", 1e-4, 1e3, true, 1},
    {"dashpot", "dashpot", "N s/m", 1e-4, 1e3, true, 1},
};

const Kind* kind_of(std::string_view path) {
  for (const Kind& k : kinds)
    if (path == k.ending || path.ends_with(fmt::format(".{}", k.ending))) return &k;
  return nullptr;
}

using Measurement = std::function<std::optional<double>(const Scene&, MeasuredBy)>;
struct Objective {
  WishResult wished;
  Measurement measure;
};

/// Desired values of measures (experiments/measures.h): section [wish] of the scene file.
struct Wish {
  std::optional<double> sag, period, settle_time;  // m, s, s
  std::optional<double> max_stretch;               // 1
  std::optional<double> c11;                       // N/m of a sheet, Pa of a block (mysim/model/moduli.h)
  std::optional<double> anisotropy;                // 1; 1 is isotropic
};

Wish wish_of(const Scene& scene) {
  const TomlTable file = TomlTable::parse_text(scene.source, scene.name);
  if (!file.has("wish")) return {};
  const auto value = [s = file.section("wish")](const char* key) {
    return s.has(key) ? std::optional(s.positive(key)) : std::nullopt;
  };
  return {value("sag"), value("period"), value("settle_time"), value("max_stretch"), value("c11"), value("anisotropy")};
}

std::vector<Objective> objectives_of(const Scene& scene) {
  const Wish wish = wish_of(scene);
  std::vector<Objective> objectives;
  if (wish.sag)
    objectives.push_back({{"sag", "m", *wish.sag, 0}, [](const Scene& s, MeasuredBy) { return sag_of(s); }});
  if (wish.period)
    objectives.push_back({{"period", "s", *wish.period, 0},
                          [w = *wish.period](const Scene& s, MeasuredBy by) { return period_of(s, w, by); }});
  if (wish.settle_time)
    objectives.push_back({{"settle time", "s", *wish.settle_time, 0},
                          [w = *wish.settle_time](const Scene& s, MeasuredBy by) { return settle_time_of(s, w, by); }});
  if (wish.max_stretch) objectives.push_back({{"max stretch", "1", *wish.max_stretch, 0}, max_stretch_of});
  const auto of_moduli = [](auto number) {
    return [number](const Scene& s, MeasuredBy) -> std::optional<double> {
      const NetModuli net = moduli_of(s.model, s.start);
      if (!net.moduli) throw CannotGuarantee("the moduli of this scene are not known: " + net.why_not);
      return number(*net.moduli);
    };
  };
  if (wish.c11) {
    const NetModuli net = moduli_of(scene.model, scene.start);
    const std::string unit(unit_of_moduli(net.moduli ? net.moduli->dimension : 2));
    objectives.push_back({{"C11", unit, *wish.c11, 0}, of_moduli([](const Moduli& m) { return m.c11; })});
  }
  if (wish.anisotropy)
    objectives.push_back(
        {{"anisotropy", "1", *wish.anisotropy, 0}, of_moduli([](const Moduli& m) { return m.anisotropy(); })});
  return objectives;
}

class Fit {
 public:
  Fit(std::string_view text, const std::string& name) : name_(name), file_(text, name) {
    for (const std::string& path : file_.where("fit")) {
      const Kind* kind = kind_of(path);
      if (!kind)
        throw InputError(
            fmt::format("{}: {}: expected a value; only stiffness, mass, drag and dashpot can be fitted", name, path));
      // anisotropy depends on the ratio of the stiffnesses of spring families, so each family needs a value of its own
      const std::string family = path.substr(path.rfind('.') + 1),
                        name_of_value = file_.has("wish.anisotropy") && kind->ending.starts_with("stiffness.")
                                            ? fmt::format("{} stiffness", family)
                                            : std::string(kind->name);
      auto known = std::ranges::find(unknowns_, name_of_value, &Unknown::name);
      if (known == unknowns_.end()) {
        known = unknowns_.insert(known, Unknown{name_of_value, std::string(kind->unit), {}, 0});
        kinds_.push_back(kind);
      }
      known->paths.push_back(path);
    }
    // provisional values, because the wishes can only be read from a complete scene
    units_ = Eigen::VectorXd::Ones(size());
    Eigen::VectorXd middle = Eigen::VectorXd::Zero(size());
    set_units(scene_at(middle));
    for (int i = 0; i < size(); ++i) middle[i] = 0.5 * std::log(kinds_[i]->low * kinds_[i]->high);
    objectives_ = objectives_of(scene_at(middle));
    if (std::ssize(objectives_) != size()) {
      std::vector<std::string> names;
      for (const Unknown& u : unknowns_) names.push_back(u.name);
      throw InputError(fmt::format(
          "{}: wish: expected as many wishes (sag, period, settle_time, max_stretch, c11, anisotropy) as there "
          "are values to fit ({}: {}), got {}",
          name, size(), fmt::join(names, ", "), objectives_.size()));
    }
  }

  FitResult run() {
    Eigen::VectorXd p = coarse();
    Eigen::VectorXd r = residual(p, MeasuredBy::converged_runs).value_or(Eigen::VectorXd::Constant(size(), INFINITY));
    for (int i = 0; i < 30 && r.lpNorm<Eigen::Infinity>() > 2e-4; ++i) {
      const auto next = better(p, r);
      if (!next) break;
      std::tie(p, r) = *next;
    }
    for (int i = 0; i < size(); ++i) {
      unknowns_[i].value = units_[i] * std::exp(p[i]);
      objectives_[i].wished.reached = objectives_[i].wished.wished * std::exp(r[i]);
      if (!(std::abs(std::expm1(r[i])) <= 0.02))
        throw CannotGuarantee(fmt::format("{} = {:.4g} {} cannot be reached: the nearest is {:.4g}",
                                          objectives_[i].wished.name, objectives_[i].wished.wished, unit_of(i),
                                          objectives_[i].wished.reached));
    }
    FitResult fitted{scene_at(p), "", unknowns_, {}};
    TomlDocument file = file_at(p);
    const double omega = highest_frequency(fitted.scene.model, fitted.scene.start);
    Scene written = fitted.scene;
    if (omega > 0) written.step = std::min(written.step, 1 / omega);
    fitted.wishes = keep_wishes(fitted.scene, written);
    if (written.step != fitted.scene.step) file.set("time.step", written.step);
    fitted.toml = fmt::format("# Fitted by crosscheck to the wishes of the scene.\n{}", file.text());
    fitted.scene = parse_scene(fitted.toml, name_);
    return fitted;
  }

 private:
  int size() const { return static_cast<int>(unknowns_.size()); }
  std::string unit_of(int i) const { return objectives_[i].wished.unit == "1" ? "" : objectives_[i].wished.unit; }

  TomlDocument file_at(const Eigen::VectorXd& p) const {
    TomlDocument file(file_.text(), name_);
    for (int i = 0; i < size(); ++i)
      for (const std::string& path : unknowns_[i].paths) file.set(path, units_[i] * std::exp(p[i]));
    return file;
  }
  Scene scene_at(const Eigen::VectorXd& p) const { return parse_scene(file_at(p).text(), name_); }

  /// Sets the unit of each kind's range. The unit of time is the first of these that exists: the wished time, the time
  /// of a fall over the scene's size, the duration. The unit of mass is the mean over the particles or, if masses are
  /// fitted, a known stiffness times the unit of time squared.
  void set_units(const Scene& scene) {
    const auto* gravity = scene.model.find<Gravity>();
    const auto* springs = scene.model.find<Springs>();
    const double g = gravity ? gravity->acceleration.norm() : 0;
    const Wish wish = wish_of(scene);
    const double time =
        wish.period.value_or(wish.settle_time.value_or(g > 0 ? std::sqrt(scene.size() / g) : scene.duration));
    const auto is_fitted = [&](std::string_view kind) {
      return std::ranges::any_of(kinds_, [&](const Kind* k) { return k->name == kind; });
    };
    double mass = scene.model.particles.mass.mean();
    if (is_fitted("mass")) mass = springs && !is_fitted("stiffness") ? springs->list[0].k * time * time : 1;
    for (int i = 0; i < size(); ++i) {
      units_[i] = kinds_[i]->mass ? mass : 1;
      for (int power = 0; power < kinds_[i]->times; ++power) units_[i] /= time;
    }
  }

  /// log(measured / wished) of each wish; nullopt if a wish cannot be measured.
  std::optional<Eigen::VectorXd> residual(const Eigen::VectorXd& p, MeasuredBy by) const {
    const Scene scene = scene_at(p);
    Eigen::VectorXd r(size());
    for (int i = 0; i < size(); ++i) {
      const auto measured = objectives_[i].measure(scene, by);
      if (!measured || !(*measured > 0)) return std::nullopt;
      r[i] = std::log(*measured / objectives_[i].wished.wished);
    }
    return r;
  }

  /// The best point of a grid with one value per decade, or one per two decades for several unknowns. For a single
  /// unknown, chooses the first decade in which the measure passes the wished value, because a very small and a very
  /// large drag may give the same settling time.
  Eigen::VectorXd coarse() const {
    const double pace = std::log(size() == 1 ? 10. : 100.);
    std::optional<Eigen::VectorXd> best;
    std::optional<double> before;
    bool found = false;
    double least = INFINITY;
    Eigen::VectorXd p(size());
    const std::function<void(int)> over = [&](int i) {
      if (i == size()) {
        const auto r = found ? std::nullopt : residual(p, MeasuredBy::one_run);
        if (r && r->norm() < least) best = p, least = r->norm();
        if (r && size() == 1) {
          if (before && *before * (*r)[0] < 0) {
            found = true;
            best = std::abs(*before) < std::abs((*r)[0]) ? Eigen::VectorXd(p.array() - pace) : p;
          }
          before = (*r)[0];
        }
        return;
      }
      for (double x = std::log(kinds_[i]->low); x <= std::log(kinds_[i]->high) + 1e-9; x += pace) p[i] = x, over(i + 1);
    };
    over(0);
    if (!best) {
      std::vector<std::string> names;
      for (const Objective& objective : objectives_) names.push_back(objective.wished.name);
      throw CannotGuarantee(
          fmt::format("{} cannot be measured in this scene for any parameters: it does not oscillate, "
                      "or has no state of rest (hard distances, spheres, gusts, moving pins, no pins)",
                      fmt::join(names, ", ")));
    }
    return *best;
  }

  /// A damped Gauss-Newton step that reduces the residual, or nullopt if no such step is found.
  std::optional<std::pair<Eigen::VectorXd, Eigen::VectorXd>> better(const Eigen::VectorXd& p,
                                                                    const Eigen::VectorXd& r) const {
    constexpr double nudge = 0.02;  // larger than the noise of the measures
    Eigen::MatrixXd slope(size(), size());
    for (int j = 0; j < size(); ++j) {
      Eigen::VectorXd moved = p;
      moved[j] += nudge;
      const auto there = residual(moved, MeasuredBy::converged_runs);
      if (!there) return std::nullopt;
      slope.col(j) = (*there - r) / nudge;
    }
    Eigen::VectorXd step = slope.completeOrthogonalDecomposition().solve(-r);
    constexpr double longest = 2.3;
    if (step.norm() > longest) step *= longest / step.norm();
    for (int halvings = 0; halvings < 8; ++halvings, step /= 2)
      if (const auto there = residual(p + step, MeasuredBy::converged_runs); there && there->norm() < r.norm())
        return std::pair(Eigen::VectorXd(p + step), *there);
    return std::nullopt;
  }

  std::string name_;
  TomlDocument file_;
  std::vector<Unknown> unknowns_;
  std::vector<const Kind*> kinds_;
  Eigen::VectorXd units_;  // value of an unknown = its unit times exp(parameter)
  std::vector<Objective> objectives_;
};

}  // namespace

std::vector<WishResult> keep_wishes(const Scene& scene, Scene& file) {
  std::vector<WishResult> wishes;
  std::vector<Measurement> measures;
  for (const Objective& objective : objectives_of(scene))
    if (const auto reached = objective.measure(scene, MeasuredBy::converged_runs)) {
      wishes.push_back(objective.wished);
      wishes.back().reached = *reached;
      measures.push_back(objective.measure);
    }
  const Scene given = file;
  const bool follows_step = !find_method(file.method).adaptive;
  constexpr int most_halvings = 10;  // enough to reduce a first-order error a thousandfold
  for (int i = 0;; ++i) {
    bool kept = true;
    for (size_t w = 0; w < wishes.size(); ++w) {
      wishes[w].own = measures[w](file, MeasuredBy::own_method).value_or(NAN);
      kept = kept && wishes[w].kept();
    }
    if (kept) return wishes;
    if (!follows_step || i == most_halvings) break;
    file.step = time_grid(default_run(file)).h / 2;
  }
  if (follows_step) {  // shorter steps do not help: restores the given step
    file.step = given.step;
    for (size_t w = 0; w < wishes.size(); ++w) wishes[w].own = measures[w](file, MeasuredBy::own_method).value_or(NAN);
  }
  return wishes;
}

bool has_unknowns(std::string_view text, const std::string& name) {
  return !TomlDocument(text, name).where("fit").empty();
}

FitResult fit_to_wishes(std::string_view text, const std::string& name) { return Fit(text, name).run(); }

}  // namespace crosscheck
