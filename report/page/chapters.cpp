// The table of chapters: the questions that the report answers beyond single scenes.
#include "report/page/page.h"

namespace crosscheck {

std::vector<Chapter> chapters() {
  return {
      {"sphere",
       "How do they answer a ball?",
       "Contact is where engines differ most. Small scenes with one known answer each, exact where it says by theory, "
       "and two cloths that fall on a ball. Beside the engines stands the sticky sphere of the assignment, to be seen "
       "failing.",
       {}},
      {"energy",
       "Where does the energy go?",
       "The energy of runs of a hundred thousand steps, added up by the suite's own formulas from the positions and "
       "speeds of every engine at every step: what it has, what drag, dashpots and contact took, what wind and moved "
       "pins gave, and the residual that does not add up. A rule that solves the whole step is run at ten times the "
       "step, over the same time.",
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
