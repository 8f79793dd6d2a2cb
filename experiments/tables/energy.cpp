#include "experiments/tables/energy.h"

namespace crosscheck {

void add_ledger(Table& table, const std::string& method, const std::vector<LedgerRow>& rows, bool inferred) {
  for (const LedgerRow& row : rows) {
    SceneEnergyRow out{.method = method,
                       .t = row.t,
                       .kinetic = row.energy.kinetic,
                       .elastic = row.energy.elastic,
                       .gravitational = row.energy.gravitational,
                       .drag = row.drag,
                       .dashpots = row.dashpots,
                       .contact = row.contact,
                       .contact_inferred = inferred,
                       .wind = row.wind,
                       .pins = row.pins};
    if (!inferred) out.balance_error = row.balance() - rows.front().balance();
    add(table, out);
  }
}

}  // namespace crosscheck
