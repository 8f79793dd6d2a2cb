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
       "a step: there a step counts as one evaluation, and the implicit world does not compete by them.",
       {}},
      {"cost",
       "What does a step cost?",
       "The same cloth at more and more particles, in every engine; where the time goes, and how much of it the "
       "machine "
       "itself asks for.",
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
