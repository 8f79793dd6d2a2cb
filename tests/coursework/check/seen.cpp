#include "seen.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

#include "words.h"

namespace coursework {
namespace {

using std::size_t;

/// A possible origin of the wrong numbers of a vector.
struct Instead {
  std::string text;
  bool factor = false;  // states a factor, which may fit a single case by chance
};

/// The expected and actual numbers of an answer. A block is a vector that each row contains.
class Seen {
 public:
  Seen(const Texts& common, const Texts& own, const Case& what, const Numbers& got)
      : common_(common),
        own_(own),
        what_(what),
        got_(got),
        columns_(static_cast<size_t>(std::max(1, what.columns))),
        rows_(what.expected.size() / columns_),
        blocks_(blocks_of(own, what)) {
    double largest = 0;
    for (const double value : what.expected) largest = std::max(largest, std::abs(value));
    for (const double value : got) largest_got_ = std::max(largest_got_, std::abs(value));
    tolerance_ = std::max(what.tolerance, 1e-13 * largest);
    // a loose tolerance means a measured quantity (an order, an angle), to which exact arithmetic does not apply
    exact_ =
        largest > 0 ? tolerance_ <= 1e-4 * largest && largest_got_ < 1e3 * largest : tolerance_ <= 1e-4 * largest_got_;
    tolerance_ *= largest > 0 ? std::max(1.0, largest_got_ / largest) : 1;
    const CallLayout layout = CallLayout::of(own, what);
    if (layout.fits) params_ = params_of(layout);
  }

  bool exact() const { return exact_; }

  std::string split() const {
    std::string right, wrong;
    for (const Block& block : blocks_) {
      std::vector<size_t> bad, good;
      for (size_t row = 0; row < rows_; ++row) (wrong_in(block, row) ? bad : good).push_back(row);
      const auto add = [&](std::string& to, const std::vector<size_t>& rows) {
        if (rows.empty()) return;
        const std::string of = rows.size() == rows_ ? "" : rows_text(rows);
        const std::string name = block_text(block);
        to += (to.empty() ? "" : "; ") + (of.empty() ? name : common_.fill("seen.of", name, of));
      };
      const std::string parts = bad.empty() ? "" : parts_text(block, bad);
      if (!parts.empty() && good.empty()) {
        to_list(wrong, parts);
        const std::string others = other_parts(block, bad);
        to_list(right, others);
        continue;
      }
      add(right, good), add(wrong, bad);
    }
    if (right.empty() || wrong.empty()) return "";
    return common_.fill("seen.split", right, wrong);
  }

  /// Explanations of the wrong numbers, for each vector.
  std::vector<std::vector<Instead>> instead() const {
    std::vector<std::vector<Instead>> all;
    for (const Block& block : blocks_) {
      std::vector<size_t> bad;
      for (size_t row = 0; row < rows_; ++row)
        if (wrong_in(block, row)) bad.push_back(row);
      all.push_back(bad.empty() || is_code(block) ? std::vector<Instead>() : explanations(block, bad));
      all_wrong_.push_back(!bad.empty());
    }
    return all;
  }
  /// True if any number of this vector is wrong. Call instead() first.
  bool is_wrong(size_t block) const { return all_wrong_.at(block); }

 private:
  static void to_list(std::string& to, const std::string& one) {
    if (!one.empty()) to += (to.empty() ? "" : "; ") + one;
  }
  double expected(const Block& b, size_t row, size_t k) const { return what_.expected[row * columns_ + b.begin + k]; }
  double got(const Block& b, size_t row, size_t k) const { return got_[row * columns_ + b.begin + k]; }
  bool wrong_at(const Block& b, size_t row, size_t k) const {
    return !(std::abs(got(b, row, k) - expected(b, row, k)) <= std::max(what_.tolerance, 1e-300));
  }
  bool wrong_in(const Block& b, size_t row) const {
    for (size_t k = 0; k < b.width; ++k)
      if (wrong_at(b, row, k)) return true;
    return false;
  }
  std::string block_text(const Block& block) const {
    if (!block.name.empty()) return block.name;
    if (block.width == columns_) return common_.of("seen.row");
    std::string parts;
    for (size_t k = 0; k < block.width; ++k)
      parts += (k ? ", " : "") + column_text(own_, what_, static_cast<int>(block.begin + k));
    return parts;
  }

