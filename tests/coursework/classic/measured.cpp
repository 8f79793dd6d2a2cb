// Constants measured from a student's evalF. They are the student's choice and cost no points; they are reported as
// numbers so that a forgotten or doubled mass is visible to readers who know the intended values.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/coursework/check/words.h"
#include "tests/coursework/classic/oracles.h"
#include "tests/coursework/classic/springs.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework::classic {
namespace {

std::string three_digits(double value) { return with_digits(std::abs(value) < 1e-6 ? 0 : value, 3); }

/// The values of all free particles: "9.8", or, if they differ, "9.8 (1, 2), 4.9 (3)" with at most six particles.
std::string of_each(const Findings& found, std::size_t first, std::size_t last,
                    double (*on)(const Findings&, std::size_t)) {
  std::map<std::string, std::vector<std::string>> particles;
  for (std::size_t i = 0; i < found.n; ++i)
    if (is_free(found, i, first, last)) particles[three_digits(on(found, i))].push_back(std::to_string(i));
  std::string list;
  for (auto& [value, all] : particles) {
    constexpr std::size_t most = 6;
    const bool more = all.size() > most;
    all.resize(std::min(all.size(), most));
    list += (list.empty() ? "" : ", ") + value;
    if (particles.size() > 1) list += fmt::format(" ({}{})", fmt::join(all, ", "), more ? ", ..." : "");
    if (list.size() > 60) break;
  }
  return list;
}

/// Stiffness per mass and rest length: "0-1: 80, 0.6" per spring if there are few, otherwise per kind of neighbour on
/// the grid.
std::string springs_list(const Springs& s) {
  std::string list;
  const auto add = [&](const std::string& name, const Spring& one) {
    list += (list.empty() ? "" : "; ") + name + ": " + three_digits(one.k) + ", " + three_digits(one.rest);
  };
  if (s.all.size() <= 12) {
    for (const Spring& one : s.all)
      if (one.measured) add(std::to_string(one.a) + "-" + std::to_string(one.b), one);
    return list;
  }
  const auto grid = grid_of(s);
  if (!grid) return "";
  std::map<std::pair<int, int>, Spring> kinds;
  for (const Spring& one : s.all)
    if (one.measured && !s.fixed[static_cast<std::size_t>(one.a)])
      kinds.try_emplace(
          {std::abs(grid->row(one.a) - grid->row(one.b)), std::abs(grid->column(one.a) - grid->column(one.b))}, one);
  int told = 0;
  for (const auto& [offset, one] : kinds)
    if (++told <= 8) add("(" + std::to_string(offset.first) + ", " + std::to_string(offset.second) + ")", one);
  return list;
}

}  // namespace

std::string measured_text(const Texts& common, const std::string& part, const Ask& student) {
  std::string text;
  const std::map<std::string, std::vector<std::pair<const char*, double>>> all{
      {"pendulum", {{"pendulum", 2}, {"chain", 4}}}, {"cloth", {{"cloth", 8}}}};
  const auto systems = all.find(part);
  if (systems == all.end()) return "";
  for (const auto& [system, size] : systems->second) {
    std::vector<Case> cases;
    for (const char* what : {"gravity", "drag", "springs"})
      cases.push_back({std::string(system) + "." + what, {size, 11}});
    const std::vector<Answer> answers = student(cases);
    std::vector<Findings> found;
    for (std::size_t i = 0; i < cases.size(); ++i)
      found.push_back(answers[i].how == How::answered ? replay(cases[i], answers[i].got) : Findings());
    const std::string gravity = of_each(found[0], 0, 1, gravity_on), drag = of_each(found[1], 1, 3, drag_on),
                      springs = springs_list(springs_of(found[2]));
    if (gravity.empty() && springs.empty()) continue;
    const auto or_none = [](const std::string& one) { return one.empty() ? std::string("-") : one; };
    text += (text.empty() ? "" : " ") + common.fill(part == "cloth" ? "measured.cloth" : "measured.row",
                                                    std::to_string(static_cast<int>(size)), or_none(gravity),
                                                    or_none(drag), or_none(springs));
  }
  return text.empty() ? "" : text + " " + common.of("measured.yours");
}

}  // namespace coursework::classic
