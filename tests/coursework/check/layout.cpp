#include "layout.h"

#include <cstdlib>
#include <map>
#include <sstream>

namespace coursework {
namespace {

class Reading {
 public:
  Reading(const std::string& layout, const Numbers& in, int row, std::size_t rows) : in_(in), row_(row), rows_(rows) {
    std::istringstream words(layout);
    for (std::string word; words >> word;) words_.push_back(word);
  }

  CallLayout layout() {
    std::size_t at = 0;
    part(at, -1);
    found_.fits = fits_ && read_ == in_.size() && !words_.empty();
    for (Field& field : found_.fields)
      if (field.counted >= 0 && uses_[field.counted] > 1) field.counted = -1;
    for (FieldGroup& group : found_.groups)
      if (group.counted >= 0 && uses_[group.counted] > 1) group.counted = -1;
    return found_;
  }

 private:
  /// Reads words up to the end or the closing bracket.
  void part(std::size_t& at, int item) {
    for (; at < words_.size() && words_[at] != ")"; ++at) {
      const std::string& word = words_[at];
      const std::size_t bracket = word.find('['), open = word.find('(');
      if (open != std::string::npos && open > 0) {
        group(at, word.substr(0, open - 1), word[open - 1] == '@');
      } else if (bracket == std::string::npos) {
        add(word, item, 1, 1);
      } else {
        std::string of = word.substr(bracket + 1, word.size() - bracket - 2);
        std::size_t rows = 1;
        if (const std::size_t comma = of.find(','); comma != std::string::npos)
          rows = use_of(of.substr(0, comma)), of = of.substr(comma + 1);
        const bool list = rows == 1 && !of.empty() && (of[0] < '0' || of[0] > '9');
        add(word.substr(0, bracket), item, rows, use_of(of), list);
      }
    }
  }

  void group(std::size_t& at, const std::string& counted, bool one_told) {
    const std::size_t begin = at + 1;
    std::size_t end = begin;
    while (end < words_.size() && words_[end] != ")") ++end;
    last_count_ = -1;
    const std::size_t count = counted == "~" ? repeats(begin, end) : use_of(counted);
    const int chosen =
        one_told && count > 0 && row_ >= 0 && rows_ >= count ? row_ / static_cast<int>(rows_ / count) : -1;
    const int number = static_cast<int>(found_.groups.size());
    found_.groups.push_back({last_count_, read_, read_, count});
    group_ = number;
    for (std::size_t i = 0; i < count && fits_; ++i) {
      mute_ = chosen >= 0 && static_cast<int>(i) != chosen;
      part(at = begin, static_cast<int>(i));
    }
    group_ = -1, mute_ = false;
    found_.groups[static_cast<std::size_t>(number)].end = read_;
    at = end;
  }

  /// Number of repetitions of a group that fit into the remaining numbers.
  std::size_t repeats(std::size_t begin, std::size_t end) {
    std::size_t size = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t bracket = words_[i].find('[');
      size +=
          bracket == std::string::npos ? 1 : count_of(words_[i].substr(bracket + 1, words_[i].size() - bracket - 2));
    }
    return size > 0 && read_ < in_.size() ? (in_.size() - read_) / size : 0;
  }

  /// Returns the value of a count, and registers that the count is used.
  std::size_t use_of(const std::string& word) {
    const std::string name =
        word.size() > 2 && word.compare(word.size() - 2, 2, "-1") == 0 ? word.substr(0, word.size() - 2) : word;
    const auto known = places_.find(name);
    last_count_ = known == places_.end() ? -1 : static_cast<int>(known->second);
    if (last_count_ >= 0) ++uses_[last_count_];
    return count_of(word);
  }

  std::size_t count_of(const std::string& word) {
    const bool less = word.size() > 2 && word.compare(word.size() - 2, 2, "-1") == 0;
    const std::string name = less ? word.substr(0, word.size() - 2) : word;
    const auto known = places_.find(name);
    if (known != places_.end())
      for (Field& field : found_.fields) field.whole = field.whole || field.begin == known->second;
    const double count = known != places_.end() ? in_[known->second] : std::atof(word.c_str());
    return count >= less && count < 1e6 ? static_cast<std::size_t>(count) - less : 0;
  }

  void add(std::string name, int item, std::size_t rows, std::size_t columns, bool list = false) {
    Field field;
    field.angle = name.back() == '!', field.whole = name.back() == '#';
    if (field.angle || field.whole) name.pop_back();
    field.name = name, field.item = item, field.group = group_;
    field.begin = read_, field.rows = rows, field.columns = columns, field.other = mute_, field.list = list;
    if (rows == 1 && item < 0) field.counted = last_count_;
    last_count_ = -1;
    fits_ = fits_ && read_ + field.size() <= in_.size();
    if (!fits_) return;
    if (field.size() == 1) places_[name] = read_;
    read_ += field.size();
    found_.fields.push_back(field);
  }

  const Numbers& in_;
  std::vector<std::string> words_;
  std::map<std::string, std::size_t> places_;  // position of each single number, by name
  std::map<int, int> uses_;                    // position of each count -> number of times it is used
  int last_count_ = -1;
  CallLayout found_;
  int row_, group_ = -1;
  std::size_t rows_, read_ = 0;
  bool fits_ = true, mute_ = false;
};

}  // namespace

CallLayout CallLayout::read(const std::string& layout, const Numbers& in, int row, std::size_t rows) {
  return Reading(layout, in, row, rows).layout();
}

CallLayout CallLayout::of(const Texts& own, const Case& what, int row) {
  const std::string key = layout_key(own, what);
  if (!own.has(key)) return {};
  const std::string& text = own.of(key);
  const std::size_t bar = text.find('|');
  if (bar == std::string::npos) return {};
  const std::size_t rows = what.expected.size() / static_cast<std::size_t>(what.columns > 0 ? what.columns : 1);
  return read(text.substr(bar + 1), what.in, row, rows);
}

std::string layout_key(const Texts& own, const Case& what) {
  const std::string whole = "given." + what.call;
  return own.has(whole) ? whole : "given." + what.call.substr(what.call.find('.') + 1);
}

}  // namespace coursework
