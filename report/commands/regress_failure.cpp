#include "report/commands/regress_failure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "experiments/metrics.h"
#include "experiments/regress/baseline.h"
#include "mysim/base/files.h"
#include "report/base/provenance.h"
#include "report/figures/figure.h"
#include "report/findings/findings_text.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

using Series = std::vector<std::pair<double, double>>;  // over time, s

struct FailureDetails {
  Case test_case;
  std::vector<Comparison> rows;
  Series was, is;                          // RMS displacement, m
  bool was_sampled = false;                // false: only a few points of the old curve are known
  Series difference, tolerance;            // positions, m
  std::optional<double> first_divergence;  // s: the first time at which the difference exceeds the tolerance
  std::optional<MethodResult> old_result, new_result;  // for pictures; a baseline stores only the scene's own method

  const Comparison* find(const std::string& quantity) const {
    const auto at = std::ranges::find(rows, quantity, &Comparison::quantity);
    return at == rows.end() ? nullptr : &*at;
  }
};

bool is_of(const Comparison& row, const Case& q) {
  return row.scene == q.scene.name && row.method == q.method.name && row.without == q.without;
}

std::vector<double> times_of(const Case& test_case) {
  const Run run = run_over_window(test_case.scene);
  std::vector<double> times;
  for (int i = 1; i <= run.samples; ++i) times.push_back(run.duration * i / run.samples);
  return times;
}

Series offsets_of(const Trajectory& path) {
  Series series;
  for (int i = 0; i < path.frames(); ++i) series.emplace_back(path.t[i], rms_distance(path.x[i], path.x.front()));
  return series;
}

/// Converts a run to a result that can be drawn; nullopt if the run was refused.
std::optional<MethodResult> pictured(const Case& test_case, const CaseRun& case_run, const std::string& was_or_is) {
  if (case_run.trajectory.x.empty()) return std::nullopt;
  return MethodResult{test_case.scene.name, was_or_is + test_case.method.name, case_run.outcome, case_run.trajectory};
}

bool owns(const Case& q) { return q.without.empty() && q.method.name == find_method(q.scene.method).name; }

/// Compares only at the sampling times that a baseline contains, of which there are at most eight.
void beside_baseline(FailureDetails& e, const Regression& regression) {
  for (const double t : times_of(e.test_case)) {
    const Comparison *offset = e.find(offset_at(t)), *places = e.find(places_at(t));
    if (offset && offset->was) e.was.emplace_back(t, *offset->was);
    // positions may differ although their means over the particles agree
    if (!places || !places->was || !places->is || !std::isfinite(*places->is)) continue;
    e.difference.emplace_back(t, std::abs(*places->is - *places->was));
    e.tolerance.emplace_back(t, places->tolerance);
    if (!e.first_divergence && e.difference.back().second > places->tolerance) e.first_divergence = t;
  }
  if (!owns(e.test_case) || !e.new_result) return;
  const auto shape = read_shape(regression.baselines, e.test_case.scene.name, e.test_case.scene.model.particles.size());
  if (!shape) return;
  e.old_result = MethodResult{e.test_case.scene.name, "was: " + e.test_case.method.name, {}, {}};
  e.old_result->trajectory.t = {shape->t}, e.old_result->trajectory.x = {shape->x};
}

/// Compares both runs at every sample. The tolerance is that of the next time for which baselines have a tolerance.
void beside_other(FailureDetails& e, const Method& against) {
  Case old = e.test_case;
  old.method = against;
  const CaseRun case_run = comparable_part(run_case(old));
  e.was = offsets_of(case_run.trajectory);
  e.was_sampled = true;
  e.old_result = pictured(old, case_run, "was: ");
  for (const double t : times_of(e.test_case))
    if (const Comparison* offset = e.find(offset_at(t))) e.tolerance.emplace_back(t, offset->tolerance);
  if (!e.new_result || e.tolerance.empty()) return;
  const Trajectory &now = e.new_result->trajectory, &before = case_run.trajectory;
  for (int i = 1; i < std::min(now.frames(), before.frames()); ++i) {
    const double distance = rms_distance(now.x[i], before.x[i]);
    const auto known = std::find_if(e.tolerance.begin(), e.tolerance.end(),
                                    [&](const auto& at) { return at.first >= now.t[i] * (1 - 1e-9); });
    if (!std::isfinite(distance) || known == e.tolerance.end()) break;
    e.difference.emplace_back(now.t[i], distance);
    if (!e.first_divergence && distance > known->second) e.first_divergence = now.t[i];
  }
}

