// Starts of rows on their lattices, the scene of a cell, and the check that the page shows what was recorded.
#include "report/player/computed_cells.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/timing/instruction_sets.h"
#include "report/lab/live_run.h"
#include "report/player/computed_runs.h"
#include "report/player/packed_numbers.h"
#include "report/player/static_geometry.h"

namespace crosscheck {
namespace {

/// The smallest power of two of which `largest` is at most so many.
double lattice_step(double largest, double most) {
  return largest > 0 ? std::exp2(std::ceil(std::log2(largest / most))) : 1;
}

/// The place in which a scene file's terms come, as sums of forces depend on it: drag before wind, wind before balls.
int reading_order(const Term& term) {
  if (std::holds_alternative<Spheres>(term)) return 3;
  if (std::holds_alternative<Wind>(term) || std::holds_alternative<Aerodynamics>(term)) return 2;
  return std::holds_alternative<Drag>(term) ? 1 : 0;
}

double largest_of(const Points& points) { return points.size() > 0 ? points.cwiseAbs().maxCoeff() : 0; }

}  // namespace

bool CellStarts::are_taken(const std::string& method) {
  return is_computed_in_page(method) && has_same_bits_everywhere(*stepper_of_rule(method.substr(method.find('/') + 1)));
}

CellStarts::CellStarts(const RecordedRuns& recorded, const std::vector<Points>& rests)
    : scene_(recorded.scene), rule_(recorded.method.substr(recorded.method.find('/') + 1)), rests_(rests) {
  for (const MapKind& kind : map_kinds())
    if (recorded.of == fmt::format("{}-map", kind.name)) kind_ = &kind;
  double largest = 0;
  for (const Points& rest : rests) largest = std::max(largest, largest_of(rest));
  rest_ = lattice_step(largest, rest_numbers_.most());
  for (const Points& rest : rests) rest_numbers_.take(placed_.emplace_back(rest), rest_);
}

void WordLattice::take(Points& values, double step) {
  for (double& v : values.reshaped()) {
    const std::int64_t number = std::llround(v / step);
    for (int word = 0; word < words_; ++word) numbers_[word].push_back(static_cast<std::uint16_t>(number >> 16 * word));
    v = static_cast<double>(number) * step;
  }
}

Json WordLattice::json() const {
  std::vector<std::uint16_t> all;
  for (const auto& word : numbers_) all.insert(all.end(), word.begin(), word.end());
  return packed_json(pack_small(all));
}

CellStarts::Row& CellStarts::row_of(const MapCell& cell) {
  for (Row& row : rows_)
    if (row.value == cell.value) return row;
  const size_t at = static_cast<size_t>(std::ranges::find(rests_, cell.rest) - rests_.begin());
  Points off = cell.start.x - placed_[at];
  Row row{cell.value, lattice_step(largest_of(off), moves_.most()),
          lattice_step(largest_of(cell.start.v), moves_.most()), at, kind_->with(scene_, cell.value)};
  Scene& scene = row.scene;
  scene.start.v = cell.start.v;
  moves_.take(off, row.move), moves_.take(scene.start.v, row.speed);
  scene.start.x = placed_[at] + off;
  std::vector<Term> terms;
  for (int order = 0; order < 4; ++order)
    for (const Term& term : scene.model.terms)
      if (reading_order(term) == order) terms.push_back(term);
  scene.model.terms = std::move(terms);
  Particles& particles = scene.model.particles;
  particles.pin_home = scene.start.x(Eigen::seqN(0, 3), particles.pins);
  particles.place_pins(scene.start);
  rows_.push_back(std::move(row));
  return rows_.back();
}

Scene CellStarts::scene_of(const MapCell& cell) {
  steps_ = cell.steps;
  Scene scene = row_of(cell).scene;
  scene.step = cell.step;
  scene.duration = cell.step * static_cast<double>(cell.steps);
  scene.window = scene.duration;
  scene.samples = samples_ = run_of_perturbed(cell.step, cell.steps).samples;
  return scene;
}

std::optional<Json> CellStarts::reproduced(const RecordedRun& run, const std::vector<Points>& pictures, double within) {
  const MapCell& cell = *run.cell;
  const long first = std::lround(run.path.t[0] / cell.step),
             apart = std::lround((run.path.t[1] - run.path.t[0]) / cell.step);
  // each step rounds places by half of the last digit; what rests to within that shows its rounding alone
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  within = std::max(within, 0.5 * epsilon * static_cast<double>(cell.steps) * scene_.size());
  const ScopedInstructionSet page(simd::InstructionSet::baseline);
  LiveRun live(scene_of(cell));
  live.start({rule_, cell.step, 1e-6, live.scene().duration, false});
  for (size_t i = 0; i < pictures.size(); ++i) {
    live.advance(cell.step * static_cast<double>(first + static_cast<long>(i) * apart),
                 std::numeric_limits<int>::max());
    if (!((live.state().x - pictures[i]).cwiseAbs().maxCoeff() <= within)) return std::nullopt;  // nan, too
  }
  size_t row = 0;
  while (rows_[row].value != cell.value) ++row;
  return Json{{"modes", 0},       {"frames", pictures.size()},
              {"computed", true}, {"row", row},
              {"h", cell.step},   {"first", first},
              {"apart", apart}};
}

Json CellStarts::json() const {
  Json rows = Json::array();
  for (const Row& row : rows_)
    rows.push_back({{"value", row.value}, {"at", row.at}, {"move", row.move}, {"speed", row.speed}});
  return {{"kind", kind_->name},           {"samples", samples_},    {"steps", steps_},        {"rest", rest_},
          {"rests", rest_numbers_.json()}, {"moves", moves_.json()}, {"rows", std::move(rows)}};
}

}  // namespace crosscheck