  /// True for numbers that stand for words (kinds, directions), to which arithmetic does not apply.
  bool is_code(const Block& block) const {
    for (size_t row = 0; row < rows_; ++row)
      if (expected(block, row, 0) != std::round(expected(block, row, 0))) return false;
    return own_.has("column." + what_.column + ".legend");
  }

  std::string rows_text(const std::vector<size_t>& rows) const {
    const std::string name = name_text(own_, "row.", what_.row), first = "row." + what_.row + ".first";
    const size_t from = own_.has(first) ? static_cast<size_t>(std::atoi(own_.of(first).c_str())) : 0;
    const bool range = rows.back() - rows.front() + 1 == rows.size();
    if (rows.size() > 2 && range)
      return name + " " + std::to_string(rows.front() + from) + " - " + std::to_string(rows.back() + from);
    if (rows.size() > 8) return common_.fill("seen.some", std::to_string(rows.size()), std::to_string(rows_), name);
    std::string list;
    for (const size_t row : rows) list += (list.empty() ? "" : ", ") + std::to_string(row + from);
    return name + " " + list;
  }

  bool part_is_wrong(const Block& block, const std::vector<size_t>& rows, size_t k) const {
    return std::any_of(rows.begin(), rows.end(), [&](size_t row) { return wrong_at(block, row, k); });
  }
  /// Names of the wrong components of the vector; empty unless a right component is expected to be nonzero.
  std::string parts_text(const Block& block, const std::vector<size_t>& rows) const {
    if (block.width < 2 || other_parts(block, rows).empty()) return "";
    return parts(block, rows, true);
  }
  std::string other_parts(const Block& block, const std::vector<size_t>& rows) const {
    for (size_t k = 0; k < block.width; ++k) {
      const bool some = std::any_of(rows.begin(), rows.end(), [&](size_t row) { return expected(block, row, k) != 0; });
      if (!part_is_wrong(block, rows, k) && some) return parts(block, rows, false);
    }
    return "";
  }
  std::string parts(const Block& block, const std::vector<size_t>& rows, bool wrong) const {
    std::string list;
    for (size_t k = 0; k < block.width; ++k)
      if (part_is_wrong(block, rows, k) == wrong)
        to_list(list, column_text(own_, what_, static_cast<int>(block.begin + k)));
    return list;
  }

  bool near(double a, double b, double size = 1) const { return std::abs(a - b) <= tolerance_ * std::max(1.0, size); }

  /// True if the actual numbers of the block equal `other` in all these rows.
  template <class Other>
  bool is(const Block& block, const std::vector<size_t>& rows, Other other, double size = 1) const {
    for (const size_t row : rows)
      for (size_t k = 0; k < block.width; ++k)
        if (!near(got(block, row, k), other(row, k), size)) return false;
    return true;
  }

  /// The ratio of `value` to `unit` if it is the same in all of these rows; nan otherwise, or if evidence is too weak.
  template <class Value, class Unit>
  double multiple(const Block& block, const std::vector<size_t>& rows, Value value, Unit unit) const {
    double both = 0, squares = 0, largest = 0;
    size_t counted = 0;  // significant numbers
    for (const size_t row : rows)
      for (size_t k = 0; k < block.width; ++k) {
        const double u = unit(row, k);
        both += u * value(row, k), squares += u * u, largest = std::max(largest, std::abs(u));
      }
    if (!(squares > 0)) return NAN;
    const double factor = both / squares;
    for (const size_t row : rows)
      for (size_t k = 0; k < block.width; ++k) {
        if (!near(value(row, k), factor * unit(row, k), std::abs(factor))) return NAN;
        counted += std::abs(unit(row, k)) > 1e-6 * largest;
      }
    relative_ = std::max(
        1e-11, 4 * tolerance_ * std::max(1.0, std::abs(factor)) / (largest * std::max(std::abs(factor), 1e-300)));
    relative_ = std::min(relative_, 1e-3);
    // a factor without a name needs more evidence, because it may match by chance
    const bool named =
        !names_of_number(factor, relative_, counted > 1 ? params_ : std::vector<Param>(), what_.in).empty();
    return named || counted >= 6 ? factor : NAN;
  }

