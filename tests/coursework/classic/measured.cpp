// The constants that a student's evalF shows. They are the student's choice and cost no points; told as numbers, so
// that a forgotten or doubled mass is seen by whoever knows what was meant.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/coursework/check/words.h"
#include "tests/coursework/classic/replay.h"
#include "tests/coursework/classic/springs.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework::classic {
namespace {

std::string three_digits(double value) { return with_digits(std::abs(value) < 1e-6 ? 0 : value, 3); }

/// "9.8", or where they differ "1: 9.8, 2: 4.9".
std::string of_each(const std::map<int, double>& values) {
  std::set<std::string> different;
  for (const auto& [particle, value] : values) different.insert(three_digits(value));
  if (different.size() == 1) return *different.begin();
  std::string list;
  int told = 0;
  for (const auto& [particle, value] : values) {
    if (++told > 6) return list + ", ...";
    list += (list.empty() ? "" : ", ") + std::to_string(particle) + ": " + three_digits(value);
  }
  return list;
}

/// Downwards, of each particle that moves: the middle of three draws of forces at x and at -x.
std::map<int, double> gravities(const Numbers& raw) {
  std::map<int, double> found;
  const auto n = raw.empty() ? 0 : static_cast<std::size_t>(raw[0]);
  for (std::size_t i = 0; i < n && raw.size() >= 1 + 18 * n; ++i) {
    Numbers draws;
    for (std::size_t draw = 0; draw < 3; ++draw) {
      const double* a = &raw[1 + (draw * n + i) * 6];
      draws.push_back(-(a[1] + a[4]) / 2);
    }
    std::sort(draws.begin(), draws.end());
    if (std::any_of(&raw[1 + i * 6], &raw[1 + i * 6] + 6, [](double v) { return v != 0; }))
      found[static_cast<int>(i)] = draws[1];
  }
  return found;
}

/// What a velocity takes of the acceleration, per velocity, of those particles that move and were looked at: "0.6", or
/// where they differ "0.6 (of 20), 0 (of 12)".
std::string drags(const Numbers& raw) {
  std::map<std::string, int> found;
  const auto n = raw.empty() ? 0 : static_cast<std::size_t>(raw[0]);
  for (std::size_t i = 0; i < n && raw.size() >= 1 + 12 * n; ++i) {
    const double *w = &raw[1 + i * 12], *a0 = w + 3, *a1 = w + 6;
    double along = 0, size = 0, moves = 0;
    for (int k = 0; k < 3; ++k)
      along += (a0[k] - a1[k]) * w[k], size += w[k] * w[k], moves += std::abs(a0[k]) + std::abs(a1[k]);
    if (size > 0 && moves > 0) ++found[three_digits(std::abs(along) < 1e-3 * size ? 0 : along / size)];
  }
  if (found.size() == 1) return found.begin()->first;
  std::string list;
  for (const auto& [value, count] : found)
    if (list.size() < 60) list += (list.empty() ? "" : ", ") + value + " (of " + std::to_string(count) + ")";
  return list;
}

/// "0-1: 80, 0.6" for a few springs, else a line for each kind of neighbour on the grid.
std::string springs_list(const Springs& s) {
  std::string list;
  const auto add = [&](const std::string& name, const Spring& one) {
    list += (list.empty() ? "" : "; ") + name + ": " + three_digits(one.k) + ", " + three_digits(one.rest);
  };
  if (s.all.size() <= 12) {
    for (const Spring& one : s.all) add(std::to_string(one.a) + "-" + std::to_string(one.b), one);
    return list;
  }
  const auto grid = grid_of(s);
  if (!grid) return "";
  std::map<std::pair<int, int>, Spring> kinds;
  for (const Spring& one : s.all)
    if (!s.fixed[static_cast<std::size_t>(one.a)])
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
    std::vector<Numbers> raw;
    for (std::size_t i = 0; i < cases.size(); ++i)
      raw.push_back(answers[i].how == How::answered ? replay(cases[i], answers[i].got) : Numbers());
    const std::string gravity = of_each(gravities(raw[0])), drag = drags(raw[1]),
                      springs = springs_list(springs_of(raw[2]));
    if (gravity.empty() && springs.empty()) continue;
    const auto or_none = [](const std::string& one) { return one.empty() ? std::string("-") : one; };
    text += (text.empty() ? "" : " ") + common.fill(part == "cloth" ? "measured.cloth" : "measured.row",
                                                    std::to_string(static_cast<int>(size)), or_none(gravity),
                                                    or_none(drag), or_none(springs));
  }
  return text.empty() ? "" : text + " " + common.of("measured.yours");
}

}  // namespace coursework::classic
