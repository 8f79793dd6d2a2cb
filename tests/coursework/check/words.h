// Feedback on one call of a student's code, for the hand-out's `check` and for the grader alike. C++17,
// standard library only.
#pragma once

#include <string>

#include "judge.h"
#include "texts.h"

namespace coursework {

/// The number with so many digits; "nan" and "0" have no sign.
std::string with_digits(double value, int digits);

/// As short as tells it apart from `other`: six digits, or as many as it takes.
std::string number_text(double value, double other);

/// The assignment's name of a kind of row or column ("row.step"), or the bare word where its texts have none.
std::string name_text(const Texts& own, const std::string& kind, const std::string& word);

/// What a column's numbers are: one of the names where the text is a list "(x, y, z)" with a name for each column, else
/// the text with the column's number, "state[2]"; the text alone where the column is -1. In "(x, y, z) of particle #"
/// the names are those of every particle's numbers, and # is the particle.
std::string column_text(const Texts& own, const Case& what, int column);

/// What the student's code was given, as in "With h = 0.3, x = (1, 2)."; empty where the texts do not say how the
/// numbers of the call are laid out (layout.h), or where they are more than `most`, which nobody would read.
/// "given.CALL" is a sentence of its own, `|` and the layout.
bool has_layout(const Texts& own, const Case& what);
std::string given_text(const Texts& common, const Texts& own, const Case& what, const Judged& judged,
                       std::size_t most = 60);

/// All numbers of a wrong answer beside those expected, a line for each: where they are six at most, or else those of
/// them that differ where these are. Lines begin with two blanks, and columns are aligned where all letters are of one
/// width. Empty where there is but one number, shares, or a free order of rows.
std::string table_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer);
/// Whether such a line is one of a table.
bool is_of_table(const std::string& line);

/// The hint of a test that failed, or, as hints of tests that fail for the same reason need not agree, which test of
/// the same function is to be got right first; empty where it is the first and has no hint.
std::string hint_text(const Texts& common, const Texts& own, const std::string& test, const std::string& failed_before);

/// The student's function that a call is about, where its part has several that do not call each other
/// ("function.CALL"); else the part.
std::string function_of(const Texts& own, const std::string& part, const Case& what);

/// Which of a call's numbers are angles; none where the texts do not say.
std::vector<std::size_t> angles_in(const Texts& own, const Case& what);

/// Of a test that fails, the first of its small cases that fails too, with what was given; empty where all are right.
std::string smaller_text(const Texts& common, const Texts& own, const std::vector<Case>& small,
                         const std::vector<Answer>& answers);

/// Of several cases of one number each, all compared to round-off, what came over what is right; else empty.
std::string factors_text(const Texts& common, const std::vector<Case>& cases, const std::vector<Answer>& answers);

/// One sentence or two: what was expected, what came, and where they first differ; of rows that are a set (text
/// "set.ROW") which are missing. `common` is check/common.LANGUAGE.txt, `own` the assignment's texts. Empty where the
/// answer is right.
std::string words(const Texts& common, const Texts& own, const Case& what, const Answer& answer, const Judged& judged);

}  // namespace coursework
