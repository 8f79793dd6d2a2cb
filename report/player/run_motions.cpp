// Runs as differences from the truth; cells as a few shapes of changing size.
#include "report/player/run_motions.h"

#include <fmt/ranges.h>

#include <cmath>

#include "experiments/metrics.h"
#include "mysim/base/eigenvalues.h"
#include "mysim/model/energy.h"
#include "report/figures/figure.h"
#include "report/player/packed_numbers.h"
#include "report/player/static_geometry.h"
#include "report/player/thinned_trajectory.h"

namespace crosscheck {
namespace {

/// The reference that a scene's runs are packed against.
struct Against {
  const Scene& scene;
  ThinnedTrajectory truth;  // at the frames of the scene's player
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
  const ThinnedTrajectory shown = thin(truth, stride);
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
          {"places", packed_json(pack(std::move(numbers), static_cast<size_t>(run.path.x[0].size()), 2))},
          {"plotted", std::move(errors)}};
}

/// The last pictures of one that failed, as far as they are near the others; null where there are none.
Json last_pictures(const Against& a, const WatchedRuns& watched, const WatchedRun& run) {
  const Result answer{a.scene.name, watched.method, run.outcome, {}, {}, false};
  double reach = a.scene.size();
  for (const Points& x : a.truth.x) reach = std::max(reach, (x - a.truth.x[0]).cwiseAbs().maxCoeff());
  ThinnedTrajectory shown{&answer, watched.method, {}, {}, {}};
  for (size_t f = 0; f < run.path.x.size(); ++f) {
    if ((run.path.x[f] - a.truth.x[0]).cwiseAbs().maxCoeff() > 3 * reach) break;
    shown.t.push_back(run.path.t[f]), shown.x.push_back(run.path.x[f]), shown.v.push_back(run.path.v[f]);
  }
  if (shown.t.size() < 2) return nullptr;
  QuantisedPositions places = quantise(shown.x);
  for (auto& number : places.numbers) number = static_cast<std::uint16_t>(number / a.grain);
  const Vec3 unit = places.unit * static_cast<double>(a.grain);
  Json json = motion_info_json(shown);
  for (const char* each : {"name", "colour", "dash", "known", "note"}) json.erase(each);  // said once for all runs
  json["frames"] = shown.t.size();
  json["times"] = shown.t;
  json["low"] = vector_json(places.low), json["unit"] = vector_json(unit);
  json["places"] = packed_json(pack(places.numbers, static_cast<size_t>(shown.x[0].size()), 1));
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
  Result any{watched.scene.name, watched.method, watched.runs.front().outcome, {}, {}, false};
  any.outcome.verdict = Verdict::ok;  // what they all are
  Json json = motion_info_json({&any, watched.method, {0}, {}, {}});
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

namespace {

constexpr double left_out = 0.01;                       // of the largest departure
constexpr double shape_steps = 127, path_steps = 2047;  // of the largest number: finer than what is left out

double two_digits(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::round(value / unit) * unit;
}
double four_digits(double value) {
  if (value == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
  return std::round(value / unit) * unit;
}

/// Departures from rest, a column for each picture up to where the run has left the picture: a run that blows up may go
/// on for long after that.
Eigen::MatrixXd departures_of(const WatchedRun& run, double size) {
  Eigen::MatrixXd all(run.rest.size(), run.path.frames());
  int frames = 0;
  for (; frames < run.path.frames(); ++frames) {
    const Points off = run.path.x[static_cast<size_t>(frames)] - run.rest;
    if (!off.allFinite() || off.cwiseAbs().maxCoeff() > 2 * size) break;
    all.col(frames) = off.reshaped();
  }
  return all.leftCols(frames);
}

double shortest_spring(const WatchedRun& run, const Scene& scene) {
  double shortest = scene.size();
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) {
      const double length = (run.rest.col(s.a) - run.rest.col(s.b)).norm();
      if (length > 1e-6 * scene.size()) shortest = std::min(shortest, length);
    }
  return shortest;
}

/// Numbers of both signs as they are packed: zigzag is done there.
void add_whole(const Eigen::VectorXd& values, double unit, std::vector<std::uint16_t>& numbers) {
  for (const double v : values)
    numbers.push_back(static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(v / unit))));
}

struct Numbers {
  std::vector<std::uint16_t> shapes, paths;
};

Json cell_json(const WatchedRun& run, const Scene& scene, size_t row, Numbers& numbers) {
  const Eigen::MatrixXd off = departures_of(run, scene.size());
  const double largest = off.size() > 0 ? off.cwiseAbs().maxCoeff() : 0;
  if (off.cols() < 2 || !(largest > 0)) return nullptr;
  // the shapes are the left singular vectors; few pictures make their squares' matrix the small one
  const Eigensystem squares = symmetric_eigensystem(off.transpose() * off);
  Eigen::MatrixXd rest = off;
  Json metres = Json::list();
  for (Eigen::Index k = off.cols() - 1; k >= 0 && rest.cwiseAbs().maxCoeff() > left_out * largest; --k) {
    const Eigen::VectorXd path = squares.vectors.col(k), shape = off * path;
    rest -= shape * path.transpose();
    const double shape_unit = shape.cwiseAbs().maxCoeff() / shape_steps,
                 path_unit = path.cwiseAbs().maxCoeff() / path_steps;
    if (!(shape_unit > 0)) break;
    add_whole(shape, shape_unit, numbers.shapes);
    add_whole(path, path_unit, numbers.paths);
    metres.push(four_digits(shape_unit * path_unit));
  }
  const double seen = shortest_spring(run, scene) / 3;
  const auto last = static_cast<size_t>(off.cols() - 1);
  return Json::list(
      row, off.cols(), four_digits((run.path.t[last] - run.path.t[0]) / static_cast<double>(last)),
      four_digits(run.path.t[last]), largest < seen ? two_digits(seen / largest) : 1., std::move(metres),
      off.cols() < run.path.frames() ? four_digits(run.outcome.end) : 0.);  // where it left: when it ended
}

}  // namespace

std::string cell_motions_json(const WatchedRuns& watched) {
  std::vector<Points> rests;
  Numbers numbers;
  Json cells = Json::list();
  for (const WatchedRun& run : watched.runs) {
    if (rests.empty() || rests.back() != run.rest) rests.push_back(run.rest);
    cells.push(cell_json(run, watched.scene, rests.size() - 1, numbers));
  }
  const QuantisedPositions places = quantise(rests);
  const MethodStyle style = style_of(watched.method);
  Json json{{"name", watched.method}, {"colour", style.colour}, {"dash", ""}, {"note", ""}};
  json["low"] = vector_json(places.low), json["unit"] = vector_json(places.unit);
  json["rests"] = packed_json(pack(places.numbers, static_cast<size_t>(3 * rests[0].cols()), 1));
  json["cells"] = std::move(cells);
  json["shapes"] = packed_json(pack(std::move(numbers.shapes), 1, 0));
  json["paths"] = packed_json(pack(std::move(numbers.paths), 1, 0));
  return json.dump();
}

}  // namespace crosscheck
