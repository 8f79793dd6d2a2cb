// Recovers, from the answers of a student's implicit step, the equation that this step solves. For motion along a line,
// each term is a number, and mass times change of velocity is a linear combination of the terms.
#include <cmath>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/fit.h"

namespace coursework::a5 {
namespace {

constexpr double near_one = 1e-6;  // coefficients are simple numbers, known to 1e-9 from answers of fifteen digits
constexpr int probes = 16;         // at least twice the number of terms

struct Pair {
  double h, drag, gravity, k, rest, mass[2], x[2], v[2];
  bool fixed[2];

  Case asked() const {
    Case c{"implicit_euler.all", {2, 1, h, drag, gravity, 0, 0, 1, 0, 1, k, rest}, {}, 6};
    const auto add = [&](double a, double b) { c.in.push_back(a), c.in.push_back(b); };
    add(mass[0], mass[1]), add(fixed[0], fixed[1]);
    for (const auto* vectors : {x, v})
      for (int i = 0; i < 2; ++i) c.in.insert(c.in.end(), {vectors[i], 0, 0});
    return c;
  }
};

/// Two particles on a spring along the x axis.
Pair random_pair(Random& random, bool first_fixed) {
  Pair p{random.uniform(0.1, 0.5),    random.uniform(0.5, 2),
         random.uniform(2, 9),        random.uniform(5, 20),
         random.uniform(0.5, 1),      {random.uniform(1, 2), random.uniform(1, 2)},
         {0, random.uniform(1.2, 2)}, {first_fixed ? 0 : random.uniform(-2, 2), random.uniform(-2, 2)},
         {first_fixed, false}};
  return p;
}

struct Read {
  std::vector<NamedTerm> terms;
  Numbers right, found;
};

/// Writes m dv of particle `i` as a linear combination of terms. `found` is empty if there is no such combination.
Read read_off(const std::vector<Pair>& pairs, const std::vector<Answer>& answers, int i, bool beside_fixed) {
  Read read{{{"h m g"}, {"h c v"}, {"h c dv"}, {"h k e"}, {"h^2 k v"}, {"h^2 k dv"}}, {1, -1, -1, -1, -1, -1}, {}};
  if (!beside_fixed) {
    read.terms.push_back({"h^2 k v_other"}), read.terms.push_back({"h^2 k dv_other"});
    read.right.insert(read.right.end(), {1, 1});
  }
  std::vector<Numbers> columns(read.terms.size());
  Numbers sum;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const Pair& p = pairs[n];
    const int j = 1 - i;
    const auto velocity = [&](int of) { return answers[n].got[static_cast<std::size_t>(6 * of + 3)]; };
    const double dv = velocity(i) - p.v[i], dv_other = velocity(j) - p.v[j], k = p.h * p.h * p.k;
    // positive if the spring pulls the particle back
    const double e = (p.x[1] - p.x[0] - p.rest) * (i == 1 ? 1 : -1);
    const double terms[] = {p.h * p.mass[i] * p.gravity,
                            p.h * p.drag * p.v[i],
                            p.h * p.drag * dv,
                            p.h * p.k * e,
                            k * p.v[i],
                            k * dv,
                            k * p.v[j],
                            k * dv_other};
    for (std::size_t t = 0; t < columns.size(); ++t) columns[t].push_back(terms[t]);
    sum.push_back(p.mass[i] * dv);
  }
  read.found = coefficients(columns, sum, 1e-9);
  return read;
}

bool alike(const Numbers& a, const Numbers& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) < near_one)) return false;
  return true;
}

}  // namespace

Looked equation_text(const Texts& common, const std::string& part, const Ask& student) {
  if (part != "implicit_euler") return {};
  for (const bool beside_fixed : {true, false}) {
    Random random(7);
    std::vector<Pair> pairs;
    std::vector<Case> cases;
    for (int i = 0; i < probes; ++i)
      pairs.push_back(random_pair(random, beside_fixed)), cases.push_back(pairs[i].asked());
    const std::vector<Answer> answers = student(cases);
    for (const Answer& answer : answers) {
      if (answer.how != How::answered || answer.got.size() != 12) return {};
      for (const double value : answer.got)
        if (!std::isfinite(value)) return {};
    }
    for (int i = beside_fixed ? 1 : 0; i < 2; ++i) {
      const Read read = read_off(pairs, answers, i, beside_fixed);
      if (read.found.empty()) continue;
      if (!alike(read.found, read.right))
        return {common.fill(beside_fixed ? "equation.fixed"
                            : i == 0     ? "equation.a"
                                         : "equation.b",
                            sum_text(read.terms, read.found, near_one), sum_text(read.terms, read.right, near_one)),
                true};
      // the position may be wrong although the velocity is right
      std::vector<Numbers> columns(3);
      Numbers moved;
      for (std::size_t n = 0; n < pairs.size(); ++n) {
        const Pair& p = pairs[n];
        const double now = answers[n].got[static_cast<std::size_t>(6 * i + 3)];
        columns[0].push_back(p.x[i]), columns[1].push_back(p.h * p.v[i]), columns[2].push_back(p.h * (now - p.v[i]));
        moved.push_back(answers[n].got[static_cast<std::size_t>(6 * i)]);
      }
      if (const Numbers found = coefficients(columns, moved, 1e-9); !found.empty() && !alike(found, {1, 1, 1}))
        return {common.fill("equation.position", sum_text({{"x"}, {"h v"}, {"h dv"}}, found, near_one),
                            sum_text({{"x"}, {"h v"}, {"h dv"}}, {1, 1, 1}, near_one)),
                true};
    }
  }
  return {};
}

}  // namespace coursework::a5
