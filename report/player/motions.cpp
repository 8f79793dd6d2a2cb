// Departures as shapes; runs, last pictures and cells as motions; a scene's stage.
#include "report/player/motions.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "experiments/metrics.h"
#include "mysim/base/text.h"
#include "mysim/eigenvalues.h"
#include "mysim/model/energy.h"
#include "report/findings/report_data.h"
#include "report/pictures/scene_picture.h"
#include "report/player/computed_cells.h"
#include "report/player/packed_numbers.h"
#include "report/player/static_geometry.h"

namespace crosscheck {
namespace {

constexpr int most_places = 150 * 64 * 64;  // of one method: about a megabyte of the page
constexpr int fewest_frames = 25;
constexpr int numbers_of_16_bits = 1 << 16;
constexpr double largest_number = 32767;

/// As many digits as a reader of a plot needs. A motion that drag has taken may be denormal, which stod throws at.
double five_digits(double value) { return std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr); }
double two_digits(double value) { return std::strtod(fmt::format("{:.2g}", value).c_str(), nullptr); }

/// How finely a motion is told: parts of its largest departure, and of the scene's size.
struct Fineness {
  double of_departure, of_size;
};
constexpr Fineness of_base{0, 8000}, of_own_run{60, 3000}, of_run{60, 1000}, of_failed{100, 500}, of_cell{100, 0};

/// Numbers of several motions, one after the other.
class MotionNumbers {
 public:
  /// {"modes", "frames", "unit", "path"} of departures, a column for each frame; finer than `least` (m) tells nothing.
  Json add(const Eigen::MatrixXd& departures, Fineness fineness, double size, double least = 0) {
    const double largest = departures.size() > 0 ? departures.cwiseAbs().maxCoeff() : 0;
    Json json{{"modes", 0}, {"frames", departures.cols()}};
    if (!(largest > 0)) return json;
    double within = INFINITY;  // m
    // of what no view shows, a millionth of the scene, the shape is enough
    if (fineness.of_departure > 0) within = largest / (largest < 1e-6 * size ? 0.3 : 1) / fineness.of_departure;
    if (fineness.of_size > 0) within = std::min(within, size / fineness.of_size);
    within = std::max(within, least);
    // few frames make the matrix of their products the small one
    const Eigensystem products = symmetric_eigensystem(departures.transpose() * departures);
    Eigen::MatrixXd rest = departures;
    Eigen::Index modes = 0, frames = departures.cols();
    while (modes < frames && rest.cwiseAbs().maxCoeff() > within) {
      const Eigen::VectorXd path = products.vectors.col(frames - ++modes);
      rest -= (rest * path) * path.transpose();
    }
    if (modes == 0) return json;
    const Eigen::MatrixXd paths = products.vectors.rightCols(modes), found = departures * paths;
    // paths of all frames are of length 1 at most together: what rounding of the shapes costs does not add up
    const double unit = five_digits(std::max(2 * within, found.cwiseAbs().maxCoeff() / largest_number * 1.001));
    // those of the paths do: together they cost half of what is allowed at most
    const double sizes = found.cwiseAbs().colwise().maxCoeff().sum();
    const double path_unit = five_digits(
        std::max(fineness.of_departure > 0 ? within / sizes : 0, paths.cwiseAbs().maxCoeff() / largest_number * 1.001));
    for (Eigen::Index k = modes; k-- > 0;) append(found.col(k), unit, shapes_), append(paths.col(k), path_unit, paths_);
    json["modes"] = modes, json["unit"] = unit, json["path"] = path_unit;
    return json;
  }
  /// Values over 0 as exponents; what is none is 0.
  void add_value(std::optional<double> value) {
    const double exponent = value && *value > 0 ? 2000 * std::log10(*value) + 40000 : 0;
    values_.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(exponent, value ? 1. : 0., 65535.))));
  }
  void write(Json& file) {
    file["shapes"] = packed_json(pack_small(std::move(shapes_)));
    file["paths"] = packed_json(pack_small(std::move(paths_)));
    file["values"] = packed_json(pack_small(std::move(values_)));
  }

 private:
  static void append(const Eigen::VectorXd& values, double unit, std::vector<std::uint16_t>& numbers) {
    for (const double v : values)
      numbers.push_back(static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(v / unit))));
  }
  std::vector<std::uint16_t> shapes_, paths_, values_;
};

