// Feedback on one call of a student's code, for both the hand-out's `check` and the grader.
#pragma once

#include <string>

#include "judge.h"
#include "texts.h"

namespace coursework {

/// The number with this many digits. "nan" and "0" have no sign.
std::string with_digits(double value, int digits);

/// Shortest text that distinguishes the value from `other`, with at least six digits.
std::string number_text(double value, double other);

/// The assignment's text for a row or column, such as "row.step", or `word` if there is no such text.
std::string name_text(const Texts& own, const std::string& kind, const std::string& word);

/// Name of a column's numbers. If the text is a list "(x, y, z)" with a name for each column, one of these names;
/// otherwise the text with the index of the column, such as "state[2]", or without it if the column is -1. In "(x, y,
/// z) of particle #" the names repeat for each particle, and # is the index of the particle.
std::string column_text(const Texts& own, const Case& what, int column);

/// Inputs of the student's code, such as "With h = 0.3, x = (1, 2)."; empty if the texts do not declare the layout of
/// the call's numbers (layout.h), or if there are more than `most` numbers, which are too many to read. The text
/// "given.CALL" consists of a sentence, `|` and the layout.
bool has_layout(const Texts& own, const Case& what);
std::string given_text(const Texts& common, const Texts& own, const Case& what, const Judged& judged,
                       std::size_t most = 60);

/// All numbers of a wrong answer next to the expected ones, one per line, if the answer has at most six numbers;
/// otherwise the numbers that differ, if at most six do. Lines begin with two blanks, and columns are aligned in a
/// monospaced font. Empty for a single number, for fractions, and for rows in any order.
std::string table_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer);
/// True if the line belongs to a table of table_text().
bool is_of_table(const std::string& line);

/// The hint of a failed test. If an earlier test of the same function failed, names that test instead, because hints of
/// tests that fail for the same reason may disagree. Empty if the test is the first to fail and has no hint.
std::string hint_text(const Texts& common, const Texts& own, const std::string& test, const std::string& failed_before);

/// The student's function that a call tests: the text "function.CALL" if the part has several functions that do not
/// call each other, otherwise the name of the part.
std::string function_of(const Texts& own, const std::string& part, const Case& what);

/// Indices of a call's numbers that are angles; empty if the texts do not declare the layout.
std::vector<std::size_t> angles_in(const Texts& own, const Case& what);

/// The first failing small case of a failed test, with its inputs; empty if all small cases pass.
std::string smaller_text(const Texts& common, const Texts& own, const std::vector<Case>& small,
                         const std::vector<Answer>& answers);

/// Ratios of actual to expected numbers of several cases with a single number each; empty if a case has a tolerance
/// much larger than round-off.
std::string factors_text(const Texts& common, const std::vector<Case>& cases, const std::vector<Answer>& answers);

/// One or two sentences: the expected and actual numbers, and the first difference; for rows that form a set (text
/// "set.ROW"), the missing rows. `common` is check/common.LANGUAGE.txt, `own` the assignment's texts. Empty if the
/// answer is right.
std::string words(const Texts& common, const Texts& own, const Case& what, const Answer& answer, const Judged& judged);

}  // namespace coursework
