// The table of chapters: the questions that the report answers beyond single scenes.
#include "report/page/page.h"

namespace crosscheck {

std::vector<Chapter> chapters() {
  return {
      {"stability",
       "Where does each method break?",
       "The largest step that each method can take on a scene, found by running it, beside what theory predicts; and "
       "maps of how runs fail when springs get stiffer or drag stronger.",
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
