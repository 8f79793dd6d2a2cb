// Rows as JSON, and back to the same bits: how a finished point is kept.
#pragma once

#include <string>

#include "experiments/point.h"

namespace crosscheck {

std::string rows_json(const Rows& rows);
/// Throws InputError, "expected ...", when the text is no rows.
Rows read_rows(const std::string& text);

}  // namespace crosscheck
