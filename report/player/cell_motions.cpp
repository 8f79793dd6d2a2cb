#include "report/player/cell_motions.h"

#include <cmath>

#include "reference/exact/eigenvalues.h"
#include "report/figure.h"
#include "report/player/packed_numbers.h"
#include "report/player/quantised.h"
#include "report/player/still_parts.h"

namespace crosscheck {
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
  const QuantisedPlaces places = quantised(rests);
  const MethodStyle style = style_of(watched.method);
  Json json{{"name", watched.method}, {"colour", style.colour}, {"dash", ""}, {"note", ""}};
  json["low"] = vector_json(places.low), json["unit"] = vector_json(places.unit);
  json["rests"] = packed_json(packed(places.numbers, static_cast<size_t>(3 * rests[0].cols()), 1));
  json["cells"] = std::move(cells);
  json["shapes"] = packed_json(packed(std::move(numbers.shapes), 1, 0));
  json["paths"] = packed_json(packed(std::move(numbers.paths), 1, 0));
  return json.dump();
}

}  // namespace crosscheck