  /// Name of a factor that each row takes from its entry of a list among the inputs, such as m or 1/m; empty if none
  /// fits.
  template <class Value, class Unit>
  std::string row_multiple(const Block& block, const std::vector<size_t>& rows, Value value, Unit unit) const {
    std::string found;
    for (const Param& list : params_) {
      if (list.whole || list.rows != rows_ || list.columns != 1 || rows_ < 2) continue;
      const auto number = [&](size_t row) { return what_.in[list.at[row]]; };
      const std::pair<std::string, std::function<double(size_t)>> factors[] = {
          {list.name, number},
          {"1/" + list.name, [&](size_t row) { return 1 / number(row); }},
          {list.name + "/" + list.name + "[0]", [&](size_t row) { return number(row) / number(0); }},
          {list.name + "[0]/" + list.name, [&](size_t row) { return number(0) / number(row); }}};
      for (const auto& [text, factor] : factors)
        for (const double sign : {1.0, -1.0}) {
          size_t counted = 0;
          bool fits = true;
          for (const size_t row : rows)
            for (size_t k = 0; k < block.width && fits; ++k) {
              fits = near(value(row, k), sign * factor(row) * unit(row, k), std::abs(factor(row)));
              counted += std::abs(unit(row, k)) > 1e3 * tolerance_;
            }
          if (!fits || counted < 2) continue;
          if (!found.empty()) return "";
          found = (sign < 0 ? "-" : "") + text;
        }
    }
    return found;
  }

  /// Adds the text `key` with each name of the factor, and with `of_row`, the factor that varies from row to row.
  void add_factors(std::vector<Instead>& found, double factor, const std::string& of_row, const std::string& key,
                   const std::string& name, const std::string& of) const {
    std::vector<std::string> names;
    if (std::isfinite(factor)) names = names_of_number(factor, relative_, params_, what_.in);
    if (std::isfinite(factor) && names.empty()) names.push_back(named_number(factor, relative_, params_, what_.in));
    if (!of_row.empty()) names.push_back(of_row);
    for (const std::string& one : names) found.push_back({common_.fill(key, name, one, of), true});
  }

  std::vector<Instead> explanations(const Block& block, const std::vector<size_t>& rows) const {
    const std::string name = block_text(block);
    const auto right = [&](size_t row, size_t k) { return expected(block, row, k); };
    const auto came = [&](size_t row, size_t k) { return got(block, row, k); };
    std::vector<Instead> found;
    if (is(block, rows, [](size_t, size_t) { return 0.0; })) return {{common_.fill("seen.zero", name)}};
    const double factor = multiple(block, rows, came, right);
    if (std::isfinite(factor) && std::abs(factor + 1) < relative_) return {{common_.fill("seen.sign", name)}};
    add_factors(found, factor, row_multiple(block, rows, came, right), "seen.factor", name, "");
    if (!found.empty()) return found;
    const auto add = [&](const std::string& text) { found.push_back({text}); };
    for (const Param& param : params_)
      if (is_of(param, block) && is(block, rows, [&](size_t row, size_t k) { return value(param, row, k); }))
        add(common_.fill("seen.given", name, param.name));
    // the answer may be a parameter's value for another row
    for (const Param& param : params_)
      for (size_t other = 0; other < param.rows && param.rows == rows_ && rows_ > 1; ++other)
        if (is_of(param, block) && block.width > 1 && (rows.size() > 1 || rows[0] != other) &&
            is(block, rows, [&](size_t, size_t k) { return what_.in[param.at[other * param.columns + k]]; }))
          add(common_.fill("seen.given", name, common_.fill("seen.of", param.name, rows_text({other}))));
    for (const int step : {-1, 1}) {
      const auto beside = [&](size_t row, size_t k) {
        const auto other = static_cast<std::ptrdiff_t>(row) + step;
        return other < 0 || other >= static_cast<std::ptrdiff_t>(rows_)
                   ? NAN
                   : expected(block, static_cast<size_t>(other), k);
      };
      std::vector<size_t> inner;
      for (const size_t row : rows)
        if (!std::isnan(beside(row, 0))) inner.push_back(row);
      if (inner.size() > 1 && inner.size() + 1 >= rows.size() && is(block, inner, beside))
        add(common_.fill(step < 0 ? "seen.before" : "seen.after", name, name_text(own_, "row.", what_.row)));
    }
    for (const Block& other : blocks_)
      if (other.begin != block.begin && other.width == block.width &&
          is(block, rows, [&](size_t row, size_t k) { return expected(other, row, k); }))
        add(common_.fill("seen.other", name, block_text(other)));
    if (block.width == 3)
      for (const auto& order : {std::vector<size_t>{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}})
        if (is(block, rows, [&](size_t row, size_t k) { return expected(block, row, order[k]); })) {
          std::string parts;
          for (const size_t k : order) parts += (parts.empty() ? "" : ", ") + std::string(1, "xyz"[k]);
          add(common_.fill("seen.order", name, parts));
        }
    if (found.empty()) add_offsets(block, rows, found);
    return found;
  }

