// The table of the keys that a scene file may have, and the validation of a whole file against it.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace crosscheck {

/// One key of a table.
struct Key {
  enum class Kind { value, table, tables, table_or_tables };  // = ..., [name], [[name]], either of the two
  std::string_view name;
  std::string_view expected;  // for a value: expected content with unit; for tables: their purpose
  bool required = false;
  Kind kind = Kind::value;
  std::span<const Key> below = {};  // keys of a table
  std::string_view unless = {};     // not required if this key is in the same table or in an enclosing one
};

/// Checks the keys of the whole file before any value is read. Throws InputError at the first table that is malformed,
/// misses keys (all are named, with the expected content) or has unknown keys (with the closest known key, or the table
/// where the key belongs). For text that is not TOML, the message suggests the likely intent. `name` replaces the file
/// name in messages.
void check_keys(std::string_view text, const std::string& name, std::span<const Key> keys);

// The keys of a scene file.

/// Maximum number of samples of a run.
constexpr int most_samples = 1000000;

/// Every key that a scene file may have, its expected content, and which keys are required.
std::span<const Key> scene_keys();

}  // namespace crosscheck
