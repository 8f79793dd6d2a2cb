#include "experiments/regress/shape.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>

#include "mysim/files.h"

namespace crosscheck {

std::filesystem::path shape_file(const std::filesystem::path& folder, const std::string& scene) {
  return folder / (file_name_of(scene) + "-shape.csv");
}

std::string shape_text(const std::string& scene, const std::string& method, double t, const Points& x) {
  std::string text =
      fmt::format("# written by `crosscheck regress --bless`, for pictures: {} under {}\n# t: {}\nx [m],y [m],z [m]\n",
                  scene, method, t);
  for (int i = 0; i < x.cols(); ++i) text += fmt::format("{:.6g},{:.6g},{:.6g}\n", x(0, i), x(1, i), x(2, i));
  return text;
}

std::optional<Shape> read_shape(const std::filesystem::path& folder, const std::string& scene, int particles) {
  std::ifstream in(shape_file(folder, scene));
  std::string line;
  Shape shape{0, Points(3, particles)};
  if (!std::getline(in, line) || !std::getline(in, line) || std::sscanf(line.c_str(), "# t: %lf", &shape.t) != 1 ||
      !std::getline(in, line))
    return std::nullopt;
  int i = 0;
  for (; std::getline(in, line); ++i)
    if (i >= particles || std::sscanf(line.c_str(), "%lf,%lf,%lf", &shape.x(0, i), &shape.x(1, i), &shape.x(2, i)) != 3)
      return std::nullopt;
  return i == particles && shape.x.allFinite() ? std::optional(shape) : std::nullopt;
}

}  // namespace crosscheck