  /// Adds explanations for numbers that differ from the expected ones by a multiple of a named quantity.
  void add_offsets(const Block& block, const std::vector<size_t>& rows, std::vector<Instead>& found) const {
    const std::string name = block_text(block);
    const auto off = [&](size_t row, size_t k) { return got(block, row, k) - expected(block, row, k); };
    std::vector<Numbers> tried;  // numbers that have been tried under another name
    const auto add = [&](auto unit, const std::string& of) {
      Numbers values;
      for (const size_t row : rows)
        for (size_t k = 0; k < block.width; ++k) values.push_back(unit(row, k));
      if (std::find(tried.begin(), tried.end(), values) != tried.end()) return;
      // a constant offset is a multiple of any constant and so proves nothing
      if (values.size() > 1 && block.width == 1 &&
          std::all_of(values.begin(), values.end(), [&](double value) { return value == values[0]; }))
        return;
      tried.push_back(values);
      const double factor = multiple(block, rows, off, unit);
      add_factors(found, factor, std::isfinite(factor) ? "" : row_multiple(block, rows, off, unit), "seen.off", name,
                  of);
    };
    for (const Param& param : params_)
      if (is_of(param, block) && (block.width > 1 || !param.scalar()))
        add([&](size_t row, size_t k) { return value(param, row, k); }, param.name);
    for (const Block& other : blocks_)
      if (other.begin != block.begin && other.width == block.width)
        add([&](size_t row, size_t k) { return expected(other, row, k); }, block_text(other));
  }

  /// True if the parameter has a vector of this width for each row, or a single vector for all rows.
  bool is_of(const Param& param, const Block& block) const {
    return !param.whole && param.columns == block.width && (param.rows == rows_ || param.rows == 1);
  }
  double value(const Param& param, size_t row, size_t k) const {
    return what_.in[param.at[(param.rows == 1 ? 0 : row) * param.columns + k]];
  }

