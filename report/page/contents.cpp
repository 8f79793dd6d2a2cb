// The table of chapters, the line of contents, and the glossary.

#include <fmt/format.h>

#include <stdexcept>

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

std::string contents_html(const PageContent& c) {
  std::string out = "<nav aria-label=\"Contents\">\n<a href=\"#scenes\">Which method</a>\n";
  if (!c.against.empty()) out += "<a href=\"#changes\">What changed</a>\n";
  for (const Chapter& chapter : c.chapters)
    if (!chapter.entries.empty())
      out += fmt::format("<a href=\"#{}\" title=\"{}\">{}</a>\n", chapter.id, escaped(chapter.title),
                         escaped(chapter.label.empty() ? chapter.title : chapter.label));
  if (!c.scenes.empty()) {
    // opens below the pointer and below the keys alike
    out += fmt::format("<span class=\"menu\"><a href=\"#{}\">Scenes</a><span class=\"list\">\n",
                       escaped(c.scenes[0].scene->name));
    for (const ScenePart& part : c.scenes) out += fmt::format("<a href=\"#{0}\">{0}</a>\n", escaped(part.scene->name));
    out += "</span></span>\n";
  }
  return out + "<a href=\"#words\">Words</a>\n<a href=\"#made\">How it was made</a>\n</nav>\n";
}

namespace {

struct Word {
  const char *id, *term, *sentence;
};

constexpr Word words[] = {
    {"scene", "scene",
     "Particles, springs, pins and a start, with a question; written once and built alike in every engine."},
    {"method", "method",
     "An engine with a rule: mysim/leapfrog is mysim's leapfrog, bullet/pbd Bullet's position-based world."},
    {"step", "step",
     "The time from one computed state to the next; each scene has one of its own, the same for all methods "
     "that do not choose theirs, unless a chapter varies it."},
    {"evaluation", "force evaluation",
     "One computation of all forces; explicit Euler, symplectic Euler and leapfrog take one "
     "in a step, rk4 four, suzuki4 five, implicit rules many. Bullet's steps count as one."},
    {"truth", "truth",
     "What an error is measured from. Exact: a closed form. Converged: two independent routes refined "
     "until they agree, with an error bar. Another engine: no truth at all, only a difference."},
    {"error", "error",
     "How far a run is from the truth: RMS over the particles, the largest over time; in % it is a part of "
     "the motion. No error is said to be less than the truth's error bar."},
    {"rms", "RMS", "The root of the mean of the squares: of the distances of all particles."},
    {"motion", "motion",
     "The largest RMS distance of the particles from where they started: the scale that errors are "
     "parts of."},
    {"window", "window",
     "The time up to which single positions are compared: later a push of 1e-10 m has grown so much that "
     "two correct engines part."},
    {"round-off", "round-off",
     "What the 16 digits of a number leave over; where two engines differ by no more they do the "
     "same."},
    {"cheapest", "cheapest for 1 %",
     "Of all steps and tolerances tried, the run of least CPU time whose error is at most 1 % "
     "of the motion, and who is no slower within the noise. Bullet × 30: the cheapest such run of Bullet's worlds "
     "takes "
     "30 times as long as that of mysim's; none: no run of theirs that was tried is as near."},
    {"failed", "failed",
     "Blew up: a particle is more than ten times as fast as any ever is in the true motion. Overstretched: a spring "
     "is more than ten times as long. Froze, solver gave up: what they say. A run that came to its end can still be "
     "far off."},
    {"least", "least model",
     "What is left of a scene when all is left out that is not needed for an error of 1 %, or 10 %, of "
     "the motion; tried again from three other starts."},
    {"stable", "largest stable step", "Beyond it vibrations grow until the run blows up."},
    {"symplectic", "symplectic", "Rules that keep the energy of an undamped motion for ever, up to a wobble."},
    {"residual", "energy residual",
     "Energy now, plus all that was taken, less all that was given, less energy at the start: "
     "what does not add up."},
    {"turned-over", "energy turned over",
     "The largest energy of motion, or change of that of springs or of height, in a run: the scale of residuals."},
    {"implicit", "implicit",
     "Rules that solve an equation for the next state: stable at long steps, at a price in work, and "
     "often in energy."},
    {"trapezoidal", "trapezoidal",
     "Here the explicit rule of the assignment, also called Heun's or the improved Euler rule: not the implicit one "
     "that holds at every step."},
    {"assignment", "assignment",
     "The coursework that these scenes and rules began with: its explicit rules and its sphere, to which particles "
     "stick, are kept to be compared."},
    {"creep", "creep", "How fast particles slide that touch a ball, when all should rest."},
    {"resized", "cloth-hang-6",
     "A scene with a number behind its name is the same cloth with so many particles along its longer side."},
    {"sweep", "sweep and general engine",
     "mysim steps regular cloths in one vectorised pass over the grid, the sweep, and everything else spring by "
     "spring; +plain asks for the latter."},
    {"position-based", "position-based",
     "Moves particles until distances fit, link by link, and takes speeds from the moves: "
     "fast and robust, but stiffness depends on step and iterations."},
    {"different-law", "different law",
     "The method has the ingredient, but under another formula; compared all the same, and "
     "marked."},
    {"certificate", "parity certificate",
     "Masses, springs and the rest as read back from the other engine's memory: whether it "
     "built the same scene."},
};

}  // namespace

std::string term_link(const std::string& id) {
  for (const Word& word : words)
    if (word.id == id)
      return fmt::format("<a href=\"#word-{}\" title=\"{}\">{}</a>", id, escaped(word.sentence), prose(word.term));
  throw std::logic_error("no word of the glossary named " + id);
}

std::string glossary_html() {
  std::string out = "<section id=\"words\"><h2>Words</h2>\n<dl>\n";
  for (const Word& word : words)
    out += fmt::format("<div id=\"word-{}\"><dt>{}</dt><dd>{}</dd></div>\n", word.id, prose(word.term),
                       prose(word.sentence));
  return out + "</dl>\n" + methods_html() + "</section>\n";
}

}  // namespace crosscheck
