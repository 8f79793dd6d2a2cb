// Bullet's worlds by name: what a program of its own is asked for by words.
#include <fmt/format.h>

#include <charconv>

#include "mysim/errors.h"
#include "reference/bullet/worlds.h"

namespace crosscheck::bullet {
namespace {

int iterations_of(const std::string& option) {
  int n = 0;
  const char* end = option.data() + option.size();
  if (!option.starts_with("n=") || std::from_chars(option.data() + 2, end, n).ptr != end || n < 1 || n > 1000)
    throw InputError(fmt::format("world pbd: unknown option '{}'; expected n=1 to n=1000 (iterations)", option));
  return n;
}

}  // namespace

Outcome run_world(const std::string& world, const std::vector<std::string>& options, const Scene& scene, const Run& run,
                  Observer& observer) {
  if (world == "pbd") {
    int n = 1;
    for (const std::string& option : options) n = iterations_of(option);
    return run_pbd(scene, run, observer, n);
  }
  if (world != "deformable-explicit")
    throw InputError(fmt::format("world '{}': expected deformable-explicit or pbd", world));
  if (!options.empty())
    throw InputError(fmt::format("world {}: unknown option '{}'; expected none", world, options[0]));
  return run_deformable_explicit(scene, run, observer);
}

}  // namespace crosscheck::bullet