/// The curves are empty if the method refused the run.
FailureDetails failure_details(const Case& test_case, const std::vector<Comparison>& rows,
                               const Regression& regression) {
  FailureDetails e{test_case};
  std::ranges::copy_if(rows, std::back_inserter(e.rows), [&](const Comparison& row) { return is_of(row, test_case); });
  const CaseRun case_run = comparable_part(run_case(test_case));
  e.is = offsets_of(case_run.trajectory);
  e.new_result = pictured(test_case, case_run, "is: ");
  if (regression.against)
    beside_other(e, *regression.against);
  else
    beside_baseline(e, regression);
  return e;
}

std::string describe_divergence(const FailureDetails& e) {
  if (e.first_divergence) {
    const auto before = std::find_if(e.difference.rbegin(), e.difference.rend(),
                                     [&](const auto& at) { return at.first < *e.first_divergence * (1 - 1e-9); });
    return fmt::format("They differ by more than the tolerance between {:.4g} s and {:.4g} s.",
                       before == e.difference.rend() ? 0 : before->first, *e.first_divergence);
  }
  return e.difference.empty() ? "There is no common time at which to compare positions."
                              : "Positions stay within their tolerance; other quantities changed.";
}

const MethodStyle old_style{"#5b6670", "2", 6}, new_style{"#d55e00", "1", 7}, tolerance_style{"#009e73", "3", 1};

FigureInfo words_for(const FailureDetails& e, const std::string& what, const std::string& title,
                     const Provenance& lines) {
  FigureInfo words;
  words.name = file_name_of(fmt::format("{} {} {}", e.test_case.scene.name, e.test_case.method.name,
                                        e.test_case.without.empty() ? what : e.test_case.without + " " + what));
  words.title = fmt::format("{}: {}", e.test_case.in_words(), title);
  words.caption =
      fmt::format("Scene {} ({}), commit {}.", e.test_case.scene.name, e.test_case.hash, value_of(lines, "commit"));
  words.finding = describe_divergence(e);
  return words;
}

std::optional<Figure> curves(const FailureDetails& e, const Provenance& lines) {
  Figure f;
  static_cast<FigureInfo&>(f) = words_for(e, "curve", "RMS displacement of the particles", lines);
  f.x = {"t / s"};
  f.y = {"RMS displacement / m"};
  if (!e.was.empty()) f.curves.push_back({"was", old_style, e.was, e.was_sampled, !e.was_sampled});
  if (!e.is.empty()) f.curves.push_back({"is", new_style, e.is});
  for (const Curve& curve : f.curves)
    for (const auto& [t, value] : curve.points)
      if (!std::isfinite(value)) return std::nullopt;
  return f.curves.empty() ? std::nullopt : std::optional(f);
}

std::optional<Figure> difference(const FailureDetails& e, const Provenance& lines) {
  double least = INFINITY;
  for (const auto& [t, tolerance] : e.tolerance)
    if (tolerance > 0) least = std::min(least, tolerance);
  if (e.difference.empty() || !std::isfinite(least)) return std::nullopt;
  const double floor = least / 10;
  const auto above_floor = [floor](Series series) {
    for (auto& [t, value] : series) value = std::max(value, floor);
    return series;
  };
  Figure f;
  static_cast<FigureInfo&>(f) = words_for(e, "difference", "difference from the baseline", lines);
  f.x = {"t / s"};
  f.y = {e.was_sampled ? "RMS position difference / m" : "position difference / m", true};
  f.curves.push_back({"difference", new_style, above_floor(e.difference), true, !e.was_sampled});
  f.curves.push_back({"tolerance", tolerance_style, above_floor(e.tolerance)});
  f.caption += fmt::format(" Drawn no lower than {}, a tenth of the smallest tolerance.", nice_length(floor));
  if (!e.was_sampled) f.caption += " A baseline holds positions along random directions at these times.";
  return f;
}

