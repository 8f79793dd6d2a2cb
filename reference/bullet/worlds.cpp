// The table of Bullet's worlds and their options.
#include "reference/bullet/worlds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "mysim/errors.h"
#include "reference/bullet/deformable.h"
#include "reference/bullet/pbd.h"

namespace crosscheck::bullet {
namespace {

using Options = std::vector<std::string>;

[[noreturn]] void refuse(std::string_view world, const std::string& option, std::string_view known) {
  throw InputError(fmt::format("method bullet/{}: unknown option '+{}'; expected {} or none", world, option, known));
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
    else
      refuse("deformable-explicit", option, "+default-rest, +default-margin, +default-sleep");
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
      refuse("deformable-implicit", option, "+tight, +shipped, +unprojected");
  }
  return {"Bullet's deformable world, implicit: one Newton step of backward Euler",
          options == Options{"tight"} ? "implicit-euler+linear" : "", deformable(settings)};
}

WorldChoice pbd(const Options& options) {
  PbdSettings settings;
  int asked = 0;  // iterations
  for (const std::string& option : options) {
    const char *begin = option.data() + 2, *end = option.data() + option.size();
    if (option == "demo")
      settings.demo = true;
    else if (option == "own-wind")
      settings.own_wind = true;
    else if (option == "default-rest")
      settings.defaults.rest = true;
    else if (option == "default-voxel")
      settings.defaults.voxel = true;
    else if (!option.starts_with("n=") || asked != 0 || std::from_chars(begin, end, asked).ptr != end || asked < 1 ||
             asked > 1000)
      refuse("pbd", option, "+n=1 to +n=1000 (iterations), +demo, +own-wind, +default-rest, +default-voxel");
  }
  settings.iterations = asked > 0 ? asked : settings.demo ? 10 : 1;
  return {"Bullet's position-based world, stiffness mapped per link; different link and friction laws", "",
          [settings](const Scene& scene, const Run& run, Observer& observer) {
            return run_pbd(scene, run, observer, settings);
          }};
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
