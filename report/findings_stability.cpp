// What the search for the largest stable steps showed.
#include <algorithm>
#include <cmath>
#include <set>

#include "report/findings.h"
#include "report/findings_text.h"

namespace crosscheck {

std::vector<Finding> stability_findings(const Rows& rows) {
  std::vector<Finding> out;
  const Table* table = rows.table("stability");
  if (!table) return out;
  const auto text = [&](size_t row, const char* column) { return std::get<std::string>(table->at(row, column)); };
  double worst = 0;
  int limits = 0;
  std::set<std::string> scenes;
  std::set<std::string> unstable;
  for (size_t i = 0; i < table->rows.size(); ++i) {
    if (text(i, "state") == "rest") {
      if (const auto* off = std::get_if<double>(&table->at(i, "deviation"))) {
        worst = std::max(worst, std::abs(*off));
        ++limits;
        scenes.insert(text(i, "scene"));
      }
      if (text(i, "prediction") == "no stable step" && text(i, "measurement") == "no stable step")
        unstable.insert(text(i, "method").substr(text(i, "method").find('/') + 1));
    }
  }
  if (limits > 0)
    out.push_back({"", "failure",
                   fmt::format("Where methods break is where theory says: {} measured largest stable steps lie within "
                               "{} of what the eigenvalues predict, on {}.",
                               limits, percent(worst, 1), joined({scenes.begin(), scenes.end()})),
                   "measured"});
  const Table* growth = rows.table("stability-growth");
  double off = -1;
  for (size_t i = 0; growth && i < growth->rows.size(); ++i)
    if (std::holds_alternative<std::monostate>(growth->at(i, "share of limit")))
      off = std::max(off, std::abs(std::get<double>(growth->at(i, "deviation"))));
  if (!unstable.empty() && off >= 0)
    out.push_back({"", "failure",
                   fmt::format("Without drag {} {} no stable step at all: vibrations grow in every step, at the "
                               "rate that theory gives (to {}).",
                               joined({unstable.begin(), unstable.end()}), unstable.size() == 1 ? "has" : "have",
                               percent(off, 1)),
                   "measured"});
  return out;
}

}  // namespace crosscheck
