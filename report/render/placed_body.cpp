// Checks a body and puts its particles into the frame.
#include "report/render/placed_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace crosscheck::render {
namespace {

constexpr float absurd = 200;  // heights of the view: a particle beyond this counts as blown up

void check(const Body& body) {
  const auto inside = [&](const auto& indices, const char* what) {
    for (const int i : indices) {
      if (i >= 0 && i < body.x.cols()) continue;
      throw std::runtime_error(fmt::format("render: a {} names particle {} of {}", what, i, body.x.cols()));
    }
  };
  for (const auto& triangle : body.triangles) inside(triangle, "triangle");
  for (const auto& edge : body.threads) inside(edge, "thread");
  for (const auto& edge : body.tubes) inside(edge, "tube");
  inside(body.pinned, "pin");

  const auto as_many = [](std::size_t have, std::size_t want, const char* what) {
    if (have != 0 && have != want) throw std::runtime_error(fmt::format("render: {} {} for {}", have, what, want));
  };
  as_many(body.value.size(), std::size_t(body.x.cols()), "particle values");
  as_many(body.tube_value.size(), body.tubes.size(), "tube values");
  as_many(body.tube_colour.size(), body.tubes.size(), "tube colours");
}

}  // namespace

PlacedBody place_body(const Body& body, const Frame& frame, const Scale* scale) {
  check(body);
  PlacedBody placed{body, scale, {}, {}};
  for (Eigen::Index i = 0; i < body.x.cols(); ++i) {
    placed.x.push_back(frame.place(body.x.col(i)));
    placed.sound.push_back(placed.x.back().allFinite() && placed.x.back().cwiseAbs().maxCoeff() < absurd);
  }
  return placed;
}

float PlacedBody::median_length(const std::vector<std::array<int, 2>>& edges) const {
  std::vector<float> lengths;
  for (const auto& [i, j] : edges) {
    if (is_sound(i) && is_sound(j)) lengths.push_back((at(i) - at(j)).norm());
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + std::ptrdiff_t(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace crosscheck::render
