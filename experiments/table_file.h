// Tables read back from their files.
#pragma once

#include "experiments/table.h"

namespace crosscheck {

/// A table as write_csv left it, its provenance left aside. A cell that reads as a whole number is one, other numbers
/// are doubles; in columns that hold any other text, or nothing,
/// all cells are text. Throws InputError: "FILE:LINE: expected ...".
Table read_csv(const std::filesystem::path& file);

}  // namespace crosscheck
