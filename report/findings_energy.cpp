// Sentences on experiment `energy`.
#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/cells.h"
#include "report/findings.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

/// Symplectic rules against the others, on the undamped scenes.
void drift(const Table& table, std::vector<Finding>& out) {
  double kept = 0;
  std::string which;
  std::map<std::string, std::string> others;  // of the first undamped scene
  std::string scene;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (std::get<long>(table.at(i, "undamped")) == 0 || std::get<long>(table.at(i, "closure claimed")) == 0) continue;
    const std::string &method = std::get<std::string>(table.at(i, "method")),
                      &verdict = std::get<std::string>(table.at(i, "verdict"));
    if (!(number_at(table, i, "energy turned over", NAN) > 0)) continue;  // at rest, or left out
    const double share = number_at(table, i, "largest residual", NAN) / number_at(table, i, "energy turned over", NAN);
    if (std::get<long>(table.at(i, "symplectic")) != 0) {
      if (verdict == "ok" && share > kept) kept = share, which = method;
      continue;
    }
    if (scene.empty()) scene = std::get<std::string>(table.at(i, "scene"));
    if (scene != std::get<std::string>(table.at(i, "scene"))) continue;
    for (const char* shown : {"mysim/explicit-euler", "mysim/implicit-euler", "bullet/pbd"})
      if (method == shown) {
        if (verdict == "ok")
          others[method] = fmt::format("{} takes {} of it", method, percent(share, 1));
        else if (verdict == "energy" || verdict == "nan")
          others[method] = fmt::format("{} blows up after {:.3g} s", method, number_at(table, i, "end", NAN));
      }
  }
  if (which.empty()) return;
  std::vector<std::string> list;
  for (const auto& [name, text] : others) list.push_back(text);
  out.push_back({"", "energy",
                 fmt::format("In runs of a hundred thousand steps symplectic rules keep the energy to {} of what is "
                             "turned over, without drift{}.",
                             percent(kept, 1), list.empty() ? "" : fmt::format("; on {} {}", scene, joined(list))),
                 "exact balance"});
}

/// Numerical damping against the closed form.
void damping(const Table& table, std::vector<Finding>& out) {
  double worst = -1, tenth = NAN;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const double rate = number_at(table, i, "equivalent drag", NAN), theory = number_at(table, i, "by theory", NAN);
    const std::string& method = std::get<std::string>(table.at(i, "method"));
    if (method != "mysim/implicit-euler" && method != "bullet/deformable-implicit" && method != "bullet/pbd") continue;
    if (!(theory > 0) || !std::isfinite(rate)) continue;
    worst = std::max(worst, std::abs(rate / theory - 1));
    if (std::abs(number_at(table, i, "h omega", NAN) - 0.1) < 1e-9) tenth = rate / 10;  // omega = 10 rad/s
  }
  if (worst < 0 || !std::isfinite(tenth)) return;
  out.push_back({"", "energy",
                 fmt::format("Implicit Euler, Bullet's implicit and its position-based world damp by themselves: at a "
                             "tenth of a radian per step like a drag of {:.2f} omega, as theory says to {}.",
                             tenth, percent(worst, 1)),
                 "exact"});
}

}  // namespace

std::vector<Finding> energy_findings(const Rows& result) {
  std::vector<Finding> out;
  if (const Table* table = result.table("energy")) drift(*table, out);
  if (const Table* table = result.table("energy-damping")) damping(*table, out);
  return out;
}

}  // namespace crosscheck