/// Draws both shapes in one view, coloured by their distance if the distance is large enough to see.
std::optional<PageImage> shapes(const FailureDetails& e, const fs::path& folder) {
  if (!e.new_result || e.new_result->trajectory.x.empty() || e.test_case.scene.model.first_order()) return std::nullopt;
  Shot shot;
  shot.quality = render::Quality::fast;
  shot.width = 1120, shot.height = 420;
  std::vector<const MethodResult*> shown;
  if (e.old_result) {
    shown.push_back(&*e.old_result);
    shot.at = std::min(e.old_result->trajectory.t.back(), e.new_result->trajectory.t.back());
    const Points &was = e.old_result->trajectory.x.back(), &is = e.new_result->trajectory.x.back();
    if (rms_distance(was, is) > 1e-4 * e.test_case.scene.size()) shot.mode = Mode::difference;
  }
  shown.push_back(&*e.new_result);
  PageImage image;
  image.file = folder / (words_for(e, "shape", "", {}).name + ".png");
  render::write_png(picture_of(e.test_case.scene, shown, shot), image.file);
  image.alt = e.old_result ? "the old and the new final shape" : "the new final shape";
  image.caption = e.old_result ? "The old and the new final shape."
                               : "The new final shape; a baseline keeps the shape of the scene's own method only.";
  return image;
}

}  // namespace

std::vector<Case> failures_to_draw(const std::vector<Case>& all, const std::vector<Comparison>& rows, int most) {
  using Rank = std::tuple<bool, bool, double>;  // smallest first; own methods are preferred because only they have an
                                                // old shape
  std::vector<std::pair<Rank, const Case*>> ranked;
  for (const Comparison& row : worst_comparisons(rows))
    for (const Case& q : all)
      if (is_of(row, q) && std::ranges::find(ranked, &q, &std::pair<Rank, const Case*>::second) == ranked.end())
        ranked.push_back({{!q.without.empty(), !owns(q), -row.rank()}, &q});
  std::ranges::stable_sort(ranked, {}, &std::pair<Rank, const Case*>::first);
  std::set<std::string> scenes;
  std::vector<Case> first, others;
  for (const auto& [rank, q] : ranked) (scenes.insert(q->scene.name).second ? first : others).push_back(*q);
  first.insert(first.end(), others.begin(), others.end());
  if (static_cast<int>(first.size()) > most) first.erase(first.begin() + most, first.end());
  return first;
}

FailurePart drawn_failure(const Case& test_case, const std::vector<Comparison>& rows, const Regression& regression,
                          const Provenance& lines, std::vector<std::string>& problems) {
  const FailureDetails e = failure_details(test_case, rows, regression);
  const fs::path folder = regression.out / "figures";
  FailurePart part{test_case.scene.name, test_case.in_words(), describe_divergence(e), {}};
  for (const auto& figure : {curves(e, lines), difference(e, lines)}) {
    if (!figure) continue;
    try {
      draw(drawing_of(*figure), lines, folder);
      part.images.push_back({folder / (figure->name + ".svg"), figure->finding, figure->caption});
    } catch (const std::runtime_error& error) {
      problems.push_back(error.what());
    }
  }
  try {
    if (auto image = shapes(e, folder)) part.images.push_back(*image);
  } catch (const std::exception& error) {
    problems.push_back(fmt::format("picture of {}: {}", part.heading, error.what()));
  }
  return part;
}

}  // namespace crosscheck
