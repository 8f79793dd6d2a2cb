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
  int iterations = 0;
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
    else if (!option.starts_with("n=") || iterations != 0 || std::from_chars(begin, end, iterations).ptr != end ||
             iterations < 1 || iterations > 1000)
      refuse_option(
          "bullet/pbd", option,
          "+n=1 to +n=1000 (iterations), +demo, +own-wind, +default-rest, +default-voxel, +voxel=0.0001 to +voxel=1 "
          "(m) or none");
  }
  settings.iterations = iterations > 0 ? iterations : settings.demo ? 10 : 1;
  return {"Bullet's position-based world, stiffness mapped per link; different link and friction laws", "",
          [settings](const Scene& scene, const Run& run, Observer& observer) {
            return run_pbd(scene, run, observer, settings);
          },
          false, true};
}

// the table: a name, how its world is made from the options, and its look in charts in double and in single precision
struct Row {
  std::string_view name;
  WorldChoice (*make)(const Options&);
  CurveStyle style, style_in_single;
};
constexpr Row table[] = {
    {"deformable-explicit", deformable_explicit, {"#9A4200", "(3,2)", 5}, {"#D08050", "(14,2,2,2)", 4}},
    {"deformable-implicit", deformable_implicit, {"#AA4499", "(20,3,4,3)", 11}, {"#B080C0", "(12,2,1,2)", 10}},
    {"pbd", pbd, {"#D66A08", "(8,4)", 13}, {"#B08050", "(4,2,1,2)", 6}}};

}  // namespace

std::vector<std::string> world_names() {
  std::vector<std::string> names;
  for (const Row& row : table) names.emplace_back(row.name);
  return names;
}

WorldChoice choose_world(const std::string& world, const std::vector<std::string>& options) {
  for (const Row& row : table)
    if (row.name == world) {
      WorldChoice choice = row.make(options);
      choice.style = row.style, choice.style_in_single = row.style_in_single;
      return choice;
    }
  throw InputError(
      fmt::format("unknown world '{}' of Bullet; expected one of: {}", world, fmt::join(world_names(), ", ")));
}

}  // namespace crosscheck::bullet
