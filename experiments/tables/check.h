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
struct EnumRange<RelationMark> {
  static constexpr RelationMark first = RelationMark::holds, last = RelationMark::not_asked;
};

/// A relation that was asked of a method.
struct RelationRow {
  std::string method, relation, scene;
  RelationMark mark = RelationMark::holds;
  std::string compared, unit;
  std::optional<double> measured, tolerance, ratio, since;
  std::string reason, scene_hash;

  static constexpr std::string_view table = "relations";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &RelationRow::method, "method that was asked"),
        column("relation", "1", &RelationRow::relation, "name of the relation"),
        column("scene", "1", &RelationRow::scene, "scene on which it was asked"),
        column("mark", "1", &RelationRow::mark, "whether it holds; known: broken, and listed as known"),
        column("compared", "1", &RelationRow::compared, "what was measured"),
        column("unit", "1", &RelationRow::unit, "unit of what was measured"),
        column("measured", "unit", &RelationRow::measured, "value that was measured, where it is worst"),
        column("tolerance", "unit", &RelationRow::tolerance, "largest value at which the relation holds there"),
        column("ratio", "1", &RelationRow::ratio, "measured over tolerance; empty where no tolerance is allowed"),
        column("since", "s", &RelationRow::since, "first time over the tolerance"),
        column("reason", "1", &RelationRow::reason,
               "why it could not be asked, how a run failed, or why the break is known"),
        column("scene hash", "1", &RelationRow::scene_hash, "fingerprint of the scene");
  };
};

}  // namespace crosscheck
