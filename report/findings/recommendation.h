// Methods recommended for scenes: a row of the table that the report opens with, and the finding that vouches for it.
#pragma once

#include "report/findings/findings.h"

namespace crosscheck {

struct RecommendationCell {
  std::string text = "–";          // as it is: nothing was run, or can be said
  const char* css_class = "none";  // class of the page: "best", "failed", "none" or ""
  bool empty() const { return text == "–"; }
};

/// A column of the table; a new one is a row in recommendation.cpp.
struct RecommendationColumn {
  const char *head, *term;  // the term of the glossary (page/contents.cpp) that explains it
  RecommendationCell (*cell)(const Scene& scene, const SceneData& facts, const Rows& result);
  bool timed = false;  // rests on timings, which another finding reports
};
const std::vector<RecommendationColumn>& recommendation_columns();

/// The scene's cells, one for each column.
std::vector<RecommendationCell> recommendations_of(const Scene& scene, const SceneData& facts, const Rows& result);

/// The same in a sentence, so that it is verified like any other; the page shows it as the table's row. Timed columns
/// are left out.
Finding recommendation_finding(const Scene& scene, const SceneData& facts, const Rows& result);
/// Its topic.
inline constexpr auto recommendation_topic = "choice";

}  // namespace crosscheck
