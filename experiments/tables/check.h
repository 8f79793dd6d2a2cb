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

/// A break that the hunter found, on the smallest scene that still shows it.
struct HuntFindingRow {
  long index = 0;
  std::string methods, relation, kind;
  RelationMark mark = RelationMark::broken;
  std::string compared, unit;
  std::optional<double> measured, tolerance, since;
  std::string sentence;
  int particles_drawn = 0, particles = 0, springs = 0, trials = 0;
  std::string scene;

  static constexpr std::string_view table = "hunt-findings";
  static constexpr auto columns = [](auto&& column) {
    column("case", "1", &HuntFindingRow::index, "number of the case, which with the seed gives the scene"),
        column("methods", "1", &HuntFindingRow::methods, "method that was asked, or A & B of a pair"),
        column("relation", "1", &HuntFindingRow::relation, "relation that is broken; agreement: of a pair"),
        column("kind", "1", &HuntFindingRow::kind, "ingredients of the smallest scene"),
        column("mark", "1", &HuntFindingRow::mark, "broken; known: listed as known, and not made smaller"),
        column("compared", "1", &HuntFindingRow::compared, "what was measured"),
        column("unit", "1", &HuntFindingRow::unit, "unit of what was measured"),
        column("measured", "unit", &HuntFindingRow::measured, "value on the smallest scene, where it is worst"),
        column("tolerance", "unit", &HuntFindingRow::tolerance, "largest value at which the relation holds there"),
        column("since", "s", &HuntFindingRow::since, "first time over the tolerance"),
        column("sentence", "1", &HuntFindingRow::sentence, "both in words, or how a run failed"),
        column("particles drawn", "1", &HuntFindingRow::particles_drawn, "particles of the scene as drawn"),
        column("particles", "1", &HuntFindingRow::particles, "particles of the smallest scene"),
        column("springs", "1", &HuntFindingRow::springs, "springs of the smallest scene"),
        column("trials", "1", &HuntFindingRow::trials, "scenes that were asked to make it smaller"),
        column("scene file", "1", &HuntFindingRow::scene, "text of the file of the smallest scene");
  };
};

/// A case of the hunter.
struct HuntCaseRow {
  long index = 0;
  std::string kind;
  int particles = 0, springs = 0, holds = 0, broken = 0, known = 0, not_asked = 0;

  static constexpr std::string_view table = "hunt-cases";
  static constexpr auto columns = [](auto&& column) {
    column("case", "1", &HuntCaseRow::index, "number of the case, which with the seed gives the scene"),
        column("kind", "1", &HuntCaseRow::kind, "ingredients of the scene as drawn"),
        column("particles", "1", &HuntCaseRow::particles, "particles of the scene as drawn"),
        column("springs", "1", &HuntCaseRow::springs, "springs of the scene as drawn"),
        column("holds", "1", &HuntCaseRow::holds, "relations and agreements that hold"),
        column("broken", "1", &HuntCaseRow::broken, "those that are broken"),
        column("known", "1", &HuntCaseRow::known, "those that are broken, and listed as known"),
        column("not asked", "1", &HuntCaseRow::not_asked, "those that cannot be asked there");
  };
};

}  // namespace crosscheck
