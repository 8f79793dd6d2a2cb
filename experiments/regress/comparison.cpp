#include "experiments/regress/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace crosscheck {
namespace {

/// True if the value is finite; false also for the word `nan`.
bool is_finite(const Quantity& q) { return q.is_word() ? q.word != name_of(Verdict::nan) : std::isfinite(q.value); }

Status state_of(const Quantity& is, const QuantityWithTolerance& was) {
  if ((is.is_word() || was.quantity.is_word()) && is.word != was.quantity.word) return Status::moved;
  if (!is_finite(is)) return Status::not_finite;
  if (is.is_word()) return Status::same;
  return std::abs(is.value - was.quantity.value) <= was.tolerance ? Status::same : Status::moved;
}

Comparison about(const Case& test_case, const Quantity& quantity) {
  Comparison row;
  row.scene = test_case.scene.name, row.method = test_case.method.name, row.without = test_case.without;
  row.quantity = quantity.name, row.unit = quantity.unit;
  return row;
}

void set(std::optional<double>& number, std::string& word, const Quantity& quantity) {
  if (quantity.is_word())
    word = quantity.word;
  else
    number = quantity.value;
}

}  // namespace

std::string_view name_of(Status state) {
  constexpr std::string_view names[] = {"moved", "not finite", "gone", "missing", "stale", "unreadable", "new", "same"};
  return names[static_cast<int>(state)];
}

double Comparison::off() const {
  if (!was || !is || *was == *is) return 0;
  return std::abs(*is - *was) / tolerance;
}

double Comparison::rank() const {
  if (unit == "word") return INFINITY;
  return std::isinf(off()) ? 0 : off();
}

std::vector<Comparison> worst_comparisons(const std::vector<Comparison>& rows) {
  std::vector<Comparison> worst;
  for (const Comparison& row : rows) {
    if (!failed(row.state)) continue;
    const auto same = std::find_if(worst.begin(), worst.end(), [&](const Comparison& w) {
      return w.scene == row.scene && w.method == row.method && w.without == row.without && w.state == row.state;
    });
    if (same == worst.end())
      worst.push_back(row);
    else if (row.rank() > same->rank())
      *same = row;
  }
  return worst;
}

std::vector<NewMethod> new_methods(std::span<const Comparison> rows) {
  std::set<std::pair<std::string, std::string>> known;  // scene, method
  for (const Comparison& row : rows)
    if (row.was || !row.was_word.empty() || row.state == Status::gone) known.emplace(row.scene, row.method);
  std::map<std::string, NewMethod> by_name;
  std::set<std::pair<std::string, std::string>> counted;
  for (const Comparison& row : rows) {
    if (row.state != Status::added || known.contains({row.scene, row.method})) continue;
    NewMethod& method = by_name.try_emplace(row.method, NewMethod{row.method}).first->second;
    ++method.quantities;
    method.scenes += counted.emplace(row.scene, row.method).second;
  }
  std::vector<NewMethod> all;
  for (const auto& [name, method] : by_name) all.push_back(method);
  return all;
}

std::vector<BaselineRow> baseline_rows_of(const Baseline& baseline, const Case& test_case) {
  std::vector<BaselineRow> rows;
  for (const BaselineRow& e : baseline.expected)
    if (e.method == test_case.method.name && e.without == test_case.without) rows.push_back(e);
  return rows;
}

std::vector<Comparison> compared(const Case& test_case, const std::vector<Quantity>& is,
                                 const std::vector<BaselineRow>& expected) {
  std::vector<Comparison> rows;
  for (const Quantity& q : is) {
    Comparison row = about(test_case, q);
    set(row.is, row.is_word, q);
    const auto was = std::find_if(expected.begin(), expected.end(),
                                  [&](const BaselineRow& e) { return e.what.quantity.name == q.name; });
    if (was == expected.end()) {
      row.state = is_finite(q) ? Status::added : Status::not_finite;
    } else {
      set(row.was, row.was_word, was->what.quantity);
      row.tolerance = was->what.tolerance;
      row.state = state_of(q, was->what);
    }
    rows.push_back(row);
  }
  for (const BaselineRow& e : expected)
    if (!find(is, e.what.quantity.name)) {
      Comparison row = about(test_case, e.what.quantity);
      set(row.was, row.was_word, e.what.quantity);
      row.tolerance = e.what.tolerance;
      row.state = Status::gone;
      rows.push_back(row);
    }
  return rows;
}

}  // namespace crosscheck
