#include "report/leaving_told.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "experiments/cells.h"
#include "report/findings_text.h"

namespace crosscheck {
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
    if (method.starts_with("mysim/")) {
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

}  // namespace crosscheck
