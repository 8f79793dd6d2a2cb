// The keys that a scene file may have, and the check of a whole file.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace crosscheck {

struct Key {
  enum class Kind { value, table, tables, table_or_tables };  // key = ..., [key], [[key]], either of the two
  std::string_view name;
  std::string_view expected;  // for values, the content with its unit; for tables, their purpose
  bool required = false;
  Kind kind = Kind::value;
  std::span<const Key> below = {};  // keys of a table
  std::string_view unless = {};     // not required if this key is in the same or an enclosing table
};

/// Checks the keys of the whole file before any value is read. Throws InputError at the first table that is malformed,
/// lacks keys or has unknown keys. The message lists missing keys with their expected content; for an unknown key, it
/// names the closest known key, or the table where the key belongs. For text that is not TOML, it suggests the likely
/// intent. `name` stands for the file in messages.
void check_keys(std::string_view text, const std::string& name, std::span<const Key> keys);

/// Maximum per run.
constexpr int most_samples = 1000000;

/// Every key that a scene file may have.
std::span<const Key> scene_keys();

}  // namespace crosscheck
