#include "experiments/bench/on_scenes.h"

#include <fmt/format.h>

#include <set>

#include "experiments/bench/paths.h"
#include "experiments/timing.h"

namespace crosscheck {
namespace {

using strip::Isa;

long springs_of(const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  return springs ? static_cast<long>(springs->list.size()) : 0;
}

std::string naive_name(const Scene& scene) { return scene.name + ", naive loop"; }

}  // namespace

Table scenes_table(const std::vector<Scene>& scenes, const MicroPlan& plan) {
  struct Way {
    const Scene* scene;
    std::string kernel, instructions, name;
  };
  std::vector<Way> ways;
  std::vector<Micro> micros;
  const auto add = [&](const Scene& scene, const char* kernel, Isa isa, Piece once) {
    ways.push_back(
        {&scene, kernel, std::string(name_of(isa)), fmt::format("{}, {}, {}", scene.name, kernel, name_of(isa))});
    micros.push_back({ways.back().name, std::move(once)});
  };
  for (const Scene& scene : scenes) {
    if (springs_of(scene) == 0) continue;
    micros.push_back({naive_name(scene), naive_loop(scene)});
    std::set<Isa> sets;
    for (const Path& path : paths()) sets.insert(path.instructions);
    for (const Isa isa : sets) add(scene, "general kernel", isa, general_kernel(scene, isa));
    for (const Isa isa : sets)
      if (auto piece = sweep<double>(scene, isa, false)) add(scene, "sweep, reproducible", isa, std::move(*piece));
  }
  const auto times = measured(micros, plan);
  Table table{"bench-scenes-cost",
              {{"scene", "1"},
               {"particles", "1"},
               {"springs", "1"},
               {"kernel", "1"},
               {"instructions", "1"},
               {"time", "ns"},
               {"low", "ns"},
               {"high", "ns"},
               {"naive loop", "ns"},
               {"times the naive loop", "1"},
               {"ratio low", "1"},
               {"ratio high", "1"}},
              {}};
  for (const Way& way : ways) {
    const Scene& scene = *way.scene;
    const auto &own = times.at(way.name), &beside = times.at(naive_name(scene));
    const Timing each = timing_of(own).times(1e9), ratio = timing_of(quotients(beside, own));
    table.add({scene.name, static_cast<long>(scene.start.x.cols()), springs_of(scene), way.kernel, way.instructions,
               each.median, each.low, each.high, timing_of(beside).median * 1e9, ratio.median, ratio.low, ratio.high});
  }
  return table;
}

}  // namespace crosscheck
