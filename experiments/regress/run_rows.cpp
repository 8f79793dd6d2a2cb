// Quantities that one run shows.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "experiments/metrics.h"
#include "experiments/regress/rows.h"
#include "mysim/uniform.h"

namespace crosscheck {
namespace {

/// Frames at so many equal parts of the run, the last one included.
std::vector<int> frames_at(const Trajectory& path, int parts) {
  std::vector<int> frames;
  for (int i = 1; i <= parts; ++i) {
    const int frame = static_cast<int>(std::lround(static_cast<double>(path.frames() - 1) * i / parts));
    if (frame > 0 && (frames.empty() || frame > frames.back())) frames.push_back(frame);
  }
  return frames;
}

std::string at_time(const std::string& what, double t) { return fmt::format("{} at {:.6g} s", what, t); }

}  // namespace

std::string offset_at(double t) { return at_time("offset", t); }
std::string places_at(double t) { return at_time("places along drawn directions", t); }

void offsets(const Seen& seen, Quantities& out) {
  for (const int i : frames_at(seen.path(), 8))
    out.push_back({offset_at(seen.path().t[i]), "m", rms_distance(seen.path().x[i], seen.path().x.front())});
}

void places(const Seen& seen, Quantities& out) {
  const auto n = seen.path().x.front().cols();
  std::mt19937_64 engine(20250101);
  Points along(3, n);
  for (double& part : along.reshaped()) part = 2 * uniform(engine) - 1;
  along /= std::sqrt(static_cast<double>(n));
  for (const int i : frames_at(seen.path(), 8))
    out.push_back({places_at(seen.path().t[i]), "m", dot(along, seen.path().x[i] - seen.path().x.front())});
}

void energies(const Seen& seen, Quantities& out) {
  const auto& rows = seen.answered.ledger;
  if (rows.empty()) return;
  for (const int i : frames_at(seen.path(), 4)) {
    const auto row = std::min_element(rows.begin(), rows.end(), [&](const LedgerRow& a, const LedgerRow& b) {
      return std::abs(a.t - seen.path().t[i]) < std::abs(b.t - seen.path().t[i]);
    });
    out.push_back({at_time("energy gained", seen.path().t[i]), "J", row->energy.total() - rows.front().energy.total()});
  }
  if (seen.scene().model.find<Spheres>()) out.push_back({contact_quantity, "J", rows.back().contact});
}

void peak_stretch(const Seen& seen, Quantities& out) {
  const auto* springs = seen.scene().model.find<Springs>();
  if (!springs) return;
  double most = -INFINITY;
  for (const Points& x : seen.path().x)
    for (const Spring& s : springs->list)
      if (s.rest > 0) most = std::max(most, (x.col(s.a) - x.col(s.b)).norm() / s.rest - 1);
  if (std::isfinite(most)) out.push_back({"peak stretch", "1", most});
}

void shape(const Seen& seen, Quantities& out) {
  const Points &x0 = seen.scene().start.x, offset = seen.path().x.back() - seen.path().x.front();
  if (x0.cols() < 9) return;
  // the two widest directions of the start, the first of equals
  const Vec3 low = x0.rowwise().minCoeff(), width = x0.rowwise().maxCoeff() - low;
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return width[a] > (1 + 1e-9) * width[b]; });
  if (!(width[axes[1]] > 0)) return;
  for (const auto& [along, across] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}}) {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < x0.cols(); ++i) {
      const double a = (x0(axes[0], i) - low[axes[0]]) / width[axes[0]],
                   b = (x0(axes[1], i) - low[axes[1]]) / width[axes[1]];
      sum += std::cos(std::numbers::pi * along * a) * std::cos(std::numbers::pi * across * b) * offset.col(i);
    }
    for (int axis = 0; axis < 3; ++axis)
      out.push_back({fmt::format("wave {}, {} of the last shape, {}", along, across, "xyz"[axis]), "m",
                     sum[axis] / static_cast<double>(x0.cols())});
  }
}

void sag(const Seen& seen, Quantities& out) {
  const auto* gravity = seen.scene().model.find<Gravity>();
  if (!gravity || seen.scene().model.particles.pins.empty()) return;
  const Points offset = seen.path().x.back() - seen.path().x.front();
  out.push_back({"sag", "m", (gravity->acceleration.normalized().transpose() * offset).maxCoeff()});
}

void period(const Seen& seen, Quantities& out) {
  const Trajectory& path = seen.path();
  if (seen.scene().model.find<Spheres>() || path.frames() < 8) return;
  Points means(3, path.frames());
  for (int i = 0; i < path.frames(); ++i) means.col(i) = path.x[i].rowwise().mean();
  const Vec3 width = means.rowwise().maxCoeff() - means.rowwise().minCoeff();
  int axis = 0;
  if (!(width.maxCoeff(&axis) > 1e-6 * seen.scene().size())) return;  // rounding has no period
  std::vector<double> turns;
  for (int i = 1; i + 1 < path.frames(); ++i) {
    const double before = means(axis, i) - means(axis, i - 1), after = means(axis, i + 1) - means(axis, i);
    if ((before > 0) == (after > 0)) continue;
    turns.push_back(path.t[i] + 0.5 * (path.t[i] - path.t[i - 1]) * (before + after) / (before - after));
  }
  // as many as a swing or two have: small ripples are no period
  if (turns.size() < 3 || turns.size() > 40) return;
  out.push_back({"period", "s", 2 * (turns.back() - turns.front()) / static_cast<double>(turns.size() - 1)});
}

void settle_time(const Seen& seen, Quantities& out) {
  const auto& rows = seen.answered.ledger;
  double peak = 0;
  for (const LedgerRow& row : rows) peak = std::max(peak, row.energy.kinetic);
  size_t last = 0;
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows[i].energy.kinetic > 0.01 * peak) last = i;
  // what falls below only towards the end may swing above once more
  if (!(peak > 0) || last + 1 >= rows.size() || rows[last].t > 0.8 * rows.back().t) return;
  const double above = std::log(rows[last].energy.kinetic / (0.01 * peak)),
               below = std::log(std::max(rows[last + 1].energy.kinetic, 1e-9 * peak) / (0.01 * peak));
  const double part = above / (above - below);
  out.push_back({"settle time", "s", rows[last].t + part * (rows[last + 1].t - rows[last].t)});
}

void smallest_clearance(const Seen& seen, Quantities& out) {
  if (!seen.scene().model.find<Spheres>()) return;
  double least = INFINITY;
  for (int i = 0; i < seen.path().frames(); ++i)
    least = std::min(least, *clearance(seen.scene(), seen.path().t[i], seen.path().x[i]));
  out.push_back({"smallest clearance", "m", least});
}

}  // namespace crosscheck