  const Texts &common_, &own_;
  const Case& what_;
  const Numbers& got_;
  size_t columns_, rows_;
  std::vector<Block> blocks_;
  std::vector<Param> params_;
  double tolerance_ = 0, largest_got_ = 0;
  mutable double relative_ = 0;          // relative accuracy of the last result of multiple()
  mutable std::vector<bool> all_wrong_;  // by vector
  bool exact_ = false;
};

bool comparable(const Texts& own, const Case& what, const Numbers& got) {
  return got.size() == what.expected.size() && what.columns > 0 && !got.empty() && !own.has("set." + what.row) &&
         got.size() % static_cast<std::size_t>(what.columns) == 0 &&
         std::all_of(got.begin(), got.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

std::vector<Block> blocks_of(const Texts& own, const Case& what) {
  std::vector<Block> blocks;
  std::string last_part;
  for (int column = 0; column < std::max(1, what.columns); ++column) {
    std::string name = column_text(own, what, column), part;
    // "v'.x", "force x", "x of particle 1"
    if (name.size() == 1 && name >= "x" && name <= "z") {
      part = name, name.clear();
    } else if (name.size() > 2 && (name[name.size() - 2] == '.' || name[name.size() - 2] == ' ') &&
               name.back() >= 'x' && name.back() <= 'z') {
      part = name.substr(name.size() - 1), name = name.substr(0, name.size() - 2);
    } else if (name.size() > 1 && name[0] >= 'x' && name[0] <= 'z' && name[1] == ' ') {
      part = name.substr(0, 1), name = name.substr(2);
    }
    const bool follows = !blocks.empty() && !part.empty() && blocks.back().name == name && !last_part.empty() &&
                         part[0] == last_part[0] + 1;
    if (follows)
      ++blocks.back().width;
    else
      blocks.push_back({name, static_cast<std::size_t>(column), 1});
    last_part = part;
  }
  // a block of a single component keeps the component's name
  for (Block& block : blocks)
    if (block.width == 1) block.name = column_text(own, what, static_cast<int>(block.begin));
  return blocks;
}

Answered others_of(const Case& what, const std::vector<Case>& cases, const std::vector<Answer>& answers) {
  Answered others;
  for (std::size_t i = 0; i < cases.size() && i < answers.size(); ++i)
    if (cases[i].call == what.call && cases[i].in != what.in) others.emplace_back(cases[i], answers[i]);
  return others;
}

namespace {

/// Explanations of a case. If there are other wrong cases, at least one must confirm an explanation; one that states a
/// factor always needs such a case. If `by_all` is true, no other wrong case may contradict it.
std::string borne_out(const Texts& common, const Texts& own, const Seen& seen, const Answered& others, bool by_all) {
  if (!seen.exact()) return "";
  const std::vector<std::vector<Instead>> all = seen.instead();
  std::vector<std::vector<Instead>> kept(all.size());
  std::vector<bool> compared(all.size(), false);
  std::set<std::string> denied;
  for (const auto& [what, answer] : others) {
    if (answer.how != How::answered || !comparable(own, what, answer.got) || judge(what, answer).right) continue;
    const Seen other(common, own, what, answer.got);
    if (!other.exact()) continue;
    const std::vector<std::vector<Instead>> there = other.instead();
    for (std::size_t i = 0; i < all.size() && i < there.size(); ++i) {
      if (!other.is_wrong(i)) continue;
      compared[i] = true;
      for (const Instead& one : all[i]) {
        const auto same = [&](const Instead& it) { return it.text == one.text; };
        if (std::none_of(there[i].begin(), there[i].end(), same))
          denied.insert(one.text);
        else if (std::none_of(kept[i].begin(), kept[i].end(), same))
          kept[i].push_back(one);
      }
    }
  }
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!compared[i])
      for (const Instead& one : all[i])
        if (!one.factor) kept[i].push_back(one);
    if (kept[i].size() > 2) continue;
    for (const Instead& one : kept[i])
      if (!by_all || denied.count(one.text) == 0) text += (text.empty() ? "" : " ") + one.text;
  }
  return text;
}

}  // namespace

std::string seen_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer,
                      const Answered& others) {
  if (answer.how != How::answered || !answer.of.empty() || !comparable(own, what, answer.got)) return "";
  if (judge(what, answer).right) return "";
  const Seen seen(common, own, what, answer.got);
  const std::string split = seen.split(), instead = borne_out(common, own, seen, others, false);
  return split + (split.empty() || instead.empty() ? "" : " ") + instead;
}

std::string instead_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer,
                         const Answered& others) {
  if (!comparable(own, what, answer.got)) return "";
  return borne_out(common, own, Seen(common, own, what, answer.got), others, true);
}

}  // namespace coursework
