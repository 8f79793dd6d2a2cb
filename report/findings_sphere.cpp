// Sentences on experiment `sphere`.
#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/cells.h"
#include "report/drape_told.h"
#include "report/findings.h"
#include "report/findings_text.h"
#include "report/leaving_told.h"

namespace crosscheck {
namespace {

void cone(const Table& table, std::vector<Finding>& out) {
  struct Count {
    const char* method;
    int right = 0, all = 0;
  } counts[] = {{ours}, {theirs}, {position_based}, {sticky_sphere}};
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
    parts.push_back(ends[i].creep ? fmt::format("with {} it {}", ends[i].method, ends[i].touch_text())
                                  : fmt::format("with {} it is off the ball as well (centres {} apart)", ends[i].method,
                                                nice_length(std::abs(ends[i].height - ends[0].height))));
  out.push_back({"", "contact",
                 fmt::format("A cloth dropped aside with too little friction slides off the ball in {}; {}.", ours,
                             joined(parts)),
                 "another engine", "slide-off"});
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
    if (method.starts_with("bullet/")) their_triangles = std::max(their_triangles, number_at(table, i, "triangles", 0));
    if (method.starts_with("bullet/") && nodes > 1e-9) of_bullet[method] = std::max(of_bullet[method], nodes);
    if (!method.starts_with("mysim/") || method == sticky_sphere) continue;
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
  if (const Table* table = result.table("sphere-cone")) cone(*table, out);
  if (const Table* table = result.table("sphere-leaving")) leaving(*table, out);
  if (const Table* table = result.table("sphere-drape")) slide_off(*table, out);
  if (const Table* table = result.table("sphere-penetration")) depth(*table, out);
  return out;
}

}  // namespace crosscheck
