// Sentences on experiment `sphere`.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/tables/table.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

void cone(const Table& table, std::vector<Finding>& out) {
  struct Count {
    std::string method;
    int right = 0, all = 0;
  } counts[] = {{ours}, {theirs}, {position_based()}, {sticky_sphere}};
  for (size_t i = 0; i < table.rows.size(); ++i)
    for (Count& count : counts)
      if (text_at(table, i, "method") == count.method && text_at(table, i, "verdict") == "ok") {
        ++count.all;
        count.right += text_at(table, i, "answer") == text_at(table, i, "answer by theory");
      }
  std::vector<std::string> parts;
  for (const Count& count : counts)
    if (count.all > 0) parts.push_back(fmt::format("{} in {} of {}", count.method, count.right, count.all));
  if (!parts.empty())
    out.push_back({"", "contact",
                   "On slopes a particle sticks or slides as Coulomb's law says with " + joined(parts) + " cases.",
                   "exact", "cone"});
}

void leaving(const Table& table, std::vector<Finding>& out) {
  if (const std::string sentence = leaving_sentence(table); !sentence.empty())
    out.push_back({"", "contact", sentence, "exact", "leaving"});
}

/// The cloth that should slide off, at the finest step.
void slide_off(const Table& table, std::vector<Finding>& out) {
  const std::vector<DrapeEnd> ends = drape_ends(table);
  if (ends.size() < 2 || ends[0].method != ours || !(ends[0].height < 0)) return;
  std::vector<std::string> parts;
  for (size_t i = 1; i < ends.size(); ++i)
    parts.push_back(ends[i].creep ? fmt::format("with {} it {}", ends[i].method, ends[i].contact_text())
                                  : fmt::format("with {} it is off the ball as well (centres {} apart)", ends[i].method,
                                                nice_length(std::abs(ends[i].height - ends[0].height))));
  out.push_back({"", "contact",
                 fmt::format("A cloth dropped aside with too little friction slides off the ball in {}; {}.", ours,
                             joined(parts)),
                 "another engine", "slide-off"});
}

/// Largest difference from mysim/symplectic-euler that each method's rows of a scene show, m, by method.
std::map<std::string, double> differences_over_run(const Table& rows) {
  std::map<std::string, double> largest;
  for (size_t i = 0; i < rows.rows.size(); ++i)
    if (const auto apart = number_at(rows, i, "difference")) {
      double& known = largest[text_at(rows, i, "method")];
      known = std::max(known, *apart);
    }
  return largest;
}

/// Single positions after the window: mysim's own rules of an order above one, which share its contact
/// rule, say whether they can be predicted. They part by what their steps err and by what grows of it; where that stays
/// small against the difference of Bullet, it is Bullet's result that differs, and no chance.
void after_contact(const Rows& result, const Table& engines, std::vector<Finding>& out) {
  for (const std::string& scene : distinct(engines, "scene")) {
    const Table* rows = result.table(scene + "-engines");
    std::set<std::string> rules;
    double window = 0, duration = 0;
    bool touched = false, bullet = false;
    for (size_t i = 0; i < engines.rows.size(); ++i) {
      if (text_at(engines, i, "scene") != scene || text_at(engines, i, "verdict") != "ok") continue;
      const std::string& method = text_at(engines, i, "method");
      window = number_at(engines, i, "window", 0), duration = std::max(duration, number_at(engines, i, "end", 0));
      touched |= number_at(engines, i, "smallest clearance", 1) < 1e-3;
      bullet |= method == theirs;
      if (const Method* m = builtin_method(method); m && m->stepper && m->stepper->order >= 2) rules.insert(method);
    }
    if (!rows || !touched || !bullet || rules.size() < 2 || !(window < duration * (1 - 1e-9))) continue;
    const auto apart = differences_over_run(*rows);
    if (!apart.contains(theirs)) continue;
    double own = 0;
    for (const std::string& rule : rules)
      if (const auto found = apart.find(rule); found != apart.end()) own = std::max(own, found->second);
    const double other = apart.at(theirs);
    // three times: beyond what one more rule of the kind might add
    const std::string said =
        other > 3 * own ? fmt::format("single positions can be predicted there, and it is {} that differs, by up to {}",
                                      theirs, nice_length(other))
                        : fmt::format("{} differs by up to {}: no more can be said of single positions", theirs,
                                      nice_length(other));
    out.push_back(
        {"", "contact",
         fmt::format("On {}, beyond {:.3g} s and up to {:.3g} s, {} of mysim's rules stay within {} of {}; {}.", scene,
                     window, duration, rules.size(), nice_length(own), ours, said),
         "another engine", "after-contact"});
  }
}

void depth(const Table& table, std::vector<Finding>& out) {
  double particles = 0, triangles = 0, their_triangles = 0, longest = 0;
  std::map<std::string, double> of_bullet;
  bool any = false;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "verdict") != "ok") continue;
    const std::string& method = text_at(table, i, "method");
    const double nodes = number_at(table, i, "particles", NAN);
    longest = std::max(longest, number_at(table, i, "step", 0));
    if (family_of(method).is_default_peer())
      their_triangles = std::max(their_triangles, number_at(table, i, "triangles", 0));
    if (family_of(method).is_default_peer() && nodes > 1e-9) of_bullet[method] = std::max(of_bullet[method], nodes);
    if (!family_of(method).is_subject() || method == sticky_sphere) continue;
    any = true;
    particles = std::max(particles, nodes);
    triangles = std::max(triangles, number_at(table, i, "triangles", 0));
  }
  if (!any || of_bullet.empty()) return;
  std::vector<std::string> theirs_told;
  for (const auto& [method, most] : of_bullet) theirs_told.push_back(fmt::format("{} {:.2g} %", method, most));
  out.push_back({"", "contact",
                 fmt::format("On a ball {}, the triangles between them by up to {:.2g} % of the radius; particles of "
                             "Bullet's worlds sink in by up to: {}, triangles by {:.2g} %{}.",
                             particles < 1e-9 ? "no particle of mysim sinks in but for rounding"
                                              : fmt::format("particles of mysim sink in by up to {:.2g} %", particles),
                             triangles, joined(theirs_told), their_triangles,
                             longest > 0 ? fmt::format(" (at steps of up to {})", step_text(longest)) : ""),
                 "measured", "penetration"});
}

}  // namespace

std::vector<Finding> sphere_findings(const Rows& result) {
  std::vector<Finding> out;
  if (const Table* t = result.table("engines")) after_contact(result, *t, out);
  if (const Table* table = result.table("sphere-cone")) cone(*table, out);
  if (const Table* table = result.table("sphere-leaving")) leaving(*table, out);
  if (const Table* table = result.table("sphere-drape")) slide_off(*table, out);
  if (const Table* table = result.table("sphere-penetration")) depth(*table, out);
  return out;
}

}  // namespace crosscheck
