#include "tests/coursework/grader/changes.h"

#include <algorithm>
#include <set>

#include "tests/coursework/check/params.h"

namespace coursework {
namespace {

const Param* find(const std::vector<Param>& params, const std::string& name) {
  const auto found = std::find_if(params.begin(), params.end(), [&](const Param& p) { return p.name == name; });
  return found == params.end() ? nullptr : &*found;
}

/// A list in the inputs whose number of items is also an input: positions of this count and of the list's numbers.
struct Listed {
  std::string name;  // the count's name
  std::size_t count, begin, end, items;
};

std::vector<Listed> lists_in(const CallLayout& layout) {
  std::vector<Listed> lists;
  const auto add = [&](int counted, std::size_t begin, std::size_t end, std::size_t items) {
    if (counted < 0 || items == 0 || begin == end) return;
    for (const Field& field : layout.fields)
      if (field.begin == static_cast<std::size_t>(counted))
        lists.push_back({field.name, static_cast<std::size_t>(counted), begin, end, items});
  };
  for (const Field& field : layout.fields) add(field.counted, field.begin, field.begin + field.size(), field.columns);
  for (const FieldGroup& group : layout.groups) add(group.counted, group.begin, group.end, group.items);
  return lists;
}

/// True if the answer has a row per item. In this case no item can be left out, because the answer would lack a row.
bool is_told_by_rows(const Listed& list, const Case& what) {
  const std::size_t rows = what.expected.size() / static_cast<std::size_t>(std::max(1, what.columns));
  if (list.name == "particles" || list.name == "count") return true;
  return what.row != "particle" && rows % list.items == 0;
}

Numbers keeping(const Numbers& in, const Listed& list, std::size_t from, std::size_t items) {
  const std::size_t size = (list.end - list.begin) / list.items;
  Numbers out(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(list.begin));
  out.insert(out.end(), in.begin() + static_cast<std::ptrdiff_t>(list.begin + from * size),
             in.begin() + static_cast<std::ptrdiff_t>(list.begin + (from + items) * size));
  out.insert(out.end(), in.begin() + static_cast<std::ptrdiff_t>(list.end), in.end());
  out[list.count] = static_cast<double>(items);
  return out;
}

bool changes_list(Change::Kind kind) {
  return kind == Change::without || kind == Change::only_first || kind == Change::only_last;
}

/// Number i of the parameter p after the change; q is the other parameter, if the change needs one.
double changed_number(const Change& change, const Param& p, const Param* q, const Numbers& in, std::size_t i) {
  const double value = in[p.at[i]];
  const auto of_row = [&](std::size_t row) { return in[p.at[row * p.columns + i % p.columns]]; };
  const std::size_t row = i / p.columns, last = p.rows - 1;
  // q has a single number, one for each row of p, or one for each number of p
  const double other = q ? in[q->at[q->scalar() ? 0 : q->columns == 1 && q->rows == p.rows ? row : i]] : 0;
  switch (change.kind) {
    case Change::zero:
      return 0;
    case Change::one:
      return 1;
    case Change::minus:
      return -value;
    case Change::twice:
      return 2 * value;
    case Change::half:
      return value / 2;
    case Change::thrice:
      return 3 * value;
    case Change::third:
      return value / 3;
    case Change::square:
      return value * value;
    case Change::times:
      return value * other;
    case Change::over:
      return value / other;
    case Change::first:
      return of_row(0);
    case Change::next:
      return of_row(std::min(row + 1, last));
    case Change::previous:
      return of_row(row == 0 ? 0 : row - 1);
    case Change::exchanged:
    case Change::instead:
      return other;
    case Change::choice:
      return change.number;
    default:
      return value;
  }
}

bool same_shape(const Param& a, const Param& b) {
  return a.at.size() == b.at.size() && a.columns == b.columns && a.whole == b.whole;
}

}  // namespace

std::vector<Change> changes_of(const Texts& own, const Case& what) {
  const CallLayout layout = CallLayout::of(own, what);
  std::vector<Change> all;
  if (!layout.fits) return all;
  const std::vector<Param> params = params_of(layout);
  for (const Param& p : params) {
    if (p.whole) {
      if (p.name == "on")
        for (const double value : {0.0, 1.0}) all.push_back({Change::choice, p.name, {}, value});
      if (p.name == "rule")
        for (int rule = 0; rule < 6; ++rule) all.push_back({Change::choice, p.name, {}, double(rule)});
      continue;
    }
    for (const Change::Kind kind :
         {Change::zero, Change::minus, Change::twice, Change::half, Change::thrice, Change::third})
      all.push_back({kind, p.name});
    if (p.columns == 1)
      for (const Change::Kind kind : {Change::one, Change::square}) all.push_back({kind, p.name});
    if (p.rows > 1)
      for (const Change::Kind kind : {Change::first, Change::next, Change::previous}) all.push_back({kind, p.name});
    for (const Param& q : params) {
      if (&p == &q || q.whole) continue;
      if (same_shape(p, q)) {
        all.push_back({Change::instead, p.name, q.name});
        if (&p < &q) all.push_back({Change::exchanged, p.name, q.name});
      }
      if (q.scalar() || (q.columns == 1 && q.rows == p.rows))
        for (const Change::Kind kind : {Change::times, Change::over}) all.push_back({kind, p.name, q.name});
    }
  }
  for (const Listed& list : lists_in(layout)) {
    if (is_told_by_rows(list, what)) continue;
    all.push_back({Change::without, list.name});
    if (list.items > 1) all.push_back({Change::only_first, list.name}), all.push_back({Change::only_last, list.name});
  }
  return all;
}

std::vector<Change> removals_of(const Texts& own, const Case& what) {
  const CallLayout layout = CallLayout::of(own, what);
  std::vector<Change> all;
  if (!layout.fits) return all;
  for (const Listed& list : lists_in(layout))
    if (!is_told_by_rows(list, what)) all.push_back({Change::without, list.name});
  const std::vector<Param> params = params_of(layout);
  const bool meets = find(params, "radius") != nullptr;
  for (const Param& p : params) {
    if (p.name == "on") all.push_back({Change::choice, p.name, {}, 0});
    // Parameters that must not be set to zero: without a step nothing moves; without a radius, or at another position,
    // there is no contact that could go wrong; a direction is never zero; and answers are compared with `exact`.
    static const std::set<std::string> no_terms = {"h",      "frame",     "duration", "radius", "margin",
                                                   "centre", "before",    "proposed", "x",      "normal",
                                                   "n",      "direction", "exact"};
    // the numbers that move the particle into the obstacle must not be zero either
    const bool makes_contact = meets && (p.name == "g" || p.name == "v");
    if (!p.whole && no_terms.count(p.name) == 0 && !makes_contact) all.push_back({Change::zero, p.name});
  }
  return all;
}

std::optional<Numbers> changed(const Texts& own, const Case& what, const Change& change) {
  const CallLayout layout = CallLayout::of(own, what);
  if (!layout.fits) return {};
  if (changes_list(change.kind)) {
    for (const Listed& list : lists_in(layout))
      if (list.name == change.name)
        return keeping(what.in, list, change.kind == Change::only_last ? list.items - 1 : 0,
                       change.kind == Change::without ? 0 : 1);
    return {};
  }
  const std::vector<Param> params = params_of(layout);
  const Param *p = find(params, change.name), *q = change.other.empty() ? nullptr : find(params, change.other);
  if (!p || (!change.other.empty() && !q)) return {};
  const bool by_number = change.kind == Change::times || change.kind == Change::over;
  if (q && !same_shape(*p, *q) && !(by_number && (q->scalar() || (q->columns == 1 && q->rows == p->rows)))) return {};
  Numbers in = what.in;
  for (std::size_t i = 0; i < p->at.size(); ++i) in[p->at[i]] = changed_number(change, *p, q, what.in, i);
  if (change.kind == Change::exchanged)
    for (std::size_t i = 0; i < q->at.size(); ++i) in[q->at[i]] = what.in[p->at[i]];
  return in;
}

std::string change_text(const Texts& common, const Change& change) {
  static const char* const keys[] = {"zero",    "one",     "minus",      "twice",     "half",  "thrice",   "third",
                                     "square",  "times",   "over",       "first",     "next",  "previous", "exchanged",
                                     "instead", "without", "only_first", "only_last", "choice"};
  return common.fill(std::string("change.") + keys[change.kind], change.name, change.other,
                     std::to_string(static_cast<int>(change.number)));
}

}  // namespace coursework
