// What can be compared after contact has made single positions unpredictable: centre of mass, clearance, creep.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/charts/charts.h"

namespace crosscheck {
namespace {

struct Quantity {
  const char* column;
  const char* name;
  const char* title;
  const char* label;
  double factor;  // from SI to the label's unit
  bool logarithmic;
  const char* finding;
  const char* tier;  // null: another engine
};

constexpr Quantity quantities[] = {
    {"difference from converged contact", "converged", "distance from the converged in-house contact rule",
     "RMS difference / mm", 1e3, true,
     "How far each method is from what the in-house contact rule converges to in the step. Other rules converge to "
     "something else: these are differences, no errors.",
     "what the in-house contact rule converges to in the step"},
    {"difference of centres", "centres", "distance of the centre of mass from mysim/symplectic-euler",
     "distance of centres / mm", 1e3, true, "How far the centres of mass of the engines are apart over time.", nullptr},
    {"clearance", "clearance", "smallest distance from the contact surface", "clearance / mm (negative: inside)", 1e3,
     false, "How far the lowest particle stays off the contact surface, or sinks into it.",
     "exact (zero where it touches), from each method's own positions"},
    {"creep", "creep", "mean sliding speed of the touching particles", "sliding speed / (mm/s)", 1e3, true,
     "How fast the touching particles slide, and whether they come to rest.",
     "another engine; exact where all must rest: zero"},
};

}  // namespace

std::vector<Chart> contact_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  for (size_t i = 0; i < input.scenes.size(); ++i) {
    const Scene& scene = input.scenes[i];
    const Table* table = input.result.table(scene.name + "-engines");
    if (!input.facts[i].touched() || !table) continue;
    for (const Quantity& q : quantities) {
      Figure f;
      f.name = scene.name + "-" + q.name;
      f.title = scene.name + ": " + q.title;
      f.caption = caption_of(scene, input.commit);
      f.tier = q.tier ? q.tier : "another engine, so that these are differences and no errors";
      f.finding = q.finding;
      f.x = {"t / s", false, 0.0, scene.duration};
      f.y = {q.label, q.logarithmic, std::nullopt, std::nullopt};
      for (const MethodFacts& m : input.facts[i].methods) {
        if (!m.ok()) continue;
        Curve curve{m.method, style_of(m.method), points_of(*table, m.method, q.column, q.logarithmic)};
        for (auto& point : curve.points) point.second *= q.factor;
        // while the cloth falls the clearance is large and of no interest
        if (std::string(q.column) == "clearance")
          std::erase_if(curve.points, [](const auto& p) { return p.second > 1; });
        if (!curve.points.empty()) f.curves.push_back(std::move(curve));
      }
      if (!f.curves.empty() && std::string(q.column) == "difference from converged contact") {
        const SceneFacts& facts = input.facts[i];
        f.x.high = *facts.contact_until;
        f.floor = {"what is left to converge", facts.bar * q.factor};
        f.tier +=
            fmt::format(", known until {:.3g} s to {} ({})", *facts.contact_until, nice_length(facts.bar), facts.truth);
      }
      // lines on zero are words, not a figure: what is nearest to the surface is said beside it
      const bool flat = std::ranges::all_of(f.curves, [](const Curve& c) {
        return std::ranges::all_of(c.points, [](const auto& p) { return std::abs(p.second) < 1e-9; });
      });
      if (!flat) charts.push_back({scene.name, std::move(f)});
    }
  }
  return charts;
}

}  // namespace crosscheck
