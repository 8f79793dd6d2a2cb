// The data dictionary: every column of every table that experiments write.
#pragma once

#include <span>

#include "experiments/tables/table.h"

namespace crosscheck {

/// Table "dictionary": table, column, unit, type and description of each column, in the order of the list of row types.
/// Tables that exist once per scene are listed as SCENE-..., those of disagreements as NAME-....
Table dictionary();
/// The rows of the dictionary about the tables in `present`.
Table dictionary(std::span<const Table> present);

/// Converts the cells of a table that was read from a file to the types that its row type declares, because in a file a
/// number that happens to be whole looks like a count. Tables without a row type are returned unchanged. Throws
/// InputError as rows_of() does.
Table with_declared_types(Table read);

}  // namespace crosscheck
