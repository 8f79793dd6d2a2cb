// Which method for which scene: a row of the table that the report opens with, and the finding that vouches for it.
#pragma once

#include "report/findings.h"

namespace crosscheck {

struct ChoiceCell {
  std::string text = "–";     // as it is: nothing was asked, or can be said
  const char* look = "none";  // class of the page: "best", "failed", "none" or ""
  bool empty() const { return text == "–"; }
};

/// A column of the table; a new one is a row in choice.cpp.
struct ChoiceColumn {
  const char *head, *term;  // the term of the glossary (page/glossary.cpp) that explains it
  ChoiceCell (*cell)(const Scene& scene, const SceneFacts& facts, const Rows& result);
  bool timed = false;  // rests on timings, which another finding tells
};
const std::vector<ChoiceColumn>& choice_columns();

/// The scene's cells, one for each column.
std::vector<ChoiceCell> choice_of(const Scene& scene, const SceneFacts& facts, const Rows& result);

/// The same in a sentence, so that it is verified like any other; the page shows it as the table's row. Timed columns
/// are left out.
Finding choice_finding(const Scene& scene, const SceneFacts& facts, const Rows& result);
/// Its topic.
inline constexpr auto choice_topic = "choice";

}  // namespace crosscheck
