#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

enum class RelationMark { holds, broken, known, not_applicable };
inline std::string_view name_of(RelationMark mark) {
  constexpr std::string_view names[] = {"holds", "broken", "known", "not applicable"};
  return names[static_cast<int>(mark)];
}
template <>
inline constexpr std::pair range_of<RelationMark>{RelationMark::holds, RelationMark::not_applicable};

struct RelationRow {
  TABLE("relations");
  COLUMN(std::string, method, "method", "1", "method that was checked");
  COLUMN(std::string, relation, "relation", "1", "name of the relation");
  COLUMN(std::string, scene, "scene", "1", "scene on which the relation was checked");
  COLUMN(RelationMark, mark, "mark", "1", "whether the relation holds; known: broken, and listed as known");
  COLUMN(std::string, compared, "compared", "1", "quantity that was measured");
  COLUMN(std::string, unit, "unit", "1", "unit of that quantity");
  COLUMN(OptionalNumber, measured, "measured", "unit", "measured value, at its worst");
  COLUMN(OptionalNumber, tolerance, "tolerance", "unit", "largest value for which the relation holds at that place");
  COLUMN(OptionalNumber, ratio, "ratio", "1", "measured over tolerance; empty where no tolerance is allowed");
  COLUMN(OptionalNumber, since, "since", "s", "first time at which the tolerance is exceeded");
  COLUMN(std::string, reason, "reason", "1", "why it is not applicable, how a run failed, or why the break is known");
  COLUMN(std::string, scene_hash, "scene hash", "1", "fingerprint of the scene");
};

}  // namespace crosscheck
