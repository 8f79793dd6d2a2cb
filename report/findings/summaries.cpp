// Summaries of single tables: grids, least models, where particles leave a ball, drapes, step limits.
#include "report/findings/summaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "experiments/tables/table.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

/// Against the number of bend springs in a line instead of its cells.
std::optional<PowerLaw> power_of_bend_springs(const Rows& rows) {
  const Table* t = rows.table("adequacy-bending");
  std::vector<std::pair<double, double>> points;
  for (size_t i = 0; t && i < t->rows.size(); ++i)
    points.emplace_back(*number_at(*t, i, "particles along a line") - 2,
                        *number_at(*t, i, "stiffness of bend springs"));
  return power_law(points);
}

}  // namespace

std::optional<PowerLaw> power_of(const Rows& rows, const std::string& scene, const std::string& quantity) {
  const Table* t = rows.table("adequacy-scaling");
  for (size_t i = 0; t && i < t->rows.size(); ++i)
    if (text_or_none(*t, i, "scene") == scene && text_at(*t, i, "quantity") == quantity)
      return PowerLaw{*number_at(*t, i, "exponent"), *number_at(*t, i, "standard error")};
  return std::nullopt;
}

std::string power_text(const PowerLaw& power) {
  return fmt::format("{:.2f} ± {:.2f}", power.exponent, power.deviation);
}

std::string bend_sentence(const Rows& rows) {
  constexpr double derived = 4, close = 0.05;
  const auto of_cells = power_of(rows, "", stiffness_for_droop), of_springs = power_of_bend_springs(rows);
  if (!of_cells) return "";
  std::string text = fmt::format(
      "For the same droop of a clamped sheet bend springs must stiffen as the number of cells to the power {} (derived "
      "for many cells: {:g}).",
      power_text(*of_cells), derived);
  const double off = std::abs(of_cells->exponent - derived);
  if (off <= std::max(close, 2 * of_cells->deviation)) return text;
  const double left = of_springs ? std::abs(of_springs->exponent - derived) : INFINITY;
  if (!(left < off)) return text + " The difference is not explained.";
  return text + fmt::format(
                    " Counted in bend springs along a line instead of cells (half a spring fewer, as none reaches over "
                    "the free end) the power is {}: {} of the difference comes from that end.",
                    power_text(*of_springs), left <= close ? "nearly all" : "only a part");
}

std::vector<LeastModel> least_models_of(const Rows& rows, const std::string& scene) {
  std::vector<LeastModel> all;
  const Table* t = rows.table("adequacy-least");
  for (size_t i = 0; t && i < t->rows.size(); ++i) {
    if (text_at(*t, i, "scene") != scene) continue;
    LeastModel least{text_at(*t, i, "tolerance is"),     text_at(*t, i, "left out"), flag_at(*t, i, "holds"), 0, 0,
                     number_at(*t, i, "cost of full", 1)};
    for (const char* column : {"unseen error 1", "unseen error 2", "unseen error 3"}) {
      ++least.starts;
      least.failing += !(number_at(*t, i, column, INFINITY) <= number_at(*t, i, "tolerance", 0));
    }
    all.push_back(std::move(least));
  }
  return all;
}

std::vector<std::string> kept_without(const Rows& rows, const std::string& scene, const std::string& left_out) {
  std::vector<std::string> kept;
  const Table* t = rows.table("adequacy");
  for (size_t i = 0; t && i < t->rows.size(); ++i) {
    const std::string& one = text_at(*t, i, "left out");
    if (text_at(*t, i, "scene") == scene && text_at(*t, i, "kind") == "single" && one != "all springs" &&
        (", " + left_out + ", ").find(", " + one + ", ") == std::string::npos)
      kept.push_back(one);
  }
  return kept;
}

namespace {

/// Angle less the exact one, degrees, by step.
std::map<double, double> offs_of(const Table& t, const std::string& method) {
  std::map<double, double> offs;
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (const auto angle = number_at(t, i, "angle"); angle && text_at(t, i, "method") == method)
      offs[*number_at(t, i, "step")] = *angle - *number_at(t, i, "angle by theory");
  return offs;
}

}  // namespace

std::string leaving_sentence(const Table& t) {
  double of_mysim = -1, finest = INFINITY, least = INFINITY, most = -INFINITY, long_step = 0;
  for (size_t i = 0; i < t.rows.size(); ++i) finest = std::min(finest, number_at(t, i, "step", INFINITY));
  std::vector<std::string> parts, worse;
  for (const std::string& method : distinct(t, "method")) {
    const auto offs = offs_of(t, method);
    if (offs.empty() || offs.begin()->first != finest) continue;
    const auto [longest, at_longest] = *offs.rbegin();
    const double off = offs.begin()->second;
    if (family_of(method).is_subject()) {
      of_mysim = std::max(of_mysim, std::abs(off));
      long_step = std::max(long_step, longest);
      least = std::min(least, at_longest), most = std::max(most, at_longest);
    } else {
      parts.push_back(fmt::format("{} by {:+.2g} ({:+.2g} at {})", method, off, at_longest, step_text(longest)));
      if (std::abs(off) > std::abs(at_longest)) worse.push_back(method);
    }
  }
  if (of_mysim >= 0)
    parts.insert(parts.begin(),
                 fmt::format("mysim's rules by at most {:.2g} degrees ({} at {})", of_mysim,
                             range(fmt::format("{:+.2g}", least), fmt::format("{:+.2g}", most)), step_text(long_step)));
  if (parts.empty()) return "";
  std::string sentence = fmt::format("At a step of {} particles leave the ball off the exact angle: {}.",
                                     step_text(finest), joined(parts));
  if (!worse.empty()) sentence += fmt::format(" Shorter steps make {} worse.", joined(worse));
  return sentence;
}

