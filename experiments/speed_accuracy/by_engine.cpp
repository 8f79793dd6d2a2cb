#include "experiments/speed_accuracy/by_engine.h"

#include <algorithm>

namespace crosscheck {

std::string engine_of(const std::string& method) { return method.substr(0, method.find('/')); }

Table engines_cost_table() {
  return {"speed-accuracy-engines-cost",
          {{"scene", "1"},
           {"part of motion", "1"},
           {"measure", "1"},
           {"engine", "1"},
           {"method", "1"},
           {"setting", "1"},
           {"asked", "see setting"},
           {"cpu", "s"},
           {"distance", "m"},
           {"times mysim", "1"},
           {"times mysim low", "1"},
           {"times mysim high", "1"},
           {"part timed", "1"},
           {"part timed of mysim", "1"}},
          {}};
}

void add_by_engine(const std::string& scene, double part_of_motion, const std::string& measure, double bound,
                   const std::vector<WorkPoint>& points, Table& table) {
  std::vector<std::string> engines;
  for (const WorkPoint& p : points)
    if (const std::string engine = engine_of(p.method);
        std::find(engines.begin(), engines.end(), engine) == engines.end())
      engines.push_back(engine);
  const WorkPoint* ours = cheapest(points, bound, "mysim/");
  for (const std::string& engine : engines) {
    std::vector<WorkPoint> its = points;
    std::erase_if(its, [&](const WorkPoint& p) { return !p.time || engine_of(p.method) != engine; });
    const WorkPoint* best = cheapest(its, bound);
    if (!best) continue;
    const Timing* beside = ours && ours->time && ours->time->low > 0 ? &*ours->time : nullptr;
    table.add({scene, part_of_motion, measure, engine, best->method, best->setting, best->asked, best->cost,
               *best->error, beside ? Cell(best->cost / ours->cost) : Cell(),
               beside ? Cell(best->time->low / beside->high) : Cell(),
               beside ? Cell(best->time->high / beside->low) : Cell(), best->part, ours ? Cell(ours->part) : Cell()});
  }
}

}  // namespace crosscheck
