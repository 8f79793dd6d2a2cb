// Limits by theory against limits as measured.
#include "report/limits_told.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/cells.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

/// As far as theory and measurement may part before the table says why.
constexpr double near = 0.01;

struct Named {
  std::string name;  // "mysim/rk4 on spring"
  LimitCompared row;
};

/// "a, b and 3 more": all of them stand in the tables.
std::string listed(const std::vector<Named>& all) {
  constexpr size_t most = 6;
  std::vector<std::string> names;
  for (size_t i = 0; i < std::min(most, all.size()); ++i)
    names.push_back(fmt::format("{} ({})", all[i].name, all[i].row.how));
  if (all.size() > most) names.push_back(fmt::format("{} more", all.size() - most));
  return joined(names);
}

/// Sentence on the rows of one state; nothing where nothing can be compared.
std::optional<LimitsTold> told(const Table& t, bool at_rest) {
  std::vector<Named> apart;
  std::set<std::string> scenes;
  double worst = 0, widest = 0;
  int near_by = 0, coarse = 0;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    if ((text_at(t, i, "state") == "rest") != at_rest) continue;
    const auto row = compared(t, i);
    if (!row) continue;
    if (row->kind == LimitCompared::apart) {
      apart.push_back({fmt::format("{} on {}", text_at(t, i, "method"), text_at(t, i, "scene")), *row});
    } else if (row->kind == LimitCompared::coarse) {
      ++coarse;
      widest = std::max(widest, *number_at(t, i, "failed") / *number_at(t, i, "held") - 1);
    } else if (row->off) {
      ++near_by;
      // what lies between the last step that held and the first that failed is not known
      worst = std::max({worst, std::abs(*row->off), *number_at(t, i, "failed") / *number_at(t, i, "held") - 1});
      scenes.insert(text_at(t, i, "scene"));
    }
  }
  std::vector<std::string> parts;
  if (near_by > 0)
    parts.push_back(fmt::format("{} measured largest stable step{} within {} of what the eigenvalues predict, on {}",
                                near_by, near_by == 1 ? " lies" : "s lie", percent(worst, 1),
                                joined({scenes.begin(), scenes.end()})));
  if (coarse > 0)
    parts.push_back(
        fmt::format("{} searched coarsely {} theory's limit between what held and what failed, up to {} apart", coarse,
                    coarse == 1 ? "has" : "have", percent(widest, 1)));
  if (!apart.empty())
    parts.push_back(
        fmt::format("{} {} elsewhere: {}", apart.size(), apart.size() == 1 ? "lies" : "lie", listed(apart)));
  if (parts.empty()) return std::nullopt;
  std::string sentence = !at_rest        ? "Where a scene cannot rest theory sees its start alone: "
                         : apart.empty() ? "Where methods break is where theory says: "
                                         : "Not every method breaks where theory says: ";
  for (size_t i = 0; i < parts.size(); ++i) sentence += (i ? "; " : "") + parts[i];
  return LimitsTold{sentence + ".", at_rest, apart.empty()};
}

}  // namespace

std::string apart_text(double off, double finest) {
  if (std::abs(off) < finest) return fmt::format("within ±{:.2g} %", 100 * finest);
  return off >= 1 ? fmt::format("{} times as long", nice(1 + off)) : fmt::format("{:+.2g} %", 100 * off);
}

std::optional<LimitCompared> compared(const Table& t, size_t row) {
  const std::string &theory = text_at(t, row, "prediction"), &run = text_at(t, row, "measurement");
  if (theory == "none" || run == "unsupported") return std::nullopt;
  const double held = number_at(t, row, "held", 0), failed = number_at(t, row, "failed", INFINITY),
               predicted = theory == "limit"        ? *number_at(t, row, "predicted limit")
                           : theory == "every step" ? INFINITY
                                                    : 0;
  if (theory == "limit" && run == "limit") {
    const double off = *number_at(t, row, "deviation");
    if (std::abs(off) <= near) return LimitCompared{LimitCompared::agrees, off, ""};
    if (held <= predicted && predicted <= failed) return LimitCompared{LimitCompared::coarse, off, ""};
    return LimitCompared{LimitCompared::apart, off, apart_text(off)};
  }
  const bool refused = run == "held up to a refusal";
  // a limit that lies beyond the steps tried, or beyond a refusal, is neither met nor missed
  if (theory == "limit" && run != "limit" && (run == "no stable step" ? failed >= predicted : held <= predicted))
    return std::nullopt;
  if (theory == "every step" && refused) return std::nullopt;
  if (theory != "limit" && run != "limit" && (theory == "every step") == (run != "no stable step"))
    return LimitCompared{};
  const std::string found = run == "limit"            ? "holds up to " + step_text(*number_at(t, row, "measured limit"))
                            : refused                 ? "holds at least up to " + step_text(held)
                            : run == "no stable step" ? "fails at every step tried"
                                                      : "holds at every step tried",
                    said = theory == "limit"        ? "up to " + step_text(predicted)
                           : theory == "every step" ? "at every one"
                                                    : "at none";
  return LimitCompared{LimitCompared::apart, std::nullopt, fmt::format("{}, by theory {}", found, said)};
}

std::vector<LimitsTold> limits_told(const Table& stability) {
  std::vector<LimitsTold> all;
  for (const bool at_rest : {true, false})
    if (auto sentence = told(stability, at_rest)) all.push_back(std::move(*sentence));
  return all;
}

}  // namespace crosscheck
