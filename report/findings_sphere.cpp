// Sentences on experiment `sphere`.
#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "report/findings.h"
#include "report/findings_text.h"

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

/// The cloth that should slide off, at the finest step.
void slide_off(const Table& table, std::vector<Finding>& out) {
  double reference = NAN, step = INFINITY;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (text_at(table, i, "scene") == "drop-aside" && text_at(table, i, "verdict") == "ok" &&
        text_at(table, i, "method") == ours && number_at(table, i, "step", NAN) < step)
      step = number_at(table, i, "step", NAN), reference = number_at(table, i, "centre height", NAN);
  std::vector<std::string> parts;
  for (const char* method : {theirs, position_based, sticky_sphere})
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "scene") != "drop-aside" || text_at(table, i, "method") != method ||
          text_at(table, i, "verdict") != "ok" || std::abs(number_at(table, i, "step", NAN) / step - 1) > 1e-6)
        continue;
      const double height = number_at(table, i, "centre height", NAN), creep = number_at(table, i, "creep", NAN);
      parts.push_back(std::isfinite(creep)
                          ? fmt::format("with {} it still touches, {}", method,
                                        creep < 1e-6 ? "frozen" : fmt::format("sliding at {} mm/s", nice(1e3 * creep)))
                          : fmt::format("with {} it is off the ball as well (centres {} apart)", method,
                                        nice_length(std::abs(height - reference))));
    }
  if (!parts.empty() && std::isfinite(reference) && reference < 0)
    out.push_back({"", "contact",
                   fmt::format("A cloth dropped aside with too little friction slides off the ball in {}; {}.", ours,
                               joined(parts)),
                   "another engine", "slide-off"});
}

void depth(const Table& table, std::vector<Finding>& out) {
  double particles = 0, of_pbd = 0, triangles = 0;
  bool any = false;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != "drop-centred" || text_at(table, i, "verdict") != "ok") continue;
    const std::string& method = text_at(table, i, "method");
    const double nodes = number_at(table, i, "particles", NAN);
    if (method == position_based) of_pbd = std::max(of_pbd, nodes);
    if (!method.starts_with("mysim/") || method == sticky_sphere) continue;
    any = true;
    particles = std::max(particles, nodes);
    triangles = std::max(triangles, number_at(table, i, "triangles", NAN));
  }
  if (any && of_pbd > 0)
    out.push_back(
        {"", "contact",
         fmt::format(
             "On a ball {}, the triangles between them by {:.2g} % of the radius; Bullet's position-based world "
             "lets particles in by up to {:.2g} %.",
             particles < 1e-9 ? "no particle of mysim sinks in but for rounding"
                              : fmt::format("particles of mysim sink in by up to {:.2g} %", particles),
             triangles, of_pbd),
         "measured", "penetration"});
}

}  // namespace

std::vector<Finding> sphere_findings(const Rows& result) {
  std::vector<Finding> out;
  if (const Table* table = result.table("sphere-cone")) cone(*table, out);
  if (const Table* table = result.table("sphere-drape")) slide_off(*table, out);
  if (const Table* table = result.table("sphere-penetration")) depth(*table, out);
  return out;
}

}  // namespace crosscheck
