#include "report/drape_told.h"

#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "report/findings_text.h"

namespace crosscheck {

std::string DrapeEnd::touch_text() const {
  return *creep < 1e-6 ? "still touches it, frozen"
                       : fmt::format("still touches it, sliding at {} mm/s", nice(1e3 * *creep));
}

std::vector<DrapeEnd> drape_ends(const Table& t) {
  const auto came_to_the_end = [&](size_t i, const char* method) {
    return text_at(t, i, "scene") == "drop-aside" && text_at(t, i, "method") == method &&
           text_at(t, i, "verdict") == "ok";
  };
  double finest = INFINITY;
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (came_to_the_end(i, ours)) finest = std::min(finest, number_at(t, i, "step", INFINITY));
  std::vector<DrapeEnd> ends;
  for (const char* method : {ours, theirs, position_based, sticky_sphere})
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
      on.push_back(fmt::format("with {} it {}", e.method, e.touch_text()));
    else
      off.push_back(e.method);
  std::string sentence = fmt::format("At {:.3g} s ", ends.front().end);
  if (!off.empty()) sentence += fmt::format("it is off the ball with {}{}", joined(off), on.empty() ? "" : "; ");
  return sentence + joined(on) + ".";
}

}  // namespace crosscheck
