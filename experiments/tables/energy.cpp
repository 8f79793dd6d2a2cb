// The columns are the terms of the balance.
#include "experiments/tables/energy.h"

namespace crosscheck {

Table ledger_table(const std::string& name) {
  return {name,
          {{"method", "1"},
           {"t", "s"},
           {"kinetic", "J"},
           {"elastic", "J"},
           {"gravitational", "J"},
           {"drag", "J"},
           {"dashpots", "J"},
           {"contact loss", "J"},
           {"contact loss inferred", "1"},
           {"wind work", "J"},
           {"pin work", "J"},
           {"balance error", "J"}},
          {}};
}

void add_ledger(Table& table, const std::string& method, const std::vector<LedgerRow>& rows, bool inferred) {
  for (const LedgerRow& row : rows)
    table.add({method, row.t, row.energy.kinetic, row.energy.elastic, row.energy.gravitational, row.drag, row.dashpots,
               row.contact, inferred ? 1l : 0l, row.wind, row.pins,
               inferred ? Cell() : Cell(row.balance() - rows.front().balance())});
}

}  // namespace crosscheck
