// The table of `check`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

enum class RelationMark { holds, broken, known, not_asked };
inline std::string_view name_of(RelationMark mark) {
  constexpr std::string_view names[] = {"holds", "broken", "known", "cannot be asked"};
  return names[static_cast<int>(mark)];
}
template <>
inline constexpr std::pair range_of<RelationMark>{RelationMark::holds, RelationMark::not_asked};

/// A relation that was asked of a method.
struct RelationRow {
  TABLE("relations");
  COLUMN(std::string, method, "method", "1", "method that was asked");
  COLUMN(std::string, relation, "relation", "1", "name of the relation");
  COLUMN(std::string, scene, "scene", "1", "scene on which it was asked");
  COLUMN(RelationMark, mark, "mark", "1", "whether it holds; known: broken, and listed as known");
  COLUMN(std::string, compared, "compared", "1", "what was measured");
  COLUMN(std::string, unit, "unit", "1", "unit of what was measured");
  COLUMN(OptionalNumber, measured, "measured", "unit", "value that was measured, where it is worst");
  COLUMN(OptionalNumber, tolerance, "tolerance", "unit", "largest value at which the relation holds there");
  COLUMN(OptionalNumber, ratio, "ratio", "1", "measured over tolerance; empty where no tolerance is allowed");
  COLUMN(OptionalNumber, since, "since", "s", "first time over the tolerance");
  COLUMN(std::string, reason, "reason", "1", "why it could not be asked, how a run failed, or why the break is known");
  COLUMN(std::string, scene_hash, "scene hash", "1", "fingerprint of the scene");
};

}  // namespace crosscheck