/// The frames of a run, as far as they are finite.
struct Frames {
  std::vector<double> t;
  std::vector<Points> x, v;
};
Frames every(const Trajectory& path, size_t stride) {
  Frames out;
  for (size_t i = 0; i < path.x.size() && path.x[i].allFinite(); i += stride) {
    out.t.push_back(path.t[i]), out.x.push_back(path.x[i]);
    out.v.push_back(i < path.v.size() ? path.v[i] : Points(3, 0));
  }
  return out;
}

/// Cuts a run that failed where it leaves three times the bounds of the base: no camera sees it further out.
void cut(Frames& run, const MotionBase& base, double size) {
  double reach = size;
  for (const Points& x : base.x) reach = std::max(reach, (x - base.x[0]).cwiseAbs().maxCoeff());
  size_t keep = 0;
  while (keep < run.x.size() && (run.x[keep] - base.x[0]).cwiseAbs().maxCoeff() < 3 * reach) ++keep;
  run.t.resize(keep), run.x.resize(keep), run.v.resize(keep);
}

/// Departures from the base's frame f * step, or its last one; step 0: from its first.
Eigen::MatrixXd departures_of(const std::vector<Points>& x, const std::vector<Points>& base, size_t step) {
  Eigen::MatrixXd all(x.empty() ? 0 : x[0].size(), x.size());
  for (size_t f = 0; f < x.size(); ++f)
    all.col(static_cast<Eigen::Index>(f)) = (x[f] - base[std::min(f * step, base.size() - 1)]).reshaped();
  return all;
}

/// The reason why a run failed, without the words that it did, and when.
std::string why_failed(const Outcome& out) {
  const std::string words(in_words(out.verdict));
  const size_t open = words.find('(');
  std::string why = open == std::string::npos ? "" : words.substr(open + 1, words.size() - open - 2);
  std::string reason = out.reason;
  if (reason.starts_with("the run failed at"))
    reason = reason.find(": ") == std::string::npos ? "" : reason.substr(reason.find(": ") + 2);
  if (!reason.empty()) why += (why.empty() ? "" : "; ") + reason;
  return why.empty() ? words : why;
}

void add_outcome(Json& json, const Outcome& out) {
  out.tolerance > 0 ? json["tolerance"] = out.tolerance : json["step"] = out.step;
  if (out.verdict == Verdict::ok) return;
  json["failed"] = out.end;
  json["failure"] = fmt::format("{} at {:.3g} s", failure_class(std::string(name_of(out.verdict))), out.end);
  json["reason"] = why_failed(out);
}

/// Errors, then kinetic energies, of each frame; `step` frames of the base from one to the next, 0: no errors.
void add_values(const Scene& scene, const Frames& run, const MotionBase& base, size_t step, MotionNumbers& numbers) {
  const int stride = frame_stride(scene);
  for (size_t f = 0; f < run.x.size(); ++f) {
    const size_t sample = f * step * static_cast<size_t>(stride);
    const bool judged = step > 0 && base.truth && sample < base.truth->trajectory.x.size() &&
                        run.t[f] <= std::min(scene.window, base.truth->until) * (1 + 1e-9);
    numbers.add_value(judged ? std::optional(rms_distance(run.x[f], base.truth->trajectory.x[sample])) : std::nullopt);
  }
  for (size_t f = 0; f < run.x.size(); ++f)
    numbers.add_value(run.v[f].cols() == run.x[f].cols()
                          ? std::optional(energy_of(scene.model, {run.t[f], run.x[f], run.v[f]}).kinetic)
                          : std::nullopt);
}

/// The stride that leaves at most so many frames: a divisor, so that the last frame is kept, unless that is too large.
size_t thinned(size_t frames, size_t most) {
  const size_t least = std::max<size_t>(1, (frames + most - 1) / most);
  for (size_t step = least; step < 2 * least; ++step)
    if (frames % step == 0) return step;
  return least;
}

/// A run at frames of the scene.
Json whole_run(const Scene& scene, const MotionBase& base, const RecordedRun& run, size_t most, Fineness fineness,
               MotionNumbers& numbers) {
  const size_t step = thinned(base.x.size() - 1, most);
  Frames frames = every(run.path, step * static_cast<size_t>(frame_stride(scene)));
  if (run.outcome.verdict != Verdict::ok) cut(frames, base, scene.size());
  if (frames.x.size() < 2) return nullptr;
  Json json = numbers.add(departures_of(frames.x, base.x, step), fineness, scene.size(),
                          base.truth ? base.truth->error_bar / 2 : 0);
  add_values(scene, frames, base, step, numbers);
  json["every"] = step, json["stops"] = frames.t.back();
  add_outcome(json, run.outcome);
  return json;
}

