// Sentences on experiment `energy`.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/tables/table.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// "10000 to 100000"
std::string steps_text(long fewest, long most) { return range(count_text(fewest), count_text(most)); }

/// The energy residual on a scene where drag or contact act, in parts of their energy, with the method.
std::map<double, std::string> open_balances(const Table& table, const std::string& scene, bool symplectic) {
  std::map<double, std::string> open;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene || flag_at(table, i, "undamped") ||
        flag_at(table, i, "symplectic") != symplectic || !flag_at(table, i, "closure claimed") ||
        text_at(table, i, "verdict") != "ok" || text_at(table, i, "method") == sticky_sphere)
      continue;
    double took = 0;
    for (const char* part : {"drag took", "dashpots took", "contact took"})
      took += std::abs(number_at(table, i, part, 0));
    if (took > 0) open[number_at(table, i, "largest residual", 0) / took] = text_at(table, i, "method");
  }
  return open;
}

/// How far the balance stays open where drag or contact act: the least and the most, by scene.
std::string where_energy_leaves(const Table& table) {
  std::string said;
  for (const std::string& scene : distinct(table, "scene")) {
    const auto open = open_balances(table, scene, true), others = open_balances(table, scene, false);
    if (open.empty()) continue;
    const auto told = [](const auto& each) { return fmt::format("{} ({})", percent(each.first, 1), each.second); };
    said += fmt::format(
        " On {}, where drag or contact act, what does not add up with symplectic rules is {} of what passes through "
        "drag and contact, gains and losses counted alike{}.",
        scene, range(told(*open.begin()), told(*open.rbegin())),
        others.empty() ? ""
                       : fmt::format("; with others, some at ten times the step, up to {}", told(*others.rbegin())));
  }
  return said;
}

/// Three rules that are not symplectic on a scene, as far as they were run.
std::vector<std::string> beside(const Table& table, const std::string& scene) {
  std::vector<std::string> all;
  for (const char* shown : {"bullet/pbd", "mysim/explicit-euler", "mysim/implicit-euler"})
    for (size_t i = 0; i < table.rows.size(); ++i) {
      const double turned = number_at(table, i, "energy turned over", 0),
                   share = number_at(table, i, "largest residual", NAN) / turned;
      if (text_at(table, i, "scene") != scene || text_at(table, i, "method") != shown || !(turned > 0)) continue;
      if (const std::string& verdict = text_at(table, i, "verdict"); verdict != "ok")
        all.push_back(
            fmt::format("{} {} after {:.3g} s", shown, failure_class(verdict), number_at(table, i, "end", NAN)));
      else if (const double rate = number_at(table, i, "equivalent drag", NAN);
               number_at(table, i, "residual", 0) < 0 && rate > 0)
        all.push_back(fmt::format("{} damps as a drag of {:.2g} per second would, at steps of {}", shown, rate,
                                  step_text(number_at(table, i, "step", NAN))));
      else if (std::isfinite(share))
        all.push_back(fmt::format("{} adds {} of it at steps of {}", shown, percent(share, 1),
                                  step_text(number_at(table, i, "step", NAN))));
    }
  return all;
}

/// Symplectic rules against the others, on the undamped scenes.
void drift(const Table& table, std::vector<Finding>& out) {
  double worst = -1;
  std::string scene;  // the first undamped one
  long fewest = std::numeric_limits<long>::max(), most = 0;
  std::vector<std::string> drifting, failed, scenes;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (!flag_at(table, i, "undamped") || !flag_at(table, i, "closure claimed")) continue;
    const double turned = number_at(table, i, "energy turned over", 0);
    if (!(turned > 0)) continue;  // at rest, or left out
    if (scene.empty()) scene = text_at(table, i, "scene");
    if (!flag_at(table, i, "symplectic")) continue;
    const std::string who = fmt::format("{} on {}", text_at(table, i, "method"), text_at(table, i, "scene")),
                      what = residual_class(table, i);
    if (text_at(table, i, "verdict") != "ok") {
      failed.push_back(fmt::format("{} ({} at {:.3g} s)", who, what, number_at(table, i, "end", NAN)));
      continue;
    }
    if (const std::string& where = text_at(table, i, "scene"); scenes.empty() || scenes.back() != where)
      scenes.push_back(where);
    const long steps = std::get<long>(table.at(i, "steps"));
    fewest = std::min(fewest, steps), most = std::max(most, steps);
    worst = std::max(worst, number_at(table, i, "largest residual", 0) / turned);
    if (!is_bounded(what)) drifting.push_back(fmt::format("{} ({})", who, what));
  }
  if (!failed.empty())
    out.push_back({"", "failure", fmt::format("Symplectic rules that failed in long runs: {}.", joined(failed)),
                   "measured", "symplectic-energy"});
  if (worst < 0) return;
  const std::vector<std::string> others = beside(table, scene);
  out.push_back(
      {"", "energy",
       fmt::format("In runs of {} steps on {} (no drag, no contact) symplectic rules keep the energy to {} of "
                   "what is turned over, {}{}.{}",
                   steps_text(fewest, most), joined(scenes), percent(worst, 1),
                   drifting.empty() ? "without drift" : "but not all without drift: " + joined(drifting),
                   others.empty() ? "" : fmt::format("; on {} {}", scene, joined(others)), where_energy_leaves(table)),
       "exact balance", "symplectic-energy"});
}

/// Numerical damping against the closed form.
void damping(const Table& table, std::vector<Finding>& out) {
  double worst = -1, low = INFINITY, high = -INFINITY;
  std::vector<std::string> methods;
  for (const std::string& method : distinct(table, "method")) {
    const Method* m = builtin_method(method);
    if (!m || (m->on_one_spring.empty() ? m->rule : m->on_one_spring) != "implicit-euler") continue;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      const double rate = number_at(table, i, "equivalent drag", NAN), theory = number_at(table, i, "by theory", NAN);
      if (text_at(table, i, "method") != method || !(theory > 0) || !std::isfinite(rate)) continue;
      if (methods.empty() || methods.back() != method) methods.push_back(method);
      worst = std::max(worst, std::abs(rate / theory - 1));
      if (std::abs(number_at(table, i, "h omega", NAN) - 0.1) < 1e-9)
        low = std::min(low, rate / 10), high = std::max(high, rate / 10);  // ω = 10 rad/s
    }
  }
  if (methods.empty()) return;
  const bool one = methods.size() == 1;
  std::string sentence = fmt::format("{} {}", joined(methods), one ? "damps by itself" : "damp by themselves");
  if (low <= high)
    sentence += fmt::format(": at a tenth of a radian per step like a drag of {} ω",
                            range(fmt::format("{:.2f}", low), fmt::format("{:.2f}", high)));
  sentence += worst <= 0.01 ? fmt::format(", as theory says to {}.", percent(worst, 1))
                            : fmt::format("; theory says otherwise by up to {}.", percent(worst, 1));
  out.push_back({"", "energy", sentence, "exact", "numerical-damping"});
}

}  // namespace

std::vector<Finding> energy_findings(const Rows& result) {
  std::vector<Finding> out;
  if (const Table* table = result.table("energy")) drift(*table, out);
  if (const Table* table = result.table("energy-damping")) damping(*table, out);
  return out;
}

}  // namespace crosscheck