std::string DrapeEnd::contact_text() const {
  return *creep < 1e-6 ? "still touches it, frozen"
                       : fmt::format("still touches it, sliding at {} mm/s", nice(1e3 * *creep));
}

std::vector<DrapeEnd> drape_ends(const Table& t) {
  const auto came_to_the_end = [&](size_t i, const std::string& method) {
    return text_at(t, i, "scene") == "drop-aside" && text_at(t, i, "method") == method &&
           text_at(t, i, "verdict") == "ok";
  };
  double finest = INFINITY;
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (came_to_the_end(i, ours)) finest = std::min(finest, number_at(t, i, "step", INFINITY));
  std::vector<DrapeEnd> ends;
  for (const std::string& method : {ours, theirs, position_based(), sticky_sphere})
    for (size_t i = 0; i < t.rows.size(); ++i)
      if (came_to_the_end(i, method) && std::abs(number_at(t, i, "step", NAN) / finest - 1) < 1e-6)
        ends.push_back(
            {method, number_at(t, i, "centre height", NAN), number_at(t, i, "end", NAN), number_at(t, i, "creep")});
  return ends;
}

std::string drape_end_sentence(const std::vector<DrapeEnd>& ends) {
  if (ends.empty()) return "";
  std::vector<std::string> off, on;
  for (const DrapeEnd& e : ends)
    if (e.creep)
      on.push_back(fmt::format("with {} it {}", e.method, e.contact_text()));
    else
      off.push_back(e.method);
  std::string sentence = fmt::format("At {:.3g} s ", ends.front().end);
  if (!off.empty()) sentence += fmt::format("it is off the ball with {}{}", joined(off), on.empty() ? "" : "; ");
  return sentence + joined(on) + ".";
}

namespace {

/// As far as theory and measurement may part before the table says why.
constexpr double agrees_within = 0.01;

struct Named {
  std::string name;  // "mysim/rk4 on spring"
  StepLimitComparison row;
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
std::optional<StepLimitSummary> summary_of(const Table& t, bool at_rest) {
  std::vector<Named> apart;
  std::set<std::string> scenes;
  double worst = 0, widest = 0;
  int near_by = 0, coarse = 0;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    if ((text_at(t, i, "state") == "rest") != at_rest) continue;
    const auto row = compare_step_limit(t, i);
    if (!row) continue;
    if (row->kind == StepLimitComparison::apart) {
      apart.push_back({fmt::format("{} on {}", text_at(t, i, "method"), text_at(t, i, "scene")), *row});
    } else if (row->kind == StepLimitComparison::coarse) {
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
  return StepLimitSummary{sentence + ".", at_rest, apart.empty()};
}

}  // namespace

std::string deviation_text(double off, double finest) {
  if (std::abs(off) < finest) return fmt::format("within ±{:.2g} %", 100 * finest);
  return off >= 1 ? fmt::format("{} times as long", nice(1 + off)) : fmt::format("{:+.2g} %", 100 * off);
}

std::optional<StepLimitComparison> compare_step_limit(const Table& t, size_t row) {
  const std::string &theory = text_at(t, row, "prediction"), &run = text_at(t, row, "measurement");
  if (theory == "none" || run == "unsupported") return std::nullopt;
  const double held = number_at(t, row, "held", 0), failed = number_at(t, row, "failed", INFINITY),
               predicted = theory == "limit"        ? *number_at(t, row, "predicted limit")
                           : theory == "every step" ? INFINITY
                                                    : 0;
  if (theory == "limit" && run == "limit") {
    const double off = *number_at(t, row, "deviation");
    if (std::abs(off) <= agrees_within) return StepLimitComparison{StepLimitComparison::agrees, off, ""};
    if (held <= predicted && predicted <= failed) return StepLimitComparison{StepLimitComparison::coarse, off, ""};
    return StepLimitComparison{StepLimitComparison::apart, off, deviation_text(off)};
  }
  const bool refused = run == "held up to a refusal";
  // a limit that lies beyond the steps tried, or beyond a refusal, is neither met nor missed
  if (theory == "limit" && run != "limit" && (run == "no stable step" ? failed >= predicted : held <= predicted))
    return std::nullopt;
  if (theory == "every step" && refused) return std::nullopt;
  if (theory != "limit" && run != "limit" && (theory == "every step") == (run != "no stable step"))
    return StepLimitComparison{};
  const std::string found = run == "limit"            ? "holds up to " + step_text(*number_at(t, row, "measured limit"))
                            : refused                 ? "holds at least up to " + step_text(held)
                            : run == "no stable step" ? "fails at every step tried"
                                                      : "holds at every step tried",
                    said = theory == "limit"        ? "up to " + step_text(predicted)
                           : theory == "every step" ? "at every one"
                                                    : "at none";
  return StepLimitComparison{StepLimitComparison::apart, std::nullopt, fmt::format("{}, by theory {}", found, said)};
}

std::vector<StepLimitSummary> step_limit_summaries(const Table& stability) {
  std::vector<StepLimitSummary> all;
  for (const bool at_rest : {true, false})
    if (auto sentence = summary_of(stability, at_rest)) all.push_back(std::move(*sentence));
  return all;
}

}  // namespace crosscheck