/// The last pictures of a run that failed.
Json last_pictures(const Scene& scene, const MotionBase& base, const RecordedRun& run, MotionNumbers& numbers) {
  Frames frames = every(run.path, 1);
  cut(frames, base, scene.size());
  if (frames.x.size() < 2) return nullptr;
  Json json = numbers.add(departures_of(frames.x, base.x, 0), of_failed, scene.size());
  add_values(scene, frames, base, 0, numbers);
  json["at"] = 0, json["times"] = Json::array(), json["stops"] = frames.t.back();
  for (const double t : frames.t) json["times"].push_back(five_digits(t));
  add_outcome(json, run.outcome);
  return json;
}

double shortest_spring(const Points& rest, const Scene& scene) {
  double shortest = scene.size();
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) {
      const double length = (rest.col(s.a) - rest.col(s.b)).norm();
      if (length > 1e-6 * scene.size()) shortest = std::min(shortest, length);
    }
  return shortest;
}

/// The pictures of a map's cell up to where the run leaves the frame, as one that blows up may go on for long.
struct CellPictures {
  std::vector<Points> x;        // m
  Eigen::MatrixXd off;          // from rest, m, a column for each picture
  Json words = Json::object();  // what the player says of them
};

/// Nothing where nothing moves in two pictures.
std::optional<CellPictures> cell_pictures(const Scene& scene, const RecordedRun& run, size_t row) {
  Frames frames = every(run.path, 1);
  const Points& rest = run.cell->rest;
  size_t keep = 0;
  while (keep < frames.x.size() && (frames.x[keep] - rest).cwiseAbs().maxCoeff() <= 2 * scene.size()) ++keep;
  frames.x.resize(keep);
  if (keep < 2) return std::nullopt;
  CellPictures out{frames.x, departures_of(frames.x, {rest}, 0)};
  const double largest = out.off.cwiseAbs().maxCoeff(), seen = shortest_spring(rest, scene) / 3;
  if (!(largest > 0)) return std::nullopt;
  out.words["at"] = row;
  out.words["times"] = Json::array({five_digits(frames.t[0]), five_digits(frames.t[keep - 1])});
  if (largest < seen) out.words["larger"] = two_digits(seen / largest);
  if (keep < run.path.x.size()) out.words["left"] = five_digits(run.outcome.end);  // the frame, and ended then
  return out;
}

/// A file's motion that all others are told against, itself told against a point.
Json base_run(const std::vector<Points>& x, double size, MotionNumbers& numbers) {
  const Vec3 centre = x[0].rowwise().mean();
  const std::vector<Points> point{centre.replicate(1, x[0].cols())};
  Json json = numbers.add(departures_of(x, point, 0), of_base, size);
  json["centre"] = vector_json(centre);
  return json;
}

/// The runs of a map: cells with their pictures, or, where `starts` are given and reproduce them, with what they start
/// from.
Json cells_with(const RecordedRuns& recorded, const std::vector<Points>& rests, CellStarts* starts) {
  MotionNumbers numbers;
  Json file = Json::object(), runs = Json::array();
  file["base"] = base_run(rests, recorded.scene.size(), numbers);
  size_t row = 0;
  for (const RecordedRun& run : recorded.runs) {
    while (rests[row] != run.cell->rest) ++row;
    const auto cell = cell_pictures(recorded.scene, run, row);
    if (!cell) {
      runs.push_back(nullptr);
      continue;
    }
    std::optional<Json> json;
    if (starts) json = starts->reproduced(run, cell->x, cell->off.cwiseAbs().maxCoeff() / of_cell.of_departure);
    if (!json) json = numbers.add(cell->off, of_cell, 0);
    json->update(cell->words);
    runs.push_back(std::move(*json));
  }
  file["packed"] = base64(gzipped(dump(runs)));
  numbers.write(file);
  if (starts) file["starts"] = starts->json();
  return file;
}

std::string cells_json(const RecordedRuns& recorded) {
  std::vector<Points> rests;
  for (const RecordedRun& run : recorded.runs)
    if (rests.empty() || rests.back() != run.cell->rest) rests.push_back(run.cell->rest);
  Json file = cells_with(recorded, rests, nullptr);
  file["name"] = recorded.method;
  if (CellStarts::are_taken(recorded.method)) {
    CellStarts starts(recorded, rests);
    file["lab"] = cells_with(recorded, rests, &starts);
  }
  return dump(file);
}

