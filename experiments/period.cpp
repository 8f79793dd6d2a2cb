#include "experiments/period.h"

#include <algorithm>

#include "mysim/eigenvalues.h"

namespace crosscheck {
namespace {

/// Times of those turning points of y(t) at which y turns back by at least `least`. Each is at the vertex of a parabola
/// through three points.
std::vector<double> turning_points(const std::vector<double>& t, const std::vector<double>& y, double least) {
  std::vector<double> out;
  size_t extreme = 0;
  int going = 0;  // direction of y: 1 up, -1 down, 0 not known yet
  size_t low = 0, high = 0;
  for (size_t i = 1; i < y.size(); ++i) {
    if (going == 0) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
      if (y[high] - y[low] < least) continue;
      going = high > low ? 1 : -1;
      extreme = i;
      continue;
    }
    if (going * (y[i] - y[extreme]) > 0) {
      extreme = i;
    } else if (going * (y[extreme] - y[i]) >= least) {
      const size_t e = extreme;
      const double left = y[e] - y[e - 1], right = y[e + 1] - y[e];
      // the steps are equal, so the vertex lies within half a step
      const double shift = left == right ? 0 : 0.5 * (left + right) / (left - right);
      out.push_back(t[e] + std::clamp(shift, -0.5, 0.5) * (t[e + 1] - t[e]));
      going = -going;
      extreme = i;
    }
  }
  return out;
}

}  // namespace

std::optional<double> period_of_path(const std::vector<double>& t, const std::vector<Vec3>& path) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : path) mean += p / static_cast<double>(path.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : path) spread += (p - mean) * (p - mean).transpose();
  const Vec3 along = symmetric_eigensystem(spread).vectors.col(2);
  std::vector<double> y;
  for (const Vec3& p : path) y.push_back(along.dot(p - mean));
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  if (!(*high > *low)) return std::nullopt;
  const std::vector<double> turns = turning_points(t, y, 0.1 * (*high - *low));
  if (turns.size() < 3) return std::nullopt;
  return 2 * (turns.back() - turns.front()) / static_cast<double>(turns.size() - 1);
}

}  // namespace crosscheck
