// The table of chapters: the questions that the report answers beyond single scenes.
#include "report/page/page.h"

namespace crosscheck {

std::vector<Chapter> chapters() {
  return {
      {"speed-accuracy",
       "Speed against accuracy",
       "Every method at many steps, or tolerances: how far it ends up from the truth, and what that took. Lower and "
       "further left is better; the grey stairs join the runs that no cheaper run beats. Runs that failed are crosses "
       "at the top, at the cost they had already spent. Costs are counted twice: as force evaluations, which are the "
       "same on every machine, and as CPU time, which is what is paid. Bullet does not tell what its solvers do inside "
       "a step: there a step counts as one evaluation, and worlds that solve for a whole step do not compete by them. "
       "No step is "
       "longer than the time between two samples.",
       {},
       "Speed"},
      {"stability",
       "Where does each method break?",
       "The largest step that each method can take on a scene, found by running it, beside what theory predicts; and "
       "maps of how runs fail when springs get stiffer or drag stronger.",
       {},
       "Stability"},
      {"energy",
       "Where does the energy go?",
       "The energy of runs of up to a hundred thousand steps, fewer on large scenes, added up by the suite's own "
       "formulas from the positions and speeds of every engine at every step: what it has, what drag, dashpots and "
       "contact took, what wind and moved "
       "pins gave, and the residual that does not add up. A rule that solves the whole step is run at ten times the "
       "step, over the same time.",
       {},
       "Energy"},
      {"sphere",
       "How do they answer a ball?",
       "Contact is where engines differ most. Small scenes with one known answer each, exact where it says by theory, "
       "and two cloths that fall on a ball. Beside the engines stands the sticky sphere of the assignment, to be seen "
       "failing.",
       {},
       "Ball"},
      {"adequacy",
       "How little model is enough?",
       "Each scene is run again without each of its ingredients, then with one after the other left out, the one that "
       "costs least first, and held "
       "against the truth of the full scene while single positions can be compared. Cost is counted in force "
       "evaluations times springs.",
       {},
       "Least model"},
      {"cost",
       "What does a step cost?",
       "The same cloth at more and more particles, in every engine: mysim's pass over a regular grid beside general "
       "solvers; where the time goes, and how near that is to what the machine can do.",
       {},
       "Cost of a step"},
      {"disagreements",
       "What cannot be matched, and why",
       "Where Bullet's worlds answer otherwise than the scene asks, or fail: each in the smallest scene that shows it, "
       "with its cause and the size of its effect, measured in this run.",
       {},
       "Disagreements"},
      {"stiffness",
       "How stiff a position-based link is",
       "Bullet's position-based world beside the formula.",
       {},
       "Link stiffness"},
  };
}

}  // namespace crosscheck
