// The keys that a scene file may have, as one visible table, and the check of a whole file against it.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace crosscheck {

/// One key of a table.
struct Key {
  enum class Kind { value, table, tables, table_or_tables };  // = ..., [name], [[name]], either
  std::string_view name;
  std::string_view expected;  // of a value: what stands behind the =, with its unit; of tables: what they are for
  bool required = false;
  Kind kind = Kind::value;
  std::span<const Key> below = {};  // of tables: their keys
  std::string_view unless = {};     // not required where this key stands in the same table or in one around it
};

/// Looks at the keys of the whole file before any value is read. Throws InputError on the first table that lacks keys
/// (it names them all and says what is expected of each), has unknown keys (with the nearest one, or where
/// the key belongs) or that is no table; on text that is no TOML it says what was probably meant. name stands in for
/// the file in messages.
void check_keys(std::string_view text, const std::string& name, std::span<const Key> keys);

// The keys of a scene file.

/// The most samples that a run may have.
constexpr int most_samples = 1000000;

/// Every key that a scene file may have, what stands there, and which ones it must have.
std::span<const Key> scene_keys();

}  // namespace crosscheck
