#include "experiments/regress/verdicts.h"

#include <algorithm>
#include <cmath>

namespace crosscheck {
namespace {

Standing state_of(const Quantity& is, const Toleranced& was) {
  if (is.is_word() || was.quantity.is_word()) return is.word == was.quantity.word ? Standing::same : Standing::moved;
  if (!std::isfinite(is.value)) return Standing::not_finite;
  return std::abs(is.value - was.quantity.value) <= was.tolerance ? Standing::same : Standing::moved;
}

Compared about(const Question& question, const Quantity& quantity) {
  Compared row;
  row.scene = question.scene.name, row.method = question.method.name, row.without = question.without;
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

std::string_view name_of(Standing state) {
  // in the order of the states
  constexpr std::string_view names[] = {"moved", "not finite", "gone", "missing", "stale", "unreadable", "new", "same"};
  return names[static_cast<int>(state)];
}

double Compared::off() const {
  if (!was || !is || *was == *is) return 0;
  return std::abs(*is - *was) / tolerance;
}

double Compared::rank() const {
  if (unit == "word") return INFINITY;
  return std::isinf(off()) ? 0 : off();
}

std::vector<Compared> worst_of_each(const std::vector<Compared>& rows) {
  std::vector<Compared> worst;
  for (const Compared& row : rows) {
    if (!failed(row.state)) continue;
    const auto same = std::find_if(worst.begin(), worst.end(), [&](const Compared& w) {
      return w.scene == row.scene && w.method == row.method && w.without == row.without && w.state == row.state;
    });
    if (same == worst.end())
      worst.push_back(row);
    else if (row.rank() > same->rank())
      *same = row;
  }
  return worst;
}

std::vector<Expected> expected_of(const Baseline& baseline, const Question& question) {
  std::vector<Expected> rows;
  for (const Expected& e : baseline.expected)
    if (e.method == question.method.name && e.without == question.without) rows.push_back(e);
  return rows;
}

std::vector<Compared> compared(const Question& question, const std::vector<Quantity>& is,
                               const std::vector<Expected>& expected) {
  std::vector<Compared> rows;
  const auto same_name = [](const std::string& name) {
    return [&name](const auto& each) {
      if constexpr (std::is_same_v<std::decay_t<decltype(each)>, Expected>)
        return each.what.quantity.name == name;
      else
        return each.name == name;
    };
  };
  for (const Quantity& q : is) {
    Compared row = about(question, q);
    set(row.is, row.is_word, q);
    const auto was = std::find_if(expected.begin(), expected.end(), same_name(q.name));
    if (was == expected.end()) {
      row.state = !q.is_word() && !std::isfinite(q.value) ? Standing::not_finite
                  : expected.empty()                      ? Standing::missing
                                                          : Standing::fresh;
    } else {
      set(row.was, row.was_word, was->what.quantity);
      row.tolerance = was->what.tolerance;
      row.state = state_of(q, was->what);
    }
    rows.push_back(row);
  }
  for (const Expected& e : expected)
    if (std::none_of(is.begin(), is.end(), same_name(e.what.quantity.name))) {
      Compared row = about(question, e.what.quantity);
      set(row.was, row.was_word, e.what.quantity);
      row.tolerance = e.what.tolerance;
      row.state = Standing::gone;
      rows.push_back(row);
    }
  return rows;
}

}  // namespace crosscheck
