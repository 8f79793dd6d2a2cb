// The energies of the answers that experiment `engines` looks at, computed by us from positions and velocities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/ledger_table.h"

namespace crosscheck {

void add_energies(const Request& request, const Scene& scene, Answers& answers, Rows& rows) {
  Table summary{"engines-energy",
                {{"scene", "1"},
                 {"method", "1"},
                 {"verdict", "1"},
                 {"end", "s"},
                 {"energy turned over", "J"},
                 {"largest balance error", "J"},
                 {"relative balance error", "1"},
                 {"contact loss inferred", "1"}},
                {}};
  if (scene.model.first_order()) {
    rows.notes.push_back(fmt::format("energies leave out {}: a first-order system has no energy", scene.name));
    rows.add(summary);
    return;
  }
  Table table = ledger_table(scene.name + "-energy");
  for (const Method& method : methods_of(request, scene)) {
    const Answer& answer = answer_of(request, scene, method, answers);
    const Outcome& out = answer.outcome;
    if (out.verdict == Verdict::unsupported) continue;
    if (answer.ledger.empty()) {
      rows.notes.push_back(fmt::format("energies leave out {} on {}: it gave no velocities", method.name, scene.name));
      continue;
    }
    const double start = answer.ledger.front().balance();
    double worst = 0, turned_over = 0;
    add_ledger(table, method.name, answer.ledger, answer.contact_inferred);
    for (const LedgerRow& row : answer.ledger) {
      worst = std::max(worst, std::abs(row.balance() - start));
      turned_over = std::max({turned_over, row.energy.kinetic,
                              std::abs(row.energy.gravitational - answer.ledger[0].energy.gravitational)});
    }
    const bool ok = out.verdict == Verdict::ok;
    const bool claimed = ok && !answer.contact_inferred;
    summary.add({scene.name, method.name, std::string(name_of(out.verdict)), out.end, turned_over,
                 claimed ? Cell(worst) : Cell(), claimed && turned_over > 0 ? Cell(worst / turned_over) : Cell(),
                 answer.contact_inferred ? 1l : 0l});
  }
  rows.add(table);
  rows.add(summary);
}

}  // namespace crosscheck