/// The part of the scene that all methods share.
Json shared_json(const Scene& scene, const CameraPlacement& placement, const std::vector<double>& times) {
  Json json{{"scene", scene.name}, {"particles", scene.model.particles.size()}, {"times", Json::array()}};
  for (const double t : times) json["times"].push_back(five_digits(t));
  json["from"] = vector_json(placement.from);
  json["floor"] = placement.floor ? Json(*placement.floor) : Json();
  json["triangles"] = triangles_json(scene);
  json["springs"] = springs_json(scene);
  json["pins"] = scene.model.particles.pins;
  json["spheres"] = spheres_json(scene, times);
  return json;
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

MotionBase base_of(const Scene& scene, const Run& run) {
  MotionBase base{{}, {}, truth_of(scene, run), true};
  const int stride = frame_stride(scene);
  if (stride == 0) return base;
  Trajectory path = base.truth ? base.truth->trajectory : Trajectory{};
  if (path.frames() <= scene.samples) {
    base.known = false;
    Recorder recorder;
    run_method(find_method(scene.method), scene, run, {&recorder});
    path = std::move(recorder.trajectory);
  }
  Frames frames = every(path, static_cast<size_t>(stride));
  base.t = std::move(frames.t), base.x = std::move(frames.x);
  if (base.x.empty()) base.t = {0}, base.x = {scene.start.x};
  return base;
}

std::string stage_json(const Scene& scene, const MotionBase& base) {
  const int stride = frame_stride(scene);
  if (stride == 0) return "";
  std::vector<double> times;
  for (int i = 0; i <= scene.samples; i += stride) times.push_back(scene.duration * i / scene.samples);
  Json json = shared_json(scene, camera_placement(scene, base.x, times), times);
  json["at"] = scene.camera && scene.camera->at ? *scene.camera->at : scene.duration;  // the poster's time, s
  MotionNumbers numbers;
  Json known{{"name", "truth"}, {"runs", Json::array()}};
  known["base"] = base_run(base.x, scene.size(), numbers);
  if (base.truth) {
    const Truth& truth = *base.truth;
    Outcome none;
    none.verdict = Verdict::ok;
    Json own = whole_run(scene, base, {none, truth.trajectory}, base.x.size(), of_own_run, numbers);
    if (!own.is_null()) own.erase("step");
    own["end"] = fmt::format("known up to {:.3g} s", truth.trajectory.t.back());
    known["runs"].push_back(std::move(own));
    json["truth"] = {
        {"name", truth.under_contact_rule ? "converged contact rule" : fmt::format("truth, {}", name_of(truth.tier))},
        {"rule", truth.under_contact_rule},
        {"bar", truth.error_bar},
        {"motion", motion_of(truth.trajectory)}};
  }
  numbers.write(known);
  json["known"] = std::move(known);
  return dump(json);  // texts of outside programs may hold any bytes
}

std::string stage_json(const Scene& scene, bool with_text) {
  CameraPlacement placement = camera_placement(scene, {scene.start.x}, {0});
  placement.floor.reset();
  Json json = shared_json(scene, placement, {0});
  if (with_text) json["toml"] = scene.source;
  return dump(json);
}

std::string motions_json(const RecordedRuns& recorded, const MotionBase& base) {
  const Scene& scene = recorded.scene;
  if (recorded.of.ends_with("-map")) return cells_json(recorded);
  if (frame_stride(scene) == 0) return "";
  const bool many = scene.model.particles.size() > 40;  // then fewer frames are as much as is seen
  const bool own = recorded.of == "engines";            // at the scene's own step
  MotionNumbers numbers;
  Json file{{"name", recorded.method}};
  file["runs"] = Json::array();
  for (const RecordedRun& run : recorded.runs) {
    if (!run.outcome.different_law.empty())
      file["note"] = fmt::format("{}", fmt::join(run.outcome.different_law, "; "));
    const bool whole = own || run.outcome.verdict == Verdict::ok;
    file["runs"].push_back(whole ? whole_run(scene, base, run, own ? (many ? 50 : 150) : (many ? 30 : 75),
                                             own ? of_own_run : of_run, numbers)
                                 : last_pictures(scene, base, run, numbers));
  }
  numbers.write(file);
  return dump(file);
}

}  // namespace crosscheck
