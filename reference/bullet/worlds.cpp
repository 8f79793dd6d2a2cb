// The table of Bullet's worlds and their options.
#include "reference/bullet/worlds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "reference/bullet/deformable.h"
#include "reference/bullet/pbd.h"

namespace crosscheck::bullet {
namespace {

using Options = std::vector<std::string>;

/// Reads "voxel=A", A in metres, into voxel; false where it is another option or no such length.
bool read_voxel(const std::string& option, double& voxel) {
  const std::string_view key = "voxel=";
  if (!option.starts_with(key)) return false;
  double value = 0;
  const char* end = option.data() + option.size();
  if (std::from_chars(option.data() + key.size(), end, value).ptr != end || !(value >= 1e-4 && value <= 1))
    return false;
  voxel = value;
  return true;
}

Engine deformable(const DeformableSettings& settings) {
  return [settings](const Scene& scene, const Run& run, Observer& observer) {
    return run_deformable(scene, run, observer, settings);
  };
}

WorldChoice deformable_explicit(const Options& options) {
  DeformableSettings settings;
  for (const std::string& option : options) {
    if (option == "default-rest")
      settings.defaults.rest = true;
    else if (option == "default-margin")
      settings.defaults.margin = true;
    else if (option == "default-sleep")
      settings.defaults.sleep = true;
    else if (!read_voxel(option, settings.voxel))
      refuse_option("bullet/deformable-explicit", option,
                    "+default-rest, +default-margin, +default-sleep, +voxel=0.0001 to +voxel=1 (m) or none");
  }
  return {"Bullet's deformable world, explicit: springs in N/m, Coulomb friction",
          options.empty() ? "symplectic-euler" : "", deformable(settings)};
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
  return {"Bullet's deformable world, implicit: one Newton step of backward Euler",
          options == Options{"tight"} ? "implicit-euler+linear" : "", deformable(settings), true};
}

WorldChoice pbd(const Options& options) {
  PbdSettings settings;
  int asked = 0;  // iterations
  for (const std::string& option : options) {
    if (read_voxel(option, settings.voxel)) continue;
    const char *begin = option.data() + 2, *end = option.data() + option.size();
    if (option == "demo")
      settings.demo = true;
    else if (option == "own-wind")
      settings.own_wind = true;
    else if (option == "default-rest")
      settings.defaults.rest = true;
    else if (option == "default-voxel")
      settings.voxel = 0.25;
    else if (!option.starts_with("n=") || asked != 0 || std::from_chars(begin, end, asked).ptr != end || asked < 1 ||
             asked > 1000)
      refuse_option(
          "bullet/pbd", option,
          "+n=1 to +n=1000 (iterations), +demo, +own-wind, +default-rest, +default-voxel, +voxel=0.0001 to +voxel=1 "
          "(m) or none");
  }
  settings.iterations = asked > 0 ? asked : settings.demo ? 10 : 1;
  return {"Bullet's position-based world, stiffness mapped per link; different link and friction laws", "",
          [settings](const Scene& scene, const Run& run, Observer& observer) {
            return run_pbd(scene, run, observer, settings);
          },
          false, true};
}

// the table: a name, and how its world is made from the options
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
