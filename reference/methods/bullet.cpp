// Bullet's worlds as methods: in double precision in this process, in single precision as a separate program, because
// one program cannot contain both.

#include <fmt/format.h>

#include <filesystem>

#include "mysim/base/errors.h"
#include "mysim/base/installation.h"
#include "reference/bullet/worlds.h"
#include "reference/method.h"
#include "reference/protocol/exec_engine.h"
#include "reference/which_rule.h"

namespace crosscheck {
namespace {

/// The properties of a world in either precision.
void describe(Method& method, const bullet::WorldChoice& chosen) {
  method.implicit = chosen.implicit, method.position_based = chosen.position_based;
  method.counts_evaluations = !chosen.implicit && !chosen.position_based;
  identify_by_runs(method);
  if (!chosen.position_based) return;
  method.spring_law = SpringLaw::bullet_link;
  method.own_friction = true;
}

Method in_double_precision(const std::string& world, const MethodOptions& options) {
  bullet::WorldChoice chosen = bullet::choose_world(world, options);
  if (chosen.may_hang)
    throw InputError(
        fmt::format("method bullet/{}: +in-pieces may hang and has no time limit here; expected a "
                    "separate process: bullet32/{}+in-pieces+timeout=SECONDS, or exec:",
                    world, world));
  Method method{"bullet/" + world, chosen.what, "", chosen.engine, ContactLoss::inferred};
  describe(method, chosen);
  method.splits_dashpots = !chosen.implicit && !chosen.position_based;
  // on one spring, both the single Newton step of these worlds and the correction of a link after a free step are
  // backward Euler
  if (!method.splits_dashpots) method.on_one_spring = "implicit-euler";
  return method;
}

Method in_single_precision(const std::string& world, const MethodOptions& options) {
  Program program{programs_folder() / "bullet32_engine", {}};
  for (const std::string& option : options) add_option(program, "bullet32/" + world, option);
  const bullet::WorldChoice chosen = bullet::choose_world(world, program.options);  // refuses invalid options at once
  program.options.insert(program.options.begin(), "world=" + world);
  Method method{"bullet32/" + world, chosen.what + "; in single precision, as a separate program", "",
                [program](const Scene& scene, const Run& run, Observer& observer) {
                  if (!std::filesystem::exists(program.path))
                    throw Unsupported(
                        fmt::format("{} is missing; the build target bullet32_engine makes it", program.path.string()));
                  return run_outside_engine(program, scene, run, observer);
                },
                ContactLoss::sampled};
  describe(method, chosen);
  return method;
}

}  // namespace

std::vector<MethodRow> bullet_methods() {
  std::vector<MethodRow> rows;
  for (const std::string& world : bullet::world_names())
    rows.push_back({"bullet/" + world, [world](const auto& options) { return in_double_precision(world, options); }});
  return rows;
}

std::vector<MethodRow> bullet32_methods() {
  std::vector<MethodRow> rows;
  for (const std::string& world : bullet::world_names())
    rows.push_back({"bullet32/" + world, [world](const auto& options) { return in_single_precision(world, options); }});
  return rows;
}

}  // namespace crosscheck
