// JSON.
#include "experiments/sweep/plan.h"

#include <fmt/format.h>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/json.h"

namespace crosscheck {

Plan plan_of(std::vector<std::string> experiments, std::span<const Point> points, Provenance provenance) {
  Plan plan{std::move(experiments), {}, std::move(provenance)};
  for (const Point& point : points) plan.points.push_back({point.name, point.hash()});
  return plan;
}

void write_plan(const Plan& plan, const std::filesystem::path& folder) {
  Json json{{"experiments", plan.experiments}, {"provenance", Json::list()}, {"points", {}}};
  for (const auto& [key, value] : plan.provenance) json["provenance"].push(Json::list(key, value));
  for (const Plan::Entry& p : plan.points) json["points"].push({{"name", p.name}, {"hash", p.hash}});
  write_file(folder / "plan.json", json.dump(1) + "\n");
}

Plan read_plan(const std::filesystem::path& folder) {
  const auto file = folder / "plan.json";
  if (!std::filesystem::exists(file))
    throw InputError(fmt::format("{}: expected the plan of a sweep, written by `experiment --shard`", file.string()));
  try {
    const JsonField json = JsonField::parse_file(file.string());
    Plan plan{json["experiments"].texts(), {}, {}};
    for (const JsonField& line : json["provenance"].elements())
      plan.provenance.emplace_back(line[0].text(), line[1].text());
    if (const JsonField points = json["points"]; !points.is_null())
      for (const JsonField& p : points.elements()) plan.points.push_back({p["name"].text(), p["hash"].text()});
    return plan;
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected experiments, provenance and points of a sweep: {}", error.what()));
  }
}

std::filesystem::path store_in(const std::filesystem::path& folder) { return folder / "points"; }

}  // namespace crosscheck
