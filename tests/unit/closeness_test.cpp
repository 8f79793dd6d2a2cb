// How close answers are: what is the same bits, what differs, and which of that most.
#include "experiments/regress/closeness.h"

#include <gtest/gtest.h>

namespace crosscheck {
namespace {

Compared number(const std::string& name, double was, double is, double tolerance) {
  Compared row;
  row.quantity = name, row.was = was, row.is = is, row.tolerance = tolerance;
  return row;
}

Compared word(const std::string& name, const std::string& was, const std::string& is) {
  Compared row;
  row.quantity = name, row.was_word = was, row.is_word = is;
  return row;
}

TEST(Closeness, CountsBitsAndNamesTheFurthest) {
  std::vector<Compared> rows{number("same", 1, 1, 0), number("near", 1, 1 + 1e-15, 1e-13),
                             number("further", 1, 1 + 1e-14, 1e-14), word("verdict", "ok", "ok"), Compared{}};
  Closeness close = closeness_of(rows);
  EXPECT_EQ(close.identical, 2u);
  EXPECT_EQ(close.differing, 2u) << "a row without one of the values is neither";
  ASSERT_TRUE(close.furthest);
  EXPECT_EQ(close.furthest->quantity, "further");
  rows.push_back(word("verdict", "ok", "nan"));
  close = closeness_of(rows);
  EXPECT_EQ(close.differing, 3u);
  EXPECT_EQ(close.furthest->is_word, "nan");
  EXPECT_FALSE(closeness_of({}).furthest);
}

}  // namespace
}  // namespace crosscheck
