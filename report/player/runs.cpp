#include "report/player/runs.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "experiments/metrics.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/model/energy.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr int most_frames = 150, most_frames_of_mark = 30, fewest_frames = 25;
constexpr int most_places = most_frames * 64 * 64;  // frames x particles
constexpr double largest_number = 65535;

/// Number of lattice points per size of the scene; infinity: the lattice is as fine as 16 bits allow.
constexpr double of_shown = INFINITY, of_own_run = 8192, of_mark = 4096, of_cell = 1024;

double rounded(double value) { return std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr); }

struct Frames {
  std::vector<double> t;  // s
  std::vector<Points> x, v;
};

/// Every `stride`-th frame, up to the first frame that is not finite.
Frames every(const Trajectory& path, int stride) {
  Frames out;
  for (size_t i = 0; i < path.x.size() && path.x[i].allFinite(); i += static_cast<size_t>(stride))
    out.t.push_back(path.t[i]), out.x.push_back(path.x[i]), out.v.push_back(i < path.v.size() ? path.v[i] : Points());
  return out;
}

double distance_from(const Points& x, const Points& start) { return (x - start).cwiseAbs().maxCoeff(); }

/// Truncates a failed run where a coordinate has moved by three times the scene's size (or by three times the largest
/// displacement of the true motion, if that is larger), because no camera shows more.
void cut(Frames& run, const Scene& scene, const std::optional<Truth>& truth) {
  double reach = scene.size();
  if (truth)
    for (const Points& x : truth->trajectory.x) reach = std::max(reach, distance_from(x, scene.start.x));
  size_t keep = 0;
  while (keep < run.x.size() && distance_from(run.x[keep], scene.start.x) < 3 * reach) ++keep;
  run.t.resize(keep), run.x.resize(keep), run.v.resize(keep);
}

/// Returns {"frames", "low", "unit", "bound", "offset", "bytes"} and appends the bytes of the positions to `bytes`. The
/// unit is a power of two, so that runs of similar size share a lattice, and equal motions have equal numbers.
Json packed_run(const std::vector<Points>& x, double unit, std::string& bytes) {
  Vec3 low = x[0].rowwise().minCoeff(), high = low;
  for (const Points& frame : x)
    low = low.cwiseMin(frame.rowwise().minCoeff()), high = high.cwiseMax(frame.rowwise().maxCoeff());
  // one number is reserved for the rounding of the lower corner
  unit = std::max({unit, (high - low).maxCoeff() / (largest_number - 1), 1e-300});
  unit = std::exp2(std::ceil(std::log2(unit)));
  low = (low / unit).array().floor() * unit;
  std::vector<std::uint16_t> numbers;
  for (const Points& frame : x)
    for (int axis = 0; axis < 3; ++axis)
      for (const double place : frame.row(axis))
        numbers.push_back(static_cast<std::uint16_t>(std::lround((place - low[axis]) / unit)));
  const std::string packed = pack(std::move(numbers), static_cast<size_t>(x[0].size()));
  Json json{{"frames", x.size()}, {"low", std::span(low.data(), 3)}, {"unit", unit}, {"bound", unit / 2}};
  json["offset"] = bytes.size(), json["bytes"] = packed.size();
  bytes += packed;
  return json;
}

/// Times (s): only the first and the last one if the times are equidistant, otherwise all.
Json times_json(const std::vector<double>& t) {
  const double apart = (t.back() - t.front()) / double(std::max<size_t>(1, t.size() - 1));
  for (size_t i = 0; i < t.size(); ++i)
    if (std::abs(t[i] - t[0] - apart * double(i)) > 1e-3 * apart) return t;
  return {t.front(), t.back()};
}

/// Adds values with four digits, unless all values are unknown.
void add_series(Json& json, const char* name, const std::vector<std::optional<double>>& values) {
  if (std::ranges::none_of(values, [](const auto& v) { return v && std::isfinite(*v); })) return;
  for (const auto& v : values) json[name].push_back(v && std::isfinite(*v) ? Json(rounded(*v)) : Json());
}

void add_values(Json& json, const Frames& run, const Scene& scene, const std::optional<Truth>& truth, int stride) {
  std::vector<std::optional<double>> error(run.x.size()), energy = error;
  for (size_t f = 0; f < run.x.size(); ++f) {
    const size_t sample = f * static_cast<size_t>(stride);
    if (truth && sample < truth->trajectory.x.size() && run.t[f] <= std::min(scene.window, truth->until) * (1 + 1e-9) &&
        stride > 0)
      error[f] = rms_distance(run.x[f], truth->trajectory.x[sample]);
    if (run.v[f].cols() == run.x[f].cols()) energy[f] = energy_of(scene.model, {run.t[f], run.x[f], run.v[f]}).kinetic;
  }
  add_series(json, "error", error), add_series(json, "energy", energy);
}

