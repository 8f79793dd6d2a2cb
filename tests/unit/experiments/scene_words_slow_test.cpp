// The texts of scene files are true: every number in them is one of the scene's values or is computed here, and
// statements about growth are confirmed by measurements.

#include <numbers>
#include <regex>

#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "mysim/model/system.h"
#include "mysim/scene/toml.h"
#include "reference/truth/exact/exact.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/limits_of_motion.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr double degree = std::numbers::pi / 180;

double omega_of(const Scene& s) { return highest_frequency(s.model, s.start); }
double part_of_limit(const Scene& s) { return s.step * omega_of(s) / 2; }  // leapfrog's limit is 2 / omega

/// Height (m) to which the closed-form solution rises above its start.
double rise_of(const Scene& s) {
  const auto exact = exact_solution(s);
  double highest = 0;
  for (int i = 0; i <= 4000; ++i) highest = std::max(highest, exact->at(s.duration * i / 4000).x(1, 0));
  return highest - s.start.x(1, 0);
}

/// Angle (degrees from the top) at which the closed-form solution leaves the ball.
double leaving_angle(const Scene& s) {
  const auto exact = exact_solution(s);
  const Sphere& ball = s.model.find<Spheres>()->list.at(0);
  double angle = 0;
  for (int i = 0; i <= 20000; ++i) {
    const Vec3 off = exact->at(s.duration * i / 20000).x.col(0) - ball.centre;
    if (off.norm() > ball.contact_radius() * (1 + 1e-12)) break;  // beyond rounding
    angle = std::acos(off.y() / off.norm());
  }
  return angle / degree;
}

double growth_of_window(const Scene& s, double until) {
  return perturbation_growth(find_method("symplectic-euler"), s, s.step, until);
}
double growth_over_run(const Scene& s) { return growth_of_window(s, s.duration); }

/// Period (s) of a full swing, from the first and last passage below the anchor.
double swing_of(const Scene& s) {
  const Trajectory path =
      run_and_record("rk4", s, {s.step, s.duration, static_cast<int>(std::lround(s.duration / s.step))}).trajectory;
  std::vector<double> passages;
  for (int i = 1; i < path.frames(); ++i) {
    const double before = path.x[i - 1](0, 1) - path.x[i - 1](0, 0), after = path.x[i](0, 1) - path.x[i](0, 0);
    if (before * after < 0) passages.push_back(path.t[i - 1] + s.step * before / (before - after));
  }
  return 2 * (passages.back() - passages.front()) / static_cast<double>(passages.size() - 1);
}

/// Growth of a perturbation if only the two upper corners of the cloth are pinned.
double growth_at_two_corners(const Scene& s) {
  TomlDocument file(s.source, s.name);
  const std::vector<int>& pins = s.model.particles.pins;
  file.set("pins.particles", std::vector<int>{pins.front(), pins.back()});
  Scene corners = parse_scene(file.text(), s.name);
  // the measurement uses symplectic Euler, which would blow up at the scene's long step
  corners.step = std::min(corners.step, 1 / omega_of(corners));
  return perturbation_growth(find_method("symplectic-euler"), corners, corners.step, corners.duration);
}

/// Largest acceleration of the first sphere, m/s^2.
double largest_acceleration(const Scene& s) {
  const Sphere& ball = s.model.find<Spheres>()->list.at(0);
  const double dt = 1e-3;
  double largest = 0;
  for (double t = dt; t < s.duration; t += dt)
    largest = std::max(largest,
                       ((ball.centre_at(t + dt) - 2 * ball.centre_at(t) + ball.centre_at(t - dt)) / (dt * dt)).norm());
  return largest;
}

double first_touch(const Scene& s) {
  crosscheck::Run run = default_run(s);
  run.samples = static_cast<int>(std::lround(run.duration / 1e-2));
  return *first_contact(s, run_and_record("leapfrog", s, run).trajectory);
}

/// Ratio of the scene's step to the longest stable step of the given rule.
double times_shorter(const char* rule, const Scene& s) {
  return s.step / stepper(rule).limit(omega_of(s), *uniform_drag_rate(s.model));
}

