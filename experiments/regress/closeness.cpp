#include "experiments/regress/closeness.h"

#include <limits>

namespace crosscheck {
namespace {

double distance(const Compared& row) { return row.was ? row.off() : std::numeric_limits<double>::infinity(); }

}  // namespace

Closeness closeness_of(std::span<const Compared> rows) {
  Closeness close;
  for (const Compared& row : rows) {
    const bool numbers = row.was && row.is, words = !row.was_word.empty() && !row.is_word.empty();
    if (!numbers && !words) continue;
    if (numbers ? *row.was == *row.is : row.was_word == row.is_word) {
      ++close.identical;
      continue;
    }
    ++close.differing;
    if (!close.furthest || distance(row) > distance(*close.furthest)) close.furthest = row;
  }
  return close;
}

}  // namespace crosscheck
