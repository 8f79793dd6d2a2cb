// Expected answers from polygons in equilibrium: half a chain of straight links, from the lowest joint to an end.
// Contains no formula of a curve.
#include <cmath>
#include <functional>

#include "tests/coursework/m1-misconceptions/cases.h"

namespace coursework::m1 {
namespace {

struct HalfChain {
  double width = 0, depth = 0;
};

/// Half a chain under its own weight. `across` is the horizontal pull, which is the same for all links. The vertical
/// pull of a link is half its own weight plus the weight of all links below.
HalfChain own_weight(int links, double length, double weight, double stiffness, double across) {
  HalfChain half;
  const double link = length / 2 / links;
  for (int i = 0; i < links; ++i) {
    const double up = weight * link * (i + 0.5), pull = std::hypot(across, up);
    const double stretched = link * (1 + pull / stiffness);
    half.width += stretched * across / pull, half.depth += stretched * up / pull;
  }
  return half;
}

/// Half a cable under a load that is uniform along the span. The load of a link is proportional to its width, which
/// depends on its slope: a few iterations converge.
HalfChain along_span(int links, double length, double across) {
  HalfChain half;
  const double link = length / 2 / links;
  double width = link;
  for (int i = 0; i < links; ++i) {
    double up = 0;
    for (int round = 0; round < 8; ++round) {
      up = half.width + width / 2;
      width = link * across / std::hypot(across, up);
    }
    half.width += width, half.depth += width * up / across;
  }
  return half;
}

/// Depth of the half chain whose width is half the span. Finds the pull by bisection, because the width increases with
/// it.
double depth_at(double span, double hardest, const std::function<HalfChain(double)>& pulled) {
  double low = 0, high = hardest;
  for (int i = 0; i < 60; ++i) {  // until the pull is accurate to 1e-16 of the weight
    const double middle = (low + high) / 2;
    (pulled(middle).width > span / 2 ? high : low) = middle;
  }
  return pulled(low).depth;
}

/// Extrapolated depth of the curve. A polygon's error is inversely proportional to the square of the number of links,
/// so that two polygons suffice for an error of 1e-10 of the length (at most 7e-11 on 300 seeds, compared with closed
/// forms).
double extrapolated(const std::function<double(int)>& depth) { return (4 * depth(400) - depth(200)) / 3; }

double own_weight_depth(double length, double span, double weight, double stiffness) {
  return extrapolated([&](int links) {
    return depth_at(span, 100 * weight * length,
                    [&](double across) { return own_weight(links, length, weight, stiffness, across); });
  });
}
double rigid_depth(double length, double span) { return own_weight_depth(length, span, 1, HUGE_VAL); }
double bridge_depth(double length, double span) {
  return extrapolated([&](int links) {
    return depth_at(span, 100 * length, [&](double across) { return along_span(links, length, across); });
  });
}

Case sag(const char* call, double right, Numbers in) {
  Case c{call, std::move(in), {right}, 1, 0, "chain", "sag"};
  // the hand-out asks for a billionth of the length; the polygons are ten times more accurate
  c.tolerance = 2e-9 * c.in[0];
  return c;
}

}  // namespace

std::vector<Case> catenaries(Random& random) {
  std::vector<Case> cases;
  for (const auto& [low, high] : {std::pair{1.1, 1.4}, std::pair{1.5, 2.5}}) {
    const double span = random.uniform(1, 9), length = span * random.uniform(low, high);
    cases.push_back(sag("sag.catenary", rigid_depth(length, span),
                        {length, span, bridge_depth(length, span), std::sqrt(length * length - span * span) / 2}));
  }
  return cases;
}

std::vector<Case> parabolas(Random& random) {
  std::vector<Case> cases;
  for (const auto& [low, high] : {std::pair{1.1, 1.4}, std::pair{1.5, 2.5}}) {
    const double span = random.uniform(1, 9), length = span * random.uniform(low, high);
    cases.push_back(sag("sag.parabola", bridge_depth(length, span), {length, span, rigid_depth(length, span)}));
  }
  return cases;
}

std::vector<Case> elastic_chains(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 2; ++i) {
    const double span = random.uniform(1, 9), length = span * random.uniform(1.1, 1.6), weight = random.uniform(2, 9);
    const double stiffness = weight * length * random.uniform(3, 9);
    cases.push_back(sag("sag.elastic", own_weight_depth(length, span, weight, stiffness),
                        {length, span, weight, stiffness, rigid_depth(length, span)}));
  }
  return cases;
}

}  // namespace coursework::m1
