#include "reference/bullet/worlds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <optional>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "reference/bullet/bodies.h"
#include "reference/bullet/deformable.h"
#include "reference/bullet/pbd.h"

namespace crosscheck::bullet {
namespace {

using Options = std::vector<std::string>;

/// The number in "KEY=NUMBER", within [low, high]; nullopt for other options and invalid numbers.
std::optional<double> read_number(const std::string& option, std::string_view key, double low, double high) {
  if (!option.starts_with(key)) return std::nullopt;
  double value = 0;
  const char* end = option.data() + option.size();
  if (std::from_chars(option.data() + key.size(), end, value).ptr != end || !(value >= low && value <= high))
    return std::nullopt;
  return value;
}

/// Reads the options of both worlds; returns false for other options and invalid numbers.
bool read_common(const std::string& option, double& voxel, BulletDefaults& defaults) {
  if (const auto a = read_number(option, "voxel=", 1e-4, 1))  // m
    voxel = *a;
  else if (const auto f = read_number(option, "gravity-factor=", 0.01, 100))
    defaults.gravity_factor = *f;
  else if (const auto k = read_number(option, "kLST=", 0, 1e6))
    defaults.kLST = *k;
  else if (option == "default-rest")
    defaults.rest = true;
  else
    return false;
  return true;
}

Engine deformable(const DeformableSettings& settings) {
  return [settings](const Scene& scene, const Run& run, Observer& observer) {
    return run_deformable(scene, run, observer, settings);
  };
}

WorldChoice deformable_explicit(const Options& options) {
  DeformableSettings settings;
  bool bodies = false;
  for (const std::string& option : options) {
    if (option == "default-margin")
      settings.defaults.margin = true;
    else if (option == "default-sleep")
      settings.defaults.sleep = true;
    else if (option == "in-pieces")
      settings.defaults.pieces = true;
    else if (option == "bodies")
      bodies = true;
    else if (!read_common(option, settings.voxel, settings.defaults))
      refuse_option("bullet/deformable-explicit", option,
                    "+default-rest, +default-margin, +default-sleep, +voxel=0.0001 to +voxel=1 (m), "
                    "+gravity-factor=0.01 to +gravity-factor=100, +kLST=0 to +kLST=1e6, +bodies alone, +in-pieces (in "
                    "a separate process) or none");
  }
  if (bodies && options.size() > 1)
    refuse_option("bullet/deformable-explicit", "bodies", "+bodies without other options");
  if (bodies)
    return {"Bullet's deformable world, explicit: with a separate body and spring force for each piece of the network",
            run_bodies};
  WorldChoice choice{"Bullet's deformable world, explicit: springs in N/m, Coulomb friction", deformable(settings)};
  choice.may_hang = settings.defaults.pieces;
  return choice;
}

WorldChoice deformable_implicit(const Options& options) {
  DeformableSettings settings;
  settings.implicit = true;
  for (const std::string& option : options) {
    if (option == "tight")
      settings.tight = true;
    else if (option == "shipped")
      settings.shipped = true;
    else if (option == "unprojected")
      settings.projected = false;
    else
      refuse_option("bullet/deformable-implicit", option, "+tight, +shipped, +unprojected or none");
  }
  return {"Bullet's deformable world, implicit: one Newton step of backward Euler", deformable(settings), true};
}

WorldChoice pbd(const Options& options) {
  PbdSettings settings;
  int iterations = 0;
  for (const std::string& option : options) {
    if (read_common(option, settings.voxel, settings.defaults)) continue;
    const char *begin = option.data() + 2, *end = option.data() + option.size();
    if (option == "demo")
      settings.demo = true;
    else if (option == "own-wind")
      settings.own_wind = true;
    else if (option == "default-voxel")
      settings.voxel = 0.25;
    else if (!option.starts_with("n=") || iterations != 0 || std::from_chars(begin, end, iterations).ptr != end ||
             iterations < 1 || iterations > 1000)
      refuse_option(
          "bullet/pbd", option,
          "+n=1 to +n=1000 (iterations), +demo, +own-wind, +default-rest, +default-voxel, +voxel=0.0001 to +voxel=1 "
          "(m), +gravity-factor=0.01 to +gravity-factor=100, +kLST=0 to +kLST=1e6 or none");
  }
  settings.iterations = iterations > 0 ? iterations : settings.demo ? 10 : 1;
  return {"Bullet's position-based world, stiffness mapped per link; different link and friction laws",
          [settings](const Scene& scene, const Run& run, Observer& observer) {
            return run_pbd(scene, run, observer, settings);
          },
          false, true};
}

struct Row {
  std::string_view name;
  WorldChoice (*make)(const Options&);
};
constexpr Row table[] = {
    {"deformable-explicit", deformable_explicit}, {"deformable-implicit", deformable_implicit}, {"pbd", pbd}};

}  // namespace

std::vector<std::string> world_names() {
  std::vector<std::string> names;
  for (const Row& row : table) names.emplace_back(row.name);
  return names;
}

WorldChoice choose_world(const std::string& world, const std::vector<std::string>& options) {
  for (const Row& row : table)
    if (row.name == world) return row.make(options);
  throw InputError(
      fmt::format("unknown world '{}' of Bullet; expected one of: {}", world, fmt::join(world_names(), ", ")));
}

}  // namespace crosscheck::bullet