/// A number claimed in the text of a scene: the words around it, with {} in place of the number, and its true value.
struct ClaimedNumber {
  const char* scene;
  const char* words;
  double (*value)(const Scene&);
};
const ClaimedNumber claims[] = {
    {"projectile", "is thrown at {} m/s", [](const Scene& s) { return s.start.v.col(0).norm(); }},
    {"projectile", "It rises {} m", rise_of},
    {"slide", "it flies off at {} degrees", leaving_angle},
    {"pendulum", "swings with a period of {} s", swing_of},
    {"pendulum", "({} s on a rigid rod",
     [](const Scene& s) { return rigid_pendulum_period(s.model.find<Springs>()->list[0].rest, 9.81, 60 * degree); }},
    {"pendulum", "released at {} degrees",
     [](const Scene& s) {
       const Vec3 off = s.start.x.col(1) - s.start.x.col(0);
       return std::acos(-off.y() / off.norm()) / degree;
     }},
    {"pendulum", "vibrates at {} rad/s", omega_of},
    {"pendulum", "h omega is {},", [](const Scene& s) { return s.step * omega_of(s); }},
    {"spring", "100 N/m: {} rad/s", omega_of},
    {"spring", "period {} s", [](const Scene& s) { return 2 * std::numbers::pi / omega_of(s); }},
    {"spring", "mass starts {} m above",
     [](const Scene& s) { return s.model.find<Springs>()->list[0].rest + s.start.x(1, 1) - s.start.x(1, 0); }},
    {"spring", "h omega = {}", [](const Scene& s) { return s.step * omega_of(s); }},
    {"normal-modes", "start with {} and 5 mm",
     // the difference between the initial displacements and the sines of the modes is zero
     [](const Scene& s) {
       double first = 0, left = 0;
       const double apart = (s.start.x(0, 9) - s.start.x(0, 0)) / 9;
       for (int i = 1; i <= 8; ++i) {
         const double off = s.start.x(0, i) - i * apart, place = std::numbers::pi * i / 9;
         first += off * std::sin(place) / 4.5;
         left = std::max(left, std::abs(off - 0.01 * std::sin(place) - 0.005 * std::sin(3 * place)));
       }
       return left < 1e-5 ? 1e3 * first : NAN;
     }},
    {"normal-modes", "and {} mm along",
     [](const Scene& s) {
       double third = 0;
       const double apart = (s.start.x(0, 9) - s.start.x(0, 0)) / 9;
       for (int i = 1; i <= 8; ++i)
         third += (s.start.x(0, i) - i * apart) * std::sin(3 * std::numbers::pi * i / 9) / 4.5;
       return 1e3 * third;
     }},
    {"bounce", "each impact: {}-fold in the first second", [](const Scene& s) { return growth_of_window(s, 1); }},
    {"cloth-hang", "s, {} of the limit 2 / omega_max", part_of_limit},
    {"cloth-small", "s, {} of the limit 2 / omega_max", part_of_limit},
    {"cloth-sphere", "s, {} of the limit 2 / omega_max", part_of_limit},
    {"cloth-sphere", "0.48 s, {} s after first contact", [](const Scene& s) { return s.window - first_touch(s); }},
    {"cloth-sphere", "until {} s after first contact", [](const Scene& s) { return s.window - first_touch(s); }},
    {"cloth-sphere", "After the first {} s of contact", [](const Scene& s) { return s.window - first_touch(s); }},
    {"cloth-sphere", "dropped {} m off the centre",
     [](const Scene& s) {
       const Vec3 off = centre_of_mass(s, s.start.x) - s.model.find<Spheres>()->list[0].centre;
       return std::hypot(off.x(), off.z());
     }},
    {"cloth-carried", "every {} s",
     [](const Scene& s) { return 1 / s.model.find<Spheres>()->list[0].motion->frequency; }},
    {"cloth-carried", "accelerates by {} m/s^2", largest_acceleration},
    {"cloth-carried", "can hold the cloth up to {} m/s^2",
     [](const Scene& s) { return s.model.find<Spheres>()->list[0].friction * 9.81; }},
    {"cloth-stiff", "steps of {} microseconds", [](const Scene& s) { return 1e6 * 2 / omega_of(s); }},
    {"cloth-stiff", "The step of 1/{} s", [](const Scene& s) { return 1 / s.step; }},
    {"cloth-stiff", "let go at {} degrees",
     [](const Scene& s) {
       const Vec3 down = s.start.x.col(s.start.x.cols() - 1) - s.start.x.col(9);
       return std::atan2(down.z(), -down.y()) / degree;
     }},
    {"cloth-inextensible", "released at {} degrees",
     [](const Scene& s) {
       const Vec3 down = s.start.x.col(s.start.x.cols() - 1) - s.start.x.col(7);
       return std::atan2(down.z(), -down.y()) / degree;
     }},
    {"cloth-cantilever", "{} kg/m^2, bending", [](const Scene& s) { return strip_of(s).weight / 9.81; }},
    {"cloth-cantilever", "w L^3 / B is {},",
     [](const Scene& s) {
       const ClampedStrip strip = strip_of(s);
       return strip.weight * std::pow(strip.length, 3) / strip.rigidity;
     }},
    {"cloth-cantilever", "elastica rests {} of its length",
     [](const Scene& s) { return Elastica(strip_of(s)).tip().drop / strip_of(s).length; }},
    {"cloth-student", "particles of {} kg", [](const Scene& s) { return s.model.particles.mass[9]; }},
    {"cloth-student", "wave turns by {} rad", [](const Scene& s) { return s.step * omega_of(s); }},
    {"cloth-student", "a step {} times shorter, and", [](const Scene& s) { return times_shorter("trapezoidal", s); }},
    {"cloth-student", "Euler a step {} times shorter",
     [](const Scene& s) { return times_shorter("explicit-euler", s); }},
    {"flag", "a wind of {} m/s", [](const Scene& s) { return s.model.find<Aerodynamics>()->velocity.mean.norm(); }},
    {"jelly", "dropped by {} m",
     [](const Scene& s) {
       double lowest = INFINITY;
       for (int i = 0; i < s.start.x.cols(); ++i)
         lowest = std::min(lowest, clearance_from(surfaces_of(s.model), 0, s.start.x.col(i)));
       return lowest;
     }},
    {"slope-slide", "upwards at {} m/s", [](const Scene& s) { return s.start.v.col(0).norm(); }},
    {"slope-slide", "a slope of {} degrees",
     [](const Scene& s) { return std::acos(s.model.find<Planes>()->list[0].normal.y()) / degree; }},
    {"floor-drop", "its lower edge {} m above", [](const Scene& s) { return clearance(s, 0, s.start.x).value(); }},
    {"floor-drop", "tilted by {} degrees",
     [](const Scene& s) {
       const Vec3 edge = s.start.x.col(19) - s.start.x.col(0);
       return std::atan2(edge.y(), edge.x()) / degree;
     }},
    {"cloth-wind", "varies by {} %",
     [](const Scene& s) { return 100 * s.model.find<Wind>()->acceleration.gusts->variation; }},
    // size of a picture; this claim is made in several scenes
    {"", "a picture of {} pixels", [](const Scene&) { return 1000.; }},
};