/// Reason why a run failed, without the time.
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
  json[out.tolerance > 0 ? "tolerance" : "step"] = out.tolerance > 0 ? out.tolerance : out.step;
  json["verdict"] = name_of(out.verdict);
  if (out.verdict != Verdict::ok) json["failed"] = out.end, json["reason"] = why_failed(out);
}

/// Smallest multiple of the stride that leaves at most `most` frames after the first. Prefers a multiple that divides
/// the number of samples, if there is one below twice the smallest.
int thinned(const Scene& scene, int stride, int most) {
  const int least = std::max(1, (scene.samples + stride * most - 1) / (stride * most));
  for (int times = least; times < 2 * least; ++times)
    if (scene.samples % (stride * times) == 0) return stride * times;
  return stride * least;
}

/// JSON of a run. If the run failed and belongs to a mark of a chart, contains only its last pictures. Null if there is
/// no second frame.
Json scene_run(const Scene& scene, const std::optional<Truth>& truth, const RecordedRun& run, bool own, double unit,
               std::string& bytes) {
  const bool failed = run.outcome.verdict != Verdict::ok, last = failed && !own;
  const int stride = last ? 0 : own ? frame_stride(scene) : thinned(scene, frame_stride(scene), most_frames_of_mark);
  Frames frames = every(run.path, std::max(1, stride));
  if (failed) cut(frames, scene, truth);
  if (frames.x.size() < 2) return nullptr;
  Json json = Json::object();
  add_outcome(json, run.outcome);
  json["times"] = times_json(frames.t);
  if (last) json["last_pictures"] = true;
  json.update(packed_run(frames.x, unit, bytes));
  add_values(json, frames, scene, truth, stride);
  return json;
}

/// JSON of a map's cells as one run. For each cell, contains a picture and its time: the last picture before a particle
/// is farther from its position at rest than twice the scene's size. If there is no such picture, the cell has the
/// state of rest and no time.
Json cells_of_map(const RecordedRuns& recorded, std::string& bytes) {
  std::vector<Points> pictures;
  Json times = Json::array();
  for (const RecordedRun& run : recorded.runs) {
    const Frames frames = every(run.path, 1);
    size_t keep = 0;
    while (keep < frames.x.size() && distance_from(frames.x[keep], *run.rest) <= 2 * recorded.scene.size()) ++keep;
    pictures.push_back(keep > 0 ? frames.x[keep - 1] : *run.rest);
    times.push_back(keep > 0 ? Json(rounded(frames.t[keep - 1])) : Json());
  }
  if (pictures.empty()) return nullptr;
  Json json{{"times", std::move(times)}};
  json.update(packed_run(pictures, recorded.scene.size() / of_cell, bytes));
  return json;
}

constexpr auto ending_of_entry = ".json";

void write_runs(const fs::path& report, const Scene& scene, const std::string& of, const std::string& method,
                const std::string& note, const Json& runs, const std::string& bytes) {
  if (bytes.empty()) return;
  const std::string set = scene.name + "-" + of,
                    path = fmt::format("runs/{}/{}", file_name_of(set), file_name_of(method)), file = path + ".u16.gz";
  const int n = scene.model.particles.size();
  Json entry{{"set", set}, {"scene", scene.name}, {"method", method}, {"file", file}, {"particles", n}};
  if (!note.empty()) entry["note"] = note;
  entry["runs"] = runs;
  write_file(report / file, bytes);
  write_file(report / (path + ending_of_entry), dump(entry));
}

}  // namespace

int frame_stride(const Scene& scene) {
  const int particles = std::max(1, scene.model.particles.size()),
            most = std::min(most_frames, most_places / particles);
  return most < fewest_frames || particles > largest_number ? 0 : thinned(scene, 1, most);
}

const std::optional<Truth>& RunsWriter::truth_on(const Scene& scene, const Run& run) {
  const auto known = truths_.find(scene.name);
  return known != truths_.end() ? known->second : truths_.emplace(scene.name, truth_of(scene, run)).first->second;
}

void RunsWriter::keep(const RecordedRuns& recorded, const Run& run) {
  const Scene& scene = recorded.scene;
  if (frame_stride(scene) == 0 || recorded.runs.empty()) return;
  std::string bytes, note;
  Json runs = Json::array();
  if (recorded.of.ends_with("-map")) {
    runs.push_back(cells_of_map(recorded, bytes));
  } else {
    const bool own = recorded.of == "engines",
               shown = own && recorded.method == family_of(recorded.method).representative;
    const double unit = scene.size() / (shown ? of_shown : own ? of_own_run : of_mark);
    for (const RecordedRun& each : recorded.runs) {
      note = fmt::format("{}", fmt::join(each.outcome.different_law, "; "));
      runs.push_back(scene_run(scene, truth_on(scene, run), each, own, unit, bytes));
    }
  }
  write_runs(report_, scene, recorded.of, recorded.method, note, runs, bytes);
}

