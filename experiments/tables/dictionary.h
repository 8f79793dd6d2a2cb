// The data dictionary: every column of every table that experiments write.
#pragma once

#include <span>

#include "experiments/tables/table.h"

namespace crosscheck {

/// Table "dictionary": table, column, unit, type and description of each column, in the order of the list of row types.
/// Tables that come once for each scene stand under SCENE-..., those of disagreements under NAME-....
Table dictionary();
/// The same of those tables only that are among `present`.
Table dictionary(std::span<const Table> present);

/// A table that was read from a file, with the types that its rows declare: a file writes a number that happens to be
/// whole like a count. A table of a name that no row type has stays as it is. Throws InputError as rows_of().
Table with_declared_types(Table read);

}  // namespace crosscheck
