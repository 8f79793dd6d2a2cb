// Thins trajectories, cuts what has left the picture, computes colour values, plots and words.
#include "report/player/thinned_trajectory.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mysim/model/energy.h"
#include "report/figures/figure.h"
#include "report/findings/report_data.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {
namespace {

constexpr int most_places = 150 * 64 * 64;  // of one method: about a megabyte of the page
constexpr int fewest_frames = 25;
constexpr int numbers_of_16_bits = 1 << 16;

ThinnedTrajectory thinned(const Result* answer, const std::string& name, const Trajectory& path, int stride) {
  ThinnedTrajectory shown{answer, name, {}, {}, {}};
  for (int i = 0; i < path.frames() && path.x[i].allFinite(); i += stride) {
    shown.t.push_back(path.t[i]);
    shown.x.push_back(path.x[i]);
    shown.v.push_back(i < std::ssize(path.v) ? path.v[i] : Points(3, 0));
  }
  return shown;
}

/// The farthest that a coordinate is from its start, m.
double moved(const Points& x, const Points& start) { return (x - start).cwiseAbs().maxCoeff(); }

/// A failed run is shown while it stays within three times the extent of the others: further out no camera sees it, and
/// the lattice of its places would be coarse.
void cut_failed(double size, std::vector<ThinnedTrajectory>& all) {
  double reach = size;
  for (const ThinnedTrajectory& s : all)
    for (const Points& x : s.x)
      if (s.ok()) reach = std::max(reach, moved(x, s.x[0]));
  for (ThinnedTrajectory& s : all) {
    if (s.ok()) continue;
    size_t keep = 1;
    while (keep < s.x.size() && moved(s.x[keep], s.x[0]) < 3 * reach) ++keep;
    s.x.resize(keep), s.v.resize(keep), s.t.resize(keep);
  }
}

}  // namespace

int frame_stride(const Scene& scene) {
  const int particles = std::max(1, scene.model.particles.size());
  const int most = std::min(particles > 250 ? 150 : 300, most_places / particles);
  if (most < fewest_frames || particles >= numbers_of_16_bits) return 0;
  const int least = std::max(1, (scene.samples + most - 1) / most);
  for (int stride = least; stride < 2 * least; ++stride)
    if (scene.samples % stride == 0) return stride;
  return least;
}

ThinnedTrajectory thin(const Truth& truth, int stride) {
  return thinned(nullptr,
                 truth.under_contact_rule ? "converged contact rule" : fmt::format("truth ({})", name_of(truth.tier)),
                 truth.trajectory, stride);
}

std::vector<ThinnedTrajectory> thin(const Scene& scene, const std::vector<const Result*>& answers,
                                    const std::optional<Truth>& truth) {
  const int stride = frame_stride(scene);
  std::vector<ThinnedTrajectory> all;
  if (stride == 0) return all;
  const auto add = [&](ThinnedTrajectory shown) {
    if (!shown.x.empty()) all.push_back(std::move(shown));  // the first sample may fail already
  };
  for (const Result* a : answers) add(thinned(a, a->method, a->trajectory, stride));
  if (truth && !all.empty()) add(thin(*truth, stride));
  cut_failed(scene.size(), all);
  return all;
}

Lattice lattice_of(const std::vector<ThinnedTrajectory>& all) {
  if (!all.back().answer) return lattice_around(all.back().x);
  std::vector<Points> seen;
  for (const bool failed : {false, true})
    for (const ThinnedTrajectory& s : all)
      if (s.ok() != failed && (!failed || seen.empty())) seen.insert(seen.end(), s.x.begin(), s.x.end());
  return lattice_around(seen);
}

namespace {

void find_top(ColourValues& values, const std::vector<ThinnedTrajectory>& all) {
  for (size_t m = 0; m < all.size(); ++m)
    for (const double v : values.of[m])
      if (all[m].ok()) values.top = std::max(values.top, v);
  if (values.top > 0) values.top = round_up(values.top);
}

}  // namespace

ColourValues stretch_values(const Scene& scene, const std::vector<ThinnedTrajectory>& all) {
  ColourValues values;
  for (const ThinnedTrajectory& s : all) {
    auto& own = values.of.emplace_back();
    for (const Points& x : s.x)
      for (const double strain : stretch_of(scene, x)) own.push_back(strain);
  }
  find_top(values, all);
  return values;
}

ColourValues distance_values(const std::vector<ThinnedTrajectory>& all, const ThinnedTrajectory& truth, double until,
                             double error_bar) {
  ColourValues values;
  for (const ThinnedTrajectory& s : all) {
    auto& own = values.of.emplace_back();
    for (size_t f = 0; &s != &truth && f < std::min(s.x.size(), truth.x.size()); ++f) {
      if (s.t[f] > until * (1 + 1e-9)) break;
      for (Eigen::Index i = 0; i < s.x[f].cols(); ++i) own.push_back(1e3 * (s.x[f].col(i) - truth.x[f].col(i)).norm());
    }
  }
  find_top(values, all);
  if (values.top < 1e3 * error_bar) values.top = 0;
  return values;
}

std::vector<std::optional<double>> plotted_values(const Scene& scene, const ThinnedTrajectory& s,
                                                  const ThinnedTrajectory* truth) {
  std::vector<std::optional<double>> list(s.x.size());
  for (size_t f = 0; f < s.x.size(); ++f) {
    if (!scene.model.first_order()) {
      if (s.v[f].cols() == s.x[f].cols()) list[f] = energy_of(scene.model, {s.t[f], s.x[f], s.v[f]}).total();
    } else if (truth && f < truth->x.size()) {
      list[f] = 1e3 * rms_distance(s.x[f], truth->x[f]);
    }
  }
  return list;
}

namespace {

/// gnuplot's "(14,4)" as SVG's "14 4".
std::string dashes_of(const MethodStyle& style) {
  if (style.dash == "1") return "";
  std::string dash = style.dash.substr(1, style.dash.size() - 2);
  std::replace(dash.begin(), dash.end(), ',', ' ');
  return dash;
}

/// The reason why a run failed, without saying again that it did, and when.
std::string why_failed(const Outcome& out) {
  const std::string words(in_words(out.verdict));
  const size_t open = words.find('(');
  std::string why = open == std::string::npos ? "" : words.substr(open + 1, words.size() - open - 2);
  std::string told = out.reason;
  if (told.starts_with("the run failed at"))
    told = told.find(": ") == std::string::npos ? "" : told.substr(told.find(": ") + 2);
  if (!told.empty()) why += (why.empty() ? "" : "; ") + told;
  return why.empty() ? words : why;
}

}  // namespace

Json motion_info_json(const ThinnedTrajectory& s) {
  Json json{{"name", s.name}, {"colour", "#555555"}, {"dash", "1 4"}, {"stops", s.t.back()}, {"failed", nullptr},
            {"failure", ""},  {"reason", ""},        {"note", ""},    {"known", !s.answer}};
  json["end"] = s.answer ? "last good frame" : fmt::format("known up to {:.3g} s", s.t.back());
  if (!s.answer) return json;
  const Outcome& out = s.answer->outcome;
  json["colour"] = style_of(s.answer->method).colour;
  json["dash"] = dashes_of(style_of(s.answer->method));
  if (!out.different_law.empty()) json["note"] = fmt::format("{}", fmt::join(out.different_law, "; "));
  if (s.ok()) return json;
  json["failed"] = out.end;
  json["failure"] = fmt::format("{} at {:.3g} s", failure_class(std::string(name_of(out.verdict))), out.end);
  json["reason"] = why_failed(out);
  return json;
}

}  // namespace crosscheck