/// A statement that describes the growth of a perturbation in words.
struct Grows {
  const char* scene;
  const char* words;
  double (*growth)(const Scene&);
  double low, high;
};
const Grows grows[] = {
    {"cloth-carried", "grows less than a thousandfold over the whole run", growth_over_run, 100, 1000},
    {"cloth-sphere", "a perturbation grows about a hundredfold",
     [](const Scene& s) { return growth_of_window(s, s.window); }, 30, 300},
    {"cloth-stiff", "would grow more than a thousandfold", growth_at_two_corners, 1e3, 1e4},
    {"cloth-swing", "would grow ten thousandfold in 3 s", growth_at_two_corners, 3e3, 3e4},
    {"cloth-swing", "it grows less than a hundredfold", growth_over_run, 0, 100},
    {"cloth-wind", "would grow ten thousandfold in 3 s", growth_at_two_corners, 3e3, 3e4},
    {"cloth-wind", "it grows less than a hundredfold", growth_over_run, 0, 100},
    {"floor-drop", "the perturbation grows less than tenfold over the whole run", growth_over_run, 1, 10},
};

const std::vector<Scene>& all_scenes() {
  static const std::vector<Scene> scenes = [] {
    std::vector<Scene> list;
    for (const std::string_view name : shipped_scenes()) list.push_back(load_scene(std::string(name)));
    return list;
  }();
  return scenes;
}

/// The words of a scene file: its text about parameters, and its comments, each preceded by the value to which it
/// belongs.
std::string words_of(const Scene& s) {
  std::string words = TomlTable::parse_text(s.source, s.name).text("parameters") + "\n";
  std::istringstream in(s.source);
  for (std::string line; std::getline(in, line);)
    if (const size_t hash = line.find('#'); hash != std::string::npos && hash > 0 && line[0] != 'p') {
      const size_t value = line.find("= ");
      words +=
          (value < hash ? std::regex_replace(line.substr(value + 2, hash - value - 2), std::regex(" +$"), "") : "") +
          " " + line.substr(hash + 2) + "\n";
    }
  return words;
}

std::vector<double> values_of(const Scene& s) {
  std::string values;
  std::istringstream in(s.source);
  for (std::string line; std::getline(in, line);)
    if (line.find('"') == std::string::npos) values += line.substr(0, line.find('#')) + "\n";
  std::vector<double> all;
  static const std::regex number("\\b[0-9]+(\\.[0-9]+)?(e-?[0-9]+)?");
  for (auto at = std::sregex_iterator(values.begin(), values.end(), number); at != std::sregex_iterator(); ++at)
    all.push_back(std::stod(at->str()));
  return all;
}

