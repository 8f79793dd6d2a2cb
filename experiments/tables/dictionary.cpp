#include "experiments/tables/dictionary.h"

#include <algorithm>

#include "experiments/tables/adequacy.h"
#include "experiments/tables/bench.h"
#include "experiments/tables/certificates.h"
#include "experiments/tables/check.h"
#include "experiments/tables/contact.h"
#include "experiments/tables/cost.h"
#include "experiments/tables/disagreements.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/fabric.h"
#include "experiments/tables/matrix.h"
#include "experiments/tables/order.h"
#include "experiments/tables/speed_accuracy.h"
#include "experiments/tables/stability.h"
#include "experiments/tables/stiffness.h"

namespace crosscheck {
namespace {

using AllRows = std::tuple<                                                               //
    EngineRow, EngineCostRow, EngineTimeRow, EngineEnergyRow, StatisticRow, AttestedRow,  //
    SceneEnergyRow, SceneLedgerRow, EnergyRow, DampingRow,                                //
    ReboundRow, LeavingRow, ContactOrderRow, ConeRow, PlaneConeRow, PlaneProbeRow, DrapeRow, PenetrationRow,
    DrapeTimeRow,                                                                               //
    AdequacyRow, LeastModelRow, GridRow, BendingRow, ScalingRow,                                //
    OrderRow, OrderSlopeRow,                                                                    //
    LinkStiffnessRow, NetworkStiffnessRow, EffectiveStiffnessRow, PulledSheetRow,               //
    CantileverRow, StripVibrationRow, SkipOneRow, HangingStripRow, HangingShapeRow,             //
    DrapedDiscRow, DrapedParticleRow,                                                           //
    DisagreementRow, DisagreementCurveRow, ContactAngleRow, MatrixRow<false>, MatrixRow<true>,  //
    SpeedAccuracyRow, SpeedAccuracyTimingRow, SpeedAccuracyCostRow, ParetoRow<Cost::evaluations>,
    ParetoRow<Cost::cpu>,                                                    //
    CheapestRow<Cost::evaluations>, CheapestRow<Cost::cpu>, EngineSpeedRow,  //
    LimitRow, FailureRow, GrowthRow, MapRow, MapLimitRow, MapCheckRow,       //
    SizeCostRow, PhaseCostRow, RooflineRow,                                  //
    BenchRow,                                                                //
    RelationRow>;

struct DictionaryRow {
  TABLE("dictionary");
  COLUMN(std::string, table_name, "table", "1",
         "table; SCENE and NAME are placeholders for a scene and a disagreement");
  COLUMN(std::string, column_name, "column", "1", "name of the column");
  COLUMN(std::string, unit, "unit", "1", "unit; 1 if dimensionless");
  COLUMN(std::string, type, "type", "1", "type of its cells");
  COLUMN(std::string, description, "description", "1", "description of the column");
};

struct DeclaredTable {
  std::string_view name;
  std::span<const TypedColumn> columns;

  bool is(const Table& table) const {
    const bool one_of_many = name.starts_with("SCENE-") || name.starts_with("NAME-");
    // "engines-energy" must not match "SCENE-energy"
    return one_of_many ? table.name.ends_with(name.substr(name.find('-'))) &&
                             std::ranges::equal(table.columns, columns, {}, &Column::name, &TypedColumn::name)
                       : table.name == name;
  }
};

template <class... Row>
std::vector<DeclaredTable> declared(std::type_identity<std::tuple<Row...>>) {
  return {{Row::table, typed_columns<Row>()}...};
}
std::vector<DeclaredTable> all_declared() { return declared(std::type_identity<AllRows>()); }

void describe(const DeclaredTable& table, Table& dictionary) {
  for (const TypedColumn& column : table.columns)
    add(dictionary, DictionaryRow{std::string(table.name), std::string(column.name), std::string(column.unit),
                                  column.type->name(), std::string(column.description)});
}

}  // namespace

Table dictionary() {
  Table all = table_of<DictionaryRow>();
  for (const DeclaredTable& table : all_declared()) describe(table, all);
  return all;
}

Table dictionary(std::span<const Table> present) {
  Table some = table_of<DictionaryRow>();
  for (const DeclaredTable& table : all_declared())
    if (std::ranges::any_of(present, [&](const Table& t) { return table.is(t); })) describe(table, some);
  return some;
}

Table with_declared_types(Table read) {
  for (const DeclaredTable& declared : all_declared()) {
    if (!declared.is(read) || read.columns != columns_of(declared.columns)) continue;
    for (std::vector<Cell>& row : read.rows) row = retyped(declared.columns, read, row);
    return read;
  }
  return read;
}

}  // namespace crosscheck
