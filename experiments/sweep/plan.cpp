// JSON.
#include "experiments/sweep/plan.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "mysim/errors.h"
#include "mysim/files.h"

namespace crosscheck {

Plan plan_of(std::vector<std::string> experiments, std::span<const Point> points, Provenance provenance) {
  Plan plan{std::move(experiments), {}, std::move(provenance)};
  for (const Point& point : points) plan.points.push_back({point.name, point.hash()});
  return plan;
}

void write_plan(const Plan& plan, const std::filesystem::path& folder) {
  nlohmann::ordered_json json{{"experiments", plan.experiments}, {"provenance", plan.provenance}, {"points", {}}};
  for (const Plan::Entry& p : plan.points) json["points"].push_back({{"name", p.name}, {"hash", p.hash}});
  write_file(folder / "plan.json", json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

Plan read_plan(const std::filesystem::path& folder) {
  const auto file = folder / "plan.json";
  std::ifstream in(file);
  if (!in)
    throw InputError(fmt::format("{}: expected the plan of a sweep, written by `experiment --shard`", file.string()));
  try {
    const auto json = nlohmann::json::parse(in);
    Plan plan{json.at("experiments"), {}, json.at("provenance").get<Provenance>()};
    for (const auto& p : json.at("points")) plan.points.push_back({p.at("name"), p.at("hash")});
    return plan;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: expected experiments, provenance and points: {}", file.string(), error.what()));
  }
}

std::filesystem::path store_in(const std::filesystem::path& folder) { return folder / "points"; }

}  // namespace crosscheck