/// Half a unit of the last significant digit of `number`.
double half_digit(const std::string& number) {
  const size_t point = number.find('.');
  if (point != std::string::npos) return 0.5 * std::pow(10, -static_cast<double>(number.size() - point - 1));
  return 0.5 * std::pow(10, static_cast<double>(number.size() - number.find_last_not_of('0') - 1));
}

/// Position and length of the claimed number in a text; nullopt if the text does not contain the claim.
std::optional<std::pair<size_t, size_t>> place_of(const ClaimedNumber& t, const std::string& text) {
  const std::string words = t.words, before = words.substr(0, words.find("{}")),
                    after = words.substr(before.size() + 2);
  for (size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
    const size_t from = at + before.size();
    size_t length = 0;
    while (from + length < text.size() && (std::isdigit(text[from + length]) || text[from + length] == '.')) ++length;
    for (; length > 0; --length)  // a trailing full stop is not part of the number
      if (text[from + length - 1] != '.' && text.compare(from + length, after.size(), after) == 0)
        return std::pair{from, length};
  }
  return std::nullopt;
}

TEST(SceneWords, EveryComputedNumberIsWhatTheSceneDoes) {
  for (const ClaimedNumber& claim : claims) {
    int found = 0;
    for (const Scene& s : all_scenes()) {
      if (*claim.scene && s.name != claim.scene) continue;
      const std::string text = words_of(s);
      const auto place = place_of(claim, text);
      if (!place) continue;
      ++found;
      const std::string number = text.substr(place->first, place->second);
      EXPECT_NEAR(std::stod(number), claim.value(s), 1.02 * half_digit(number)) << s.name << ": " << claim.words;
    }
    EXPECT_GT(found, 0) << "no scene says: " << claim.words;
  }
}

TEST(SceneWords, NoNumberIsLeftUnchecked) {
  static const std::regex number("\\b[0-9]+(\\.[0-9]+)?(e-?[0-9]+)?");
  for (const Scene& s : all_scenes()) {
    std::string text = words_of(s);
    for (const ClaimedNumber& claim : claims)
      if (!*claim.scene || s.name == claim.scene)
        if (const auto place = place_of(claim, text)) text.replace(place->first, place->second, place->second, ' ');
    text = std::regex_replace(text, std::regex("([0-9]) 000"), "$01000");
    // removes powers, units and parts of formulas
    text = std::regex_replace(text, std::regex("\\^[0-9]|1/s|10 Hz|1000 pixels|2 / omega|2 m/s\\^2 at|1/ "), " ");
    std::vector<double> values = values_of(s);
    for (const char* of : {"cloth-hang"})
      if (contains(text, of)) {
        const auto more = values_of(load_scene(of));
        values.insert(values.end(), more.begin(), more.end());
      }
    for (auto at = std::sregex_iterator(text.begin(), text.end(), number); at != std::sregex_iterator(); ++at) {
      const double claimed = std::stod(at->str());
      EXPECT_TRUE(std::any_of(values.begin(), values.end(),
                              [&](double v) { return std::abs(v - claimed) <= 1e-9 * std::abs(v); }))
          << s.name << " says " << at->str() << ", which is neither one of its values nor computed here: ..."
          << text.substr(std::max<long>(0, at->position() - 30), 60);
    }
  }
}

TEST(SceneWords, WhatGrowsGrowsAsIsSaid) {
  for (const Grows& g : grows) {
    const Scene s = load_scene(g.scene);
    EXPECT_TRUE(contains(words_of(s), g.words)) << g.scene << ": " << g.words;
    const double growth = g.growth(s);
    fmt::print("{}: {}: {:.3g}\n", g.scene, g.words, growth);
    EXPECT_GE(growth, g.low) << g.scene << ": " << g.words;
    EXPECT_LE(growth, g.high) << g.scene << ": " << g.words;
  }
  // no other text mentions growth in words
  for (const Scene& s : all_scenes()) {
    std::string text = words_of(s);
    for (const Grows& g : grows)
      if (const size_t at = s.name == g.scene ? text.find(g.words) : std::string::npos; at != std::string::npos)
        text.erase(at, std::string(g.words).size());
    EXPECT_FALSE(contains(text, "undredfold") || contains(text, "thousandfold") || contains(text, "millionfold"))
        << s.name;
  }
}

}  // namespace
}  // namespace crosscheck
