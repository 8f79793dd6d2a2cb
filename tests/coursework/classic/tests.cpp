// Tests of the classic assignment's parts, the expected features, and the analysis that recovers a stepper's formula
// from a step of a linear system.
#include <array>
#include <cmath>
#include <complex>

#include "tests/coursework/check/words.h"
#include "tests/coursework/classic/looks.h"
#include "tests/coursework/classic/whole_program.h"
#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/fit.h"

namespace coursework {
namespace classic {
std::string measured_text(const Texts& common, const std::string& part, const Ask& student);  // measured.cpp
}  // namespace classic
namespace {

// the student's process returns only answers of evalF; questions and conclusions are computed here
using classic::features;

constexpr Part parts[] = {
    {"euler", "euler.title"},   {"trapezoidal", "trapezoidal.title"},
    {"simple", "simple.title"}, {"pendulum", "pendulum.title"},
    {"cloth", "cloth.title"},
};

double single(double value) { return static_cast<double>(static_cast<float>(value)); }

/// x_i' = A x_i + q (x x, y y, z z) + c x_(i+1), as probe/own.h computes it.
struct Own {
  double h, q, c;
  std::array<double, 9> a;
  Numbers state;

  Numbers f(const Numbers& s) const {
    Numbers out;
    for (std::size_t i = 0; i < s.size(); i += 3)
      for (std::size_t k = 0; k < 3; ++k)
        out.push_back(a[3 * k] * s[i] + a[3 * k + 1] * s[i + 1] + a[3 * k + 2] * s[i + 2] + q * s[i + k] * s[i + k] +
                      c * s[(i + 3 + k) % s.size()]);
    return out;
  }
  Numbers in(int steps) const {
    Numbers in = {h, static_cast<double>(steps)};
    in.insert(in.end(), a.begin(), a.end());
    in.insert(in.end(), {q, c});
    in.insert(in.end(), state.begin(), state.end());
    return in;
  }
};

Own draw(Random& random, double q) {
  Own own{single(random.uniform(0.1, 0.3)), single(q), single(random.uniform(0.4, 1.2)), {}, {}};
  for (double& a : own.a) a = single(random.uniform(-1.5, 1.5));
  const int vectors = random.integer(2, 5);  // at least two, so that one vector acts on another
  for (int i = 0; i < 3 * vectors; ++i) own.state.push_back(single(random.uniform(-1.5, 1.5)));
  return own;
}

Numbers moved(const Numbers& x, double h, const Numbers& f) {
  Numbers out = x;
  for (std::size_t i = 0; i < x.size(); ++i) out[i] += h * f[i];
  return out;
}

template <bool trapezoidal>
constexpr const char* path_of = trapezoidal ? "trapezoidal.path" : "euler.path";

/// A step of a linear system is x + h A x, plus h^2/2 A A x for the trapezoidal rule. The midpoint rule, for example,
/// has the same polynomial; a system with squares tells such rules apart.
template <bool trapezoidal>
std::vector<Case> step(Random& random) {
  std::vector<Case> cases;
  for (const double q : {0.0, random.uniform(0.4, 0.8)}) {
    const Own own = draw(random, q);
    const Numbers f0 = own.f(own.state), ahead = moved(own.state, own.h, f0);
    const Numbers half = moved(own.state, own.h / 2, f0);
    // about twenty roundings, each 6e-8 of numbers below 10, cause errors of 1e-5; the nearest wrong rule differs by
    // 1e-2
    cases.push_back({path_of<trapezoidal>, own.in(1), trapezoidal ? moved(half, own.h / 2, own.f(ahead)) : ahead, 3,
                     3e-5, "vector", "vector"});
  }
  return cases;
}

/// On the circle each step multiplies x + i y by 1 + i w h, or by 1 + i w h - (w h)^2 / 2.
template <bool trapezoidal>
std::vector<Case> circle(Random& random) {
  const double h = single(random.uniform(0.1, 0.2)), w = single(random.uniform(0.8, 1.6));
  const int steps = random.integer(30, 50);
  Own own{h, 0, 0, {0, -w, 0, w, 0, 0, 0, 0, 0}, {}};
  for (int k = 0; k < 3; ++k) own.state.push_back(single(random.uniform(0.5, 1.2)));
  const std::complex<double> i(0, 1);
  const std::complex<double> factor = 1.0 + i * w * h - (trapezoidal ? w * w * h * h / 2 : 0.0);
  std::complex<double> z(own.state[0], own.state[1]);
  Numbers expected;
  for (int n = 0; n < steps; ++n) {
    z *= factor;
    expected.insert(expected.end(), {z.real(), z.imag(), own.state[2]});
  }
  // fifty steps of a few roundings each; a rounding is 6e-8 of a radius below 10
  return {{path_of<trapezoidal>, own.in(steps), expected, 3, 2e-4, "step", "vector", 0, 1, h}};
}

/// (x, y, z) becomes (-y, x, 0) without any rounding; 1e-6 permits a multiplication by one.
template <bool same>
std::vector<Case> field(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 3; ++i) {
    Numbers in;
    for (int k = 0; k < 6; ++k) in.push_back(single(random.uniform(-2, 2)));
    if (same) std::copy(in.begin(), in.begin() + 3, in.begin() + 3);
    cases.push_back({"field", in, {-in[1], in[0], 0}, 3, 1e-6, "vector", "vector"});
  }
  return cases;
}

constexpr int pendulum = 2, chain = 4, side = 8;

/// Case of one probe, whose features are compared: shares are counts and signs are exact, so 0.01 only covers rounding.
Case probe(const std::string& call, const std::string& column, Random& random, Numbers expected,
           double tolerance = 0.01) {
  const int columns = static_cast<int>(expected.size());
  const int count = call.starts_with("pendulum") ? pendulum : call.starts_with("chain") ? chain : side;
  return {call,
          {static_cast<double>(count), static_cast<double>(random.integer(1, 1000000))},
          std::move(expected),
          columns,
          tolerance,
          "",
          column};
}

std::vector<Case> pendulum_purity(Random& r) { return {probe("pendulum.purity", "purity", r, {1, 1, 1, 1})}; }
std::vector<Case> pendulum_motion(Random& r) { return {probe("pendulum.motion", "motion", r, {1, 1, 1, 1})}; }
std::vector<Case> pendulum_gravity(Random& r) { return {probe("pendulum.gravity", "gravity", r, {1, 1})}; }
std::vector<Case> pendulum_drag(Random& r) { return {probe("pendulum.drag", "drag", r, {1, 1})}; }
std::vector<Case> pendulum_springs(Random& r) { return {probe("pendulum.springs", "law", r, {1, 1, 1, 1, 1})}; }
std::vector<Case> chain_shape(Random& r) {
  return {probe("chain.kept", "purity", r, {1, 1, 1, 1}), probe("chain.motion", "motion", r, {1, 1, 1, 1})};
}
std::vector<Case> chain_forces(Random& r) {
  return {probe("chain.gravity", "gravity", r, {1, 1}), probe("chain.drag", "drag", r, {1, 1})};
}
std::vector<Case> chain_links(Random& r) { return {probe("chain.springs", "links", r, {1, 0, 1})}; }
std::vector<Case> chain_law(Random& r) { return {probe("chain.springs", "law", r, {1, 1, 1, 1, 1})}; }
std::vector<Case> cloth_purity(Random& r) { return {probe("cloth.kept", "purity", r, {1, 1, 1, 1})}; }
std::vector<Case> cloth_motion(Random& r) { return {probe("cloth.motion", "cloth_motion", r, {1, 1})}; }
std::vector<Case> cloth_forces(Random& r) {
  return {probe("cloth.gravity", "gravity", r, {1, 1}), probe("cloth.drag", "drag", r, {1, 1})};
}
std::vector<Case> cloth_structural(Random& r) { return {probe("cloth.springs", "structural", r, {1, 1, 0, 0})}; }
std::vector<Case> cloth_shear(Random& r) { return {probe("cloth.springs", "shear", r, {1, 1, 0, 0})}; }
std::vector<Case> cloth_flexion(Random& r) { return {probe("cloth.springs", "flexion", r, {1, 1, 0, 0})}; }
std::vector<Case> cloth_others(Random& r) { return {probe("cloth.springs", "others", r, {1, 0, 1})}; }
std::vector<Case> cloth_law(Random& r) { return {probe("cloth.springs", "law", r, {1, 1, 1, 1, 1})}; }
std::vector<Case> cloth_lengths(Random& r) {
  // Accepts 1.41 instead of sqrt 2 (difference 0.004), and rejects shear springs that are wrong by 1 % (0.014).
  // Rounding errors of stiff springs are below 0.001.
  return {probe("cloth.springs", "lengths", r, {std::sqrt(2.0), 2, 2}, 0.007)};
}
std::vector<Case> cloth_pins(Random& r) { return {probe("cloth.springs", "pins", r, {1, 1, 1})}; }

const Test tests[] = {
    {"1.1", "euler", 3, 2, {"explicit Euler"}, "Forward Euler", step<false>},
    {"1.2", "euler", 2, 1, {"explicit Euler", "growth"}, "Forward Euler", circle<false>},
    {"2.1", "trapezoidal", 3, 2, {"trapezoidal rule"}, "The trapezoidal rule", step<true>},
    {"2.2", "trapezoidal", 2, 1, {"trapezoidal rule", "growth"}, "The trapezoidal rule", circle<true>},
    {"3.1", "simple", 1, 1, {"ODE"}, "The simple system", field<true>},
    {"3.2", "simple", 1, 1, {"state"}, "The state that evalF is given", field<false>},
    {"4.1", "pendulum", 3, 2, {"state"}, "The state that evalF is given", pendulum_purity, features},
    {"4.2",
     "pendulum",
     2,
     1,
     {"first-order form", "constraint"},
     "Second order as first order",
     pendulum_motion,
     features},
    {"4.3", "pendulum", 2, 2, {"gravity"}, "Gravity and drag", pendulum_gravity, features},
    {"4.4", "pendulum", 2, 2, {"drag"}, "Gravity and drag", pendulum_drag, features},
    {"4.5", "pendulum", 2, 2, {"springs"}, "Springs", pendulum_springs, features},
    {"4.6", "pendulum", 3, 2, {"state", "first-order form"}, "The chain", chain_shape, features},
    {"4.7", "pendulum", 3, 2, {"gravity", "drag"}, "Gravity and drag", chain_forces, features},
    {"4.8", "pendulum", 3, 2, {"springs", "connectivity"}, "The chain", chain_links, features},
    {"4.9", "pendulum", 3, 2, {"springs", "third law"}, "Springs", chain_law, features},
    {"5.1", "cloth", 3, 2, {"state"}, "The state that evalF is given", cloth_purity, features},
    {"5.2", "cloth", 2, 1, {"first-order form"}, "The cloth", cloth_motion, features},
    {"5.3", "cloth", 3, 2, {"gravity", "drag"}, "Gravity and drag", cloth_forces, features},
    {"5.4", "cloth", 3, 2, {"structural springs"}, "Three families of springs", cloth_structural, features},
    {"5.5", "cloth", 3, 2, {"shear springs"}, "Three families of springs", cloth_shear, features},
    {"5.6", "cloth", 3, 2, {"flexion springs"}, "Three families of springs", cloth_flexion, features},
    {"5.7", "cloth", 2, 1, {"connectivity"}, "Three families of springs", cloth_others, features},
    {"5.8", "cloth", 2, 2, {"springs", "third law"}, "Springs", cloth_law, features},
    {"5.9", "cloth", 2, 1, {"rest lengths"}, "Three families of springs", cloth_lengths, features},
    {"5.10", "cloth", 1, 1, {"constraint"}, "Hanging it up", cloth_pins, features},
};

/// Reports the terms of a stepper's formula. In a whole program only the resulting state is visible, in single
/// precision.
Looked look(const Texts& common, const std::string& part, const Ask& student) {
  if (part != "euler" && part != "trapezoidal") return {};
  Random random(31);
  // three step sizes, so that the terms differ in their power of h, and h^2 is no linear combination of h and 1
  std::vector<Case> cases;
  std::vector<Numbers> columns(5);
  Own own{0, 0, 0.75, {}, Numbers(12)};
  for (double& a : own.a) a = single(random.uniform(-1.5, 1.5));
  for (const double h : {0.25, 0.5, 0.875}) {
    own.h = h;
    for (double& x : own.state) x = single(random.uniform(-1.5, 1.5));
    const Numbers slope = own.f(own.state), bend = own.f(slope);
    // the last two terms stand for a missing and a surplus factor h
    const std::pair<double, const Numbers&> all[] = {
        {1, own.state}, {h, slope}, {h * h, bend}, {1, slope}, {h * h, slope}};
    for (std::size_t k = 0; k < 5; ++k)
      for (const double value : all[k].second) columns[k].push_back(all[k].first * value);
    cases.push_back({part + ".path", own.in(1), {}, 3});
  }
  cases.push_back(cases.front());
  cases.back().call = part + ".calls";
  std::vector<Answer> answers = student(cases);
  const Answer calls = answers.back();
  answers.pop_back();
  Numbers result;
  for (const Answer& answer : answers) {
    if (answer.how != How::answered || answer.got.size() != 12) return {};
    result.insert(result.end(), answer.got.begin(), answer.got.end());
  }
  const Numbers right{1, 1, part == "trapezoidal" ? 0.5 : 0, 0, 0}, asked{part == "trapezoidal" ? 2.0 : 1.0};
  std::string often;
  if (calls.how == How::answered && calls.got.size() == 1 && calls.got != asked)
    often = common.fill("rule.calls", with_digits(asked[0], 3), with_digits(calls.got[0], 3));
  const std::vector<NamedTerm> terms{{"x"}, {"h f(x)"}, {"h^2 f(f(x))"}, {"f(x)"}, {"h^2 f(x)"}};
  // a step has about twenty rounding errors, each 6e-8 of numbers below 10
  constexpr double rounding = 3e-5, known = 1e-3;
  Numbers found = coefficients(columns, result, rounding);
  if (found.empty()) return {often, !often.empty()};
  for (double& value : found)
    if (std::abs(value) < known) value = 0;
  bool same = true;
  for (std::size_t k = 0; k < 5; ++k) same = same && std::abs(found[k] - right[k]) < known;
  if (same) return {common.of("rule.right_linear"), false};
  const std::string rule = common.fill("rule.linear", sum_text(terms, found, known), sum_text(terms, right, known));
  return {often.empty() ? rule : rule + " " + often, true};
}

}  // namespace

const Assignment& classic_particles() {
  static const Assignment all{"classic",
                              "Particle systems, in the interface of the classic course",
                              parts,
                              tests,
                              classic::whole_builder,
                              classic::role_names(),
                              look,
                              classic::measured_text,
                              classic::shown};
  return all;
}

}  // namespace coursework
