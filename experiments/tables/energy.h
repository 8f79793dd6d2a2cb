// The energies of a run as a table.
#pragma once

#include "experiments/tables/table.h"
#include "mysim/run/observers.h"

namespace crosscheck {

/// The ledger of one run as rows of (method, t, energies, losses, work, balance error); the last is empty where the
/// contact loss was inferred, as no closure is claimed there.
Table ledger_table(const std::string& name);
void add_ledger(Table& table, const std::string& method, const std::vector<LedgerRow>& rows, bool contact_inferred);

}  // namespace crosscheck
