// The table of chapters: the questions that the report answers beyond single scenes.
#include "report/page/page.h"

namespace crosscheck {

std::vector<Chapter> chapters() {
  return {
      {"adequacy",
       "How little model is enough?",
       "Each scene is run again without each of its ingredients, then with one after the other left out, and held "
       "against the truth of the full scene while single positions can be compared. Cost is counted in force "
       "evaluations times springs.",
       {}},
      {"disagreements",
       "What cannot be matched, and why",
       "Where Bullet's worlds answer otherwise than the scene asks, or fail: each in the smallest scene that shows it, "
       "with its cause and the size of its effect, measured in this run.",
       {}},
      {"stiffness", "How stiff a position-based link is", "Bullet's position-based world beside the formula.", {}},
  };
}

}  // namespace crosscheck