void RunsWriter::keep_truth(const Scene& scene, const Run& run) {
  const std::optional<Truth>& truth = truth_on(scene, run);
  if (!truth || frame_stride(scene) == 0) return;
  std::string bytes;
  Json json = scene_run(scene, truth, {Outcome{}, truth->trajectory}, true, scene.size() / of_shown, bytes);
  if (json.is_null()) return;
  json.erase("step"), json.erase("error");
  write_runs(report_, scene, "truth", "truth", "", Json::array({json}), bytes);
}

Json take_index(const fs::path& report) {
  std::vector<fs::path> entries;
  if (const fs::path runs = report / "runs"; fs::exists(runs))
    for (const auto& file : fs::recursive_directory_iterator(runs))
      if (file.path().extension() == ending_of_entry) entries.push_back(file.path());
  std::ranges::sort(entries);
  Json index = Json::array();
  for (const fs::path& file : entries) {
    index.push_back(JsonField::parse_file(file.string()).json());
    fs::remove(file);
  }
  return index;
}

namespace {

/// Requires `count` values if the field exists; null stands for an unknown value.
void require_values(const JsonField& run, const char* name, size_t count) {
  const auto values = run.find(name);
  if (!values) return;
  if (values->size() != count) values->fail(fmt::format("{} values", count));
  for (const JsonField& value : values->elements())
    if (!value.is_null()) value.number();
}

/// Throws InputError unless the run lies within a file of this size.
void require_run(const JsonField& run, std::uintmax_t size) {
  const size_t frames = static_cast<size_t>(run["frames"].whole_number(1, 1'000'000));
  if (run["low"].numbers().size() != 3) run["low"].fail("three numbers");
  if (!(run["unit"].number() > 0)) run["unit"].fail("a number above 0");
  run["bound"].number();
  const std::uintmax_t offset = run["offset"].natural(), bytes = run["bytes"].natural();
  if (offset > size || bytes > size - offset) run["bytes"].fail(fmt::format("bytes of the file, which has {}", size));
  require_values(run, "times", run["times"].size() == 2 ? 2 : frames);
  for (const char* name : {"error", "energy"}) require_values(run, name, frames);
  for (const char* name : {"step", "tolerance", "failed"})
    if (const auto number = run.find(name)) number->number();
  for (const char* name : {"verdict", "reason"})
    if (const auto text = run.find(name)) text->text();
}

std::vector<std::uint16_t> numbers_of(const RunFile& file, const std::string& content, const Json& run) {
  const size_t offset = run["offset"].get<size_t>(), bytes = run["bytes"].get<size_t>();
  const size_t columns = 3 * static_cast<size_t>(file.particles), count = run["frames"].get<size_t>() * columns;
  try {
    return unpack(std::string_view(content).substr(offset, bytes), count, columns);
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: run at byte {}: {}", file.file.string(), offset, error.what()));
  }
}

}  // namespace

std::vector<RunFile> run_files(const JsonField& index, const fs::path& report, bool unpacked) {
  std::vector<RunFile> files;
  for (const JsonField& entry : index.elements()) {
    RunFile file{entry["set"].text(), entry["scene"].text(), entry["method"].text(), {}, 0, entry.json()};
    file.file = path_inside(report, entry["file"].text());
    if (!fs::exists(file.file)) entry["file"].fail("a file in the report's folder");
    file.particles = entry["particles"].whole_number(1, static_cast<int>(largest_number));
    if (const auto note = entry.find("note")) note->text();
    const std::string content = unpacked ? read_file(file.file, "packed runs") : "";
    const std::uintmax_t size = unpacked ? content.size() : fs::file_size(file.file);
    for (const JsonField& run : entry["runs"].elements()) {
      if (run.is_null()) continue;
      require_run(run, size);
      if (unpacked) numbers_of(file, content, run.json());
    }
    files.push_back(std::move(file));
  }
  return files;
}

std::vector<Points> positions_of(const RunFile& file, size_t place) {
  const Json& runs = file.entry["runs"];
  if (place >= runs.size() || runs[place].is_null()) return {};
  const Json& run = runs[place];
  const std::vector<std::uint16_t> numbers = numbers_of(file, read_file(file.file, "packed runs"), run);
  const double unit = run["unit"].get<double>();
  std::vector<Points> x(run["frames"].get<size_t>(), Points(3, file.particles));
  size_t at = 0;
  for (Points& frame : x)
    for (int axis = 0; axis < 3; ++axis)
      for (double& coordinate : frame.row(axis)) coordinate = run["low"][axis].get<double>() + unit * numbers[at++];
  return x;
}

}  // namespace crosscheck
