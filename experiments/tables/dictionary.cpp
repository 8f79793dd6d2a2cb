// One visible list of all row types.
#include "experiments/tables/dictionary.h"

#include <algorithm>

#include "experiments/tables/adequacy.h"
#include "experiments/tables/bench.h"
#include "experiments/tables/certificates.h"
#include "experiments/tables/cost.h"
#include "experiments/tables/disagreements.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/order.h"
#include "experiments/tables/speed_accuracy.h"
#include "experiments/tables/sphere.h"
#include "experiments/tables/stability.h"
#include "experiments/tables/stiffness.h"

namespace crosscheck {
namespace {

using AllRows = std::tuple<                                                               //
    EngineRow, EngineCostRow, EngineTimeRow, EngineEnergyRow, StatisticRow, AttestedRow,  //
    SceneEnergyRow, SceneLedgerRow, EnergyRow, DampingRow,                                //
    ReboundRow, LeavingRow, ConeRow, DrapeRow, PenetrationRow, DrapeTimeRow,              //
    AdequacyRow, LeastModelRow, GridRow, BendingRow, ScalingRow,                          //
    OrderRow, OrderSlopeRow,                                                              //
    LinkStiffnessRow, NetworkStiffnessRow,                                                //
    DisagreementRow, DisagreementCurveRow, ContactAngleRow,                               //
    SpeedAccuracyRow, SpeedAccuracyTimingRow, SpeedAccuracyCostRow, ParetoRow<Cost::evaluations>,
    ParetoRow<Cost::cpu>,                                                    //
    CheapestRow<Cost::evaluations>, CheapestRow<Cost::cpu>, EngineSpeedRow,  //
    LimitRow, FailureRow, GrowthRow, MapRow, MapLimitRow, MapCheckRow,       //
    SizeCostRow, PhaseCostRow, RooflineRow,                                  //
    KernelRow, SceneKernelRow, EqualErrorRow, OwnRunRow, SameStepRow, ImplicitStepRow, ThreadsRow>;

struct DictionaryRow {
  std::string table_name, column_name, unit, type, description;

  static constexpr std::string_view table = "dictionary";
  static constexpr auto columns = std::tuple{
      column("table", "1", &DictionaryRow::table_name, "table; SCENE and NAME stand for a scene and a disagreement"),
      column("column", "1", &DictionaryRow::column_name, "column"),
      column("unit", "1", &DictionaryRow::unit, "unit; 1 where it has none"),
      column("type", "1", &DictionaryRow::type, "what its cells hold"),
      column("description", "1", &DictionaryRow::description, "what it means")};
};

template <class T>
struct TypeName {
  static std::string of() {
    if constexpr (std::is_same_v<T, bool>) return "0 or 1";
    if constexpr (std::is_integral_v<T>) return "whole number";
    if constexpr (std::is_floating_point_v<T>) return "number";
    if constexpr (std::is_enum_v<T>) {
      std::string words;
      for (int i = static_cast<int>(EnumRange<T>::first); i <= static_cast<int>(EnumRange<T>::last); ++i)
        words += fmt::format("{}{}", words.empty() ? "one of: " : " | ", name_of(static_cast<T>(i)));
      return words;
    }
    return "text";
  }
};
template <class T>
struct TypeName<std::optional<T>> {
  static std::string of() { return TypeName<T>::of() + ", or empty"; }
};

template <class Row>
void describe(Table& dictionary) {
  const auto add_column = [&]<class T>(const ColumnOf<Row, T>& column) {
    add(dictionary, DictionaryRow{std::string(Row::table), std::string(column.name), std::string(column.unit),
                                  TypeName<T>::of(), std::string(column.description)});
  };
  std::apply([&](const auto&... column) { (add_column(column), ...); }, Row::columns);
}

template <class Row>
bool is_among(std::span<const Table> tables) {
  std::string_view name = Row::table;
  const bool one_of_many = name.starts_with("SCENE-") || name.starts_with("NAME-");
  if (one_of_many) name.remove_prefix(name.find('-'));
  // engines-energy is no SCENE-energy
  return std::ranges::any_of(tables, [&](const Table& t) {
    return one_of_many ? t.name.ends_with(name) && t.columns.size() == columns_of<Row>().size() : t.name == name;
  });
}

}  // namespace

Table dictionary() {
  Table all = table_of<DictionaryRow>();
  [&]<class... Row>(std::type_identity<std::tuple<Row...>>) {
    (describe<Row>(all), ...);
  }(std::type_identity<AllRows>());
  return all;
}

Table dictionary(std::span<const Table> present) {
  Table some = table_of<DictionaryRow>();
  [&]<class... Row>(std::type_identity<std::tuple<Row...>>) {
    ((is_among<Row>(present) ? describe<Row>(some) : void()), ...);
  }(std::type_identity<AllRows>());
  return some;
}

Table with_declared_types(Table read) {
  const auto retype = [&]<class Row>(std::type_identity<Row>) {
    if (!is_among<Row>({&read, 1}) || read.columns != columns_of<Row>()) return false;
    Table typed = table_of<Row>(read.name);
    for (const Row& row : rows_of<Row>(read)) add(typed, row);
    read = std::move(typed);
    return true;
  };
  [&]<class... Row>(std::type_identity<std::tuple<Row...>>) {
    (retype(std::type_identity<Row>{}) || ...);
  }(std::type_identity<AllRows>());
  return read;
}

}  // namespace crosscheck
