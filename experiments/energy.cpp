// Experiment `energy`: the ledger of every engine, computed by us from positions and velocities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/experiment.h"

namespace crosscheck {
namespace {

Table ledger_table(const std::string& scene) {
  return {"energy-" + scene,
          {{"method", "1"},
           {"t", "s"},
           {"kinetic", "J"},
           {"elastic", "J"},
           {"gravitational", "J"},
           {"dissipated", "J"},
           {"contact loss", "J"},
           {"contact loss inferred", "1"},
           {"wind work", "J"},
           {"pin work", "J"},
           {"balance error", "J"}},
          {}};
}

}  // namespace

void energy_experiment(const Request& request, Progress& progress, Result& result) {
  Table summary{"energy",
                {{"scene", "1"},
                 {"method", "1"},
                 {"verdict", "1"},
                 {"end", "s"},
                 {"energy turned over", "J"},
                 {"largest balance error", "J"},
                 {"relative balance error", "1"},
                 {"contact loss inferred", "1"}},
                {}};
  for (const Scene& scene : request.scenes) {
    if (scene.model.first_order()) {
      for (size_t i = 0; i < request.methods.size(); ++i) progress.begin("energy: " + scene.name);
      result.notes.push_back(fmt::format("energy leaves out {}: a first-order system has no energy", scene.name));
      continue;
    }
    Table table = ledger_table(scene.name);
    for (const Method& method : request.methods) {
      progress.begin(fmt::format("energy: {} by {}", scene.name, method.name));
      Ledger ledger(scene.model, method.contact);
      const Outcome out = run_method(method, scene, run_of(request, scene), {&ledger});
      if (out.verdict == Verdict::unsupported) continue;
      const double start = ledger.rows().front().balance();
      double worst = 0, turned_over = 0;
      for (const LedgerRow& row : ledger.rows()) {
        const bool inferred = ledger.contact_inferred();
        const double error = row.balance() - start;
        table.add({method.name, row.t, row.energy.kinetic, row.energy.elastic, row.energy.gravitational, row.dissipated,
                   row.contact, inferred ? 1l : 0l, row.wind, row.pins, inferred ? Cell() : Cell(error)});
        worst = std::max(worst, std::abs(error));
        turned_over = std::max({turned_over, row.energy.kinetic,
                                std::abs(row.energy.gravitational - ledger.rows()[0].energy.gravitational)});
      }
      const bool ok = out.verdict == Verdict::ok;
      const bool claimed = ok && !ledger.contact_inferred();
      summary.add({scene.name, method.name, std::string(name_of(out.verdict)), out.end, turned_over,
                   claimed ? Cell(worst) : Cell(), claimed ? Cell(worst / turned_over) : Cell(),
                   ledger.contact_inferred() ? 1l : 0l});
    }
    result.tables.push_back(std::move(table));
  }
  result.tables.push_back(std::move(summary));
}

}  // namespace crosscheck
