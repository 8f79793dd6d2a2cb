#include "report/player/run_motions.h"

#include <fmt/ranges.h>

#include <cmath>

#include "experiments/metrics.h"
#include "mysim/energy.h"
#include "report/figure.h"
#include "report/player/packed_numbers.h"
#include "report/player/quantised.h"
#include "report/player/shown.h"
#include "report/player/still_parts.h"
#include "report/player/words.h"

namespace crosscheck {
namespace {

/// What a scene's runs are packed against.
struct Against {
  const Scene& scene;
  Shown truth;  // at the frames of the scene's player
  Lattice lattice;
  std::vector<std::uint16_t> numbers;  // of the truth
  double until;                        // s, as far as single places can be compared
  int stride;                          // samples from frame to frame of the player
  size_t every;                        // frames of the player from one to the next of a run
  long grain;                          // a difference counts so many units of the lattice
};

/// Every how many of some frames there are at most so many: a divisor, so that the last one is among them, unless that
/// is far.
size_t thinned(size_t frames, size_t most) {
  const size_t least = std::max<size_t>(1, (frames + most - 1) / most);
  for (size_t every = least; every < 2 * least; ++every)
    if (frames % every == 0) return every;
  return least;
}

Against against(const Scene& scene, const Truth& truth, int stride) {
  const bool many = scene.model.particles.size() > 40;  // then fewer frames, less finely, are as much as is seen
  const Shown shown = shown_of(truth, stride);
  const Lattice lattice = lattice_of({shown});
  return {scene,
          shown,
          lattice,
          lattice.numbers_of(shown.x).value(),
          std::min(scene.window, truth.until),
          stride,
          thinned(shown.x.size() - 1, many ? 30 : 100),
          many ? 8 : 1};
}

/// Places of a frame less those of the truth at its own, appended; within 32767 grains of it.
void add_difference(const Against& a, const Points& x, size_t frame, std::vector<std::uint16_t>& numbers) {
  const size_t known = std::min(frame, a.truth.x.size() - 1) * static_cast<size_t>(x.size());
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double place = (x(k, i) - a.lattice.low[k]) / a.lattice.unit;
      const double apart = (place - a.numbers[known + static_cast<size_t>(3 * i + k)]) / static_cast<double>(a.grain);
      numbers.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(apart, -32767., 32767.))));
    }
}

/// A run that came to its end.
Json whole_run(const Against& a, const WatchedRun& run) {
  std::vector<std::uint16_t> numbers;
  Json errors = Json::list();
  size_t f = 0;
  for (size_t sample = 0; sample < run.path.x.size(); f += a.every, sample = f * static_cast<size_t>(a.stride)) {
    const Points& x = run.path.x[sample];
    add_difference(a, x, f, numbers);
    if (run.path.t[sample] > a.until * (1 + 1e-9) || f >= a.truth.x.size()) continue;
    const double error = rms_distance(x, a.truth.x[f]);
    errors.push(error > 0 ? Json(std::round(100 * std::log10(error)) / 100) : Json());
  }
  return {{"frames", f / a.every},
          {"places", packed_json(packed(std::move(numbers), static_cast<size_t>(run.path.x[0].size()), 2))},
          {"plotted", std::move(errors)}};
}

/// The last pictures of one that failed, as far as they are near the others; null where there are none.
Json last_pictures(const Against& a, const WatchedRuns& watched, const WatchedRun& run) {
  const Answer answer{a.scene.name, watched.method, run.outcome, {}, {}, false};
  double reach = a.scene.size();
  for (const Points& x : a.truth.x) reach = std::max(reach, (x - a.truth.x[0]).cwiseAbs().maxCoeff());
  Shown shown{&answer, watched.method, {}, {}, {}};
  for (size_t f = 0; f < run.path.x.size(); ++f) {
    if ((run.path.x[f] - a.truth.x[0]).cwiseAbs().maxCoeff() > 3 * reach) break;
    shown.t.push_back(run.path.t[f]), shown.x.push_back(run.path.x[f]), shown.v.push_back(run.path.v[f]);
  }
  if (shown.t.size() < 2) return nullptr;
  QuantisedPlaces places = quantised(shown.x);
  for (auto& number : places.numbers) number = static_cast<std::uint16_t>(number / a.grain);
  const Vec3 unit = places.unit * static_cast<double>(a.grain);
  Json json = words_json(shown);
  for (const char* each : {"name", "colour", "dash", "known", "note"}) json.erase(each);  // said once for all runs
  json["frames"] = shown.t.size();
  json["times"] = shown.t;
  json["low"] = vector_json(places.low), json["unit"] = vector_json(unit);
  json["places"] = packed_json(packed(places.numbers, static_cast<size_t>(shown.x[0].size()), 1));
  json["plotted"] = Json::list();
  for (size_t k = 0; k < shown.t.size(); ++k) {
    const double kinetic =
        shown.v[k].size() > 0 ? energy_of(a.scene.model, {shown.t[k], shown.x[k], shown.v[k]}).kinetic : 0;
    json["plotted"].push(kinetic > 0 ? Json(std::round(100 * std::log10(kinetic)) / 100) : Json());
  }
  return json;
}

}  // namespace

std::string run_motions_json(const WatchedRuns& watched, const std::optional<Truth>& truth) {
  const int stride = frame_stride(watched.scene);
  if (stride == 0 || !truth) return "";
  const Against a = against(watched.scene, *truth, stride);
  Answer any{watched.scene.name, watched.method, watched.runs.front().outcome, {}, {}, false};
  any.outcome.verdict = Verdict::ok;  // what they all are
  Json json = words_json({&any, watched.method, {0}, {}, {}});
  json["every"] = a.every, json["grain"] = a.grain;
  json["runs"] = Json::list();
  for (const WatchedRun& run : watched.runs) {
    const Outcome& out = run.outcome;
    Json own = out.verdict == Verdict::ok ? whole_run(a, run) : last_pictures(a, watched, run);
    if (!own.is_null())
      own["call"] = out.tolerance > 0 ? fmt::format("--tol {}", out.tolerance) : fmt::format("--step {}", out.step);
    json["runs"].push(std::move(own));
  }
  return json.dump();
}

}  // namespace crosscheck
