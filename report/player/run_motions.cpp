#include "report/player/run_motions.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/metrics.h"
#include "report/player/packed_numbers.h"
#include "report/player/player_data.h"
#include "report/player/quantised.h"
#include "report/player/shown.h"
#include "report/player/still_parts.h"

namespace crosscheck {
namespace {

using Json = nlohmann::ordered_json;

constexpr long lowest = -24576, highest = lowest + 65535;  // the truth's own numbers lie from 0 to 16383

/// The truth as the scene's player packs it, and every how many of its frames a run has one.
struct Lattice {
  Shown truth;
  QuantisedPlaces places;
  Vec3 unit;  // m; where the truth lies in a plane a run may leave it
  size_t every = 1;
  double reach = 0;  // m, as far as anything is from its start
  double until = 0;  // s, as far as single places can be compared
};

Lattice lattice_of(const Shown& truth, double size, double until) {
  Lattice lattice{truth, quantised(truth.x), {}, 1, size, until};
  const Vec3& unit = lattice.places.unit;
  lattice.unit = (unit.array() > 0).select(unit, std::max(unit.maxCoeff(), 1e-4 * size));
  const size_t frames = truth.x.size(), most = truth.x[0].cols() > 100 ? 50 : 100;
  lattice.every = (frames - 1 + most - 1) / most;
  for (const Points& x : truth.x) lattice.reach = std::max(lattice.reach, (x - truth.x[0]).cwiseAbs().maxCoeff());
  return lattice;
}

/// Places of a frame less those of the truth at its own, appended.
void add_difference(const Lattice& lattice, const Points& x, size_t frame, std::vector<std::uint16_t>& numbers) {
  const auto per_frame = static_cast<size_t>(3 * x.cols());
  const size_t truth = std::min(frame, lattice.truth.x.size() - 1) * per_frame;
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    for (int k = 0; k < 3; ++k) {
      const long place = std::lround((x(k, i) - lattice.places.low[k]) / lattice.unit[k]);
      const long known = lattice.places.numbers[truth + static_cast<size_t>(3 * i + k)];
      numbers.push_back(static_cast<std::uint16_t>(std::clamp(place, lowest, highest) - known));
    }
}

Json run_json(const Lattice& lattice, const WatchedRuns& watched, const WatchedRun& run, int stride) {
  const Answer answer{watched.scene.name, watched.method, run.outcome, {}, {}, false};
  Shown shown{&answer, watched.method, {}, {}, {}};
  std::vector<std::uint16_t> numbers;
  Json errors = Json::array();
  for (size_t f = 0;; f += lattice.every) {
    const size_t sample = f * static_cast<size_t>(stride);
    if (sample >= run.path.x.size() || !run.path.x[sample].allFinite()) break;
    const Points& x = run.path.x[sample];
    if ((x - run.path.x[0]).cwiseAbs().maxCoeff() > 3 * lattice.reach) break;
    shown.t.push_back(run.path.t[sample]);
    add_difference(lattice, x, f, numbers);
    if (run.path.t[sample] > lattice.until * (1 + 1e-9)) continue;
    const double error = f < lattice.truth.x.size() ? rms_distance(x, lattice.truth.x[f]) : 0;
    errors.push_back(error > 0 ? Json(std::round(100 * std::log10(error)) / 100) : Json());
  }
  if (shown.t.empty()) return nullptr;
  Json json = words_json(shown);
  for (const char* each : {"name", "colour", "dash", "known", "note"}) json.erase(each);  // said once for all runs
  json["frames"] = shown.t.size();
  const Outcome& out = run.outcome;
  json["call"] = out.tolerance > 0 ? fmt::format("--tol {}", out.tolerance) : fmt::format("--step {}", out.step);
  json["places"] = packed_json(packed(std::move(numbers), static_cast<size_t>(3 * run.path.x[0].cols()), 2));
  json["plotted"] = std::move(errors);
  return json;
}

}  // namespace

std::string run_motions_json(const WatchedRuns& watched, const std::optional<Truth>& truth) {
  const int stride = frame_stride(watched.scene);
  if (stride == 0 || !truth) return "";
  const Lattice lattice =
      lattice_of(shown_of(*truth, stride), watched.scene.size(), std::min(watched.scene.window, truth->until));
  Answer first{watched.scene.name, watched.method, watched.runs.front().outcome, {}, {}, false};
  first.outcome.verdict = Verdict::ok;
  Json json = words_json({&first, watched.method, {0}, {}, {}});
  json["every"] = lattice.every, json["low"] = vector_json(lattice.places.low),
  json["unit"] = vector_json(lattice.unit);
  json["runs"] = Json::array();
  for (const WatchedRun& run : watched.runs) json["runs"].push_back(run_json(lattice, watched, run, stride));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace crosscheck
