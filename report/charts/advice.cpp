// Error against cost of the runs of a search.
#include "report/charts/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/facts.h"

namespace crosscheck {

Figure advice_figure(const Advice& a, const std::string& commit) {
  Figure f;
  f.name = a.scene.name + "-advice";
  f.title = fmt::format("{}: error against cost of everything tried", a.scene.name);
  f.x = {"force evaluations × springs", true, std::nullopt, std::nullopt};
  f.y = {a.of_contact_rule ? "largest RMS difference / m" : "largest RMS error / m", true, std::nullopt, std::nullopt};
  double highest = a.tolerance;
  for (const Trial& t : a.trials)
    if (t.error && *t.error > a.bar) highest = std::max(highest, *t.error);
  for (const Trial& t : a.trials) {
    if (t.outcome.verdict == Verdict::unsupported || t.outcome.evaluations == 0) continue;
    const bool full = t.model == "full";
    const std::string title = t.method.substr(t.method.starts_with("mysim/") ? 6 : 0) + (full ? "" : ", least model");
    MethodStyle style = style_of(t.method);
    if (!full) style.dash = "(1,3)", style.marker = 6;
    if (!t.error) {
      f.failures.push_back(
          {title + ": " + failure_word(std::string(name_of(t.outcome.verdict))), style, t.cost(), 3 * highest});
      continue;
    }
    if (!(*t.error > a.bar)) continue;  // below its bar the truth tells nothing
    auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == title; });
    if (curve == f.curves.end()) curve = f.curves.insert(f.curves.end(), {title, style, {}, true, true});
    curve->points.emplace_back(t.cost(), *t.error);
  }
  for (Curve& c : f.curves) std::sort(c.points.begin(), c.points.end());
  const Trial& chosen = a.trials[a.chosen];
  double lowest = *chosen.error;
  for (const Curve& c : f.curves)
    for (const auto& [x, y] : c.points) lowest = std::min(lowest, y);
  // a line down from it to the axis, as a marker among many would be lost
  const double error = std::max(*chosen.error, a.bar);
  f.curves.push_back({"advised", {"#000000", "1", 3}, {{chosen.cost(), error}, {chosen.cost(), lowest / 2}}, true});
  f.floor = {fmt::format("asked: {}", nice_length(a.tolerance)), a.tolerance};
  f.finding = fmt::format("{} at {} meets {} at the least cost.", chosen.method,
                          chosen.relative > 0 ? fmt::format("a relative tolerance of {:.2g}", chosen.relative)
                                              : fmt::format("a step of {:.4g} s", chosen.step),
                          nice_length(a.tolerance));
  f.caption = fmt::format("Scene {}, until {:.3g} s; truth: {}, error bar {} ({}); commit {}.", a.scene.name, a.until,
                          a.of_contact_rule ? "what the in-house contact rule converges to" : name_of(a.tier),
                          nice_length(a.bar), a.truth, commit);
  return f;
}

}  // namespace crosscheck
