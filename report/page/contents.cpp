// The table of chapters, the line of contents, and the glossary.

#include <fmt/format.h>

#include <algorithm>
#include "report/page/page.h"

namespace crosscheck {

std::vector<Chapter> chapters() {
  return {
      {"same-answer",
       "Same scene, same answer?",
       "Same answer?",
       {"disagreements", "stiffness"},
       {},
       "",
       "<p>A comparison of two engines says something only if both solve <b>the same problem</b>. So each mass, "
       "spring, "
       "rest length, pin and ball is read back from the other engine's memory and held against the scene: a dot for "
       "each.</p><p>Where both have <b>the same rule</b>, as mysim and Bullet's explicit world have symplectic Euler, "
       "the same step must give the same motion, but for round-off: what they differ by there is the floor below which "
       "nothing else may be claimed.</p><p>The cause and "
       "size of each law that another engine writes otherwise are below, "
       "in "
       "the smallest scene that shows it.</p>",
       {},
       {},
       {},
       {{"*-disagreement", "Where Bullet solves another problem", true}}},
      {"speed-accuracy",
       "Speed against accuracy",
       "Speed",
       {"cost"},
       {"*-speed-accuracy-cost", "cheapest-1-percent-cost", "scoreboard"},
       "<i><em>h</em> &lt; 2 / <em>ω</em></i><span>the critical step of leapfrog; ω is the fastest vibration of "
       "the "
       "scene{critical}</span>",
       "<p>Lower and further left is better; the grey stairs, the Pareto line, join the runs that no cheaper one "
       "beats.</p><p>An "
       "explicit "
       "rule must follow even the fastest wave, which nobody sees: <b>stability sets its step, not accuracy</b>. Below "
       "that step halving it doubles the cost. The error of rules of order one then halves, of order two falls to a "
       "quarter.</p><p>Implicit and position-based rules take longer steps and pay for them in each step, and in "
       "damping.</p><p>Crosses at the top are runs that failed, at "
       "what they had cost by then.</p>",
       {{"euler-circle", "Euler's circle"}},
       {},
       {},
       {{"*-speed-accuracy", "Error against force evaluations"}}},
      {"stability",
       "Where methods fail",
       "Failure",
       {},
       {"stability-limits", "*-error", "*-stiffness-map", "*-drag-map"},
       "<i><em>x</em>″ = −<em>ω</em>²<em>x</em> → <em>h ω</em> &lt; 2</i><span>leapfrog on one wave{critical}</span>",
       "<p>A cloth is a sum of waves, and each is a spring of its own. Where a step covers more than 1/π of a swing, "
       "about a third, "
       "<b>the kick overshoots by more than it corrects</b>, and the wave grows by a constant factor.</p><p>So one "
       "number decides: the fastest frequency. Stiffer springs, lighter particles and finer grids raise "
       "it.</p><p>Limits here are searched by runs and set beside what eigenvalues predict; runs that fail are data, "
       "with the step and the time at which they did.</p>",
       {{"cloth-bursts", "Where the cloth bursts"}}},
      {"energy",
       "Energy and the ball",
       "Energy and ball",
       {"sphere"},
       {"sphere-cone", "energy-damping", "*-energy-drift", "*-energy"},
       "",
       "<p>Energy is added up for every engine by the same formulas, from its positions and speeds. Symplectic rules "
       "keep it within a band for as long as one likes; <b>implicit Euler damps</b>, like a drag that nobody asked "
       "for, and so do the rules built like it.</p>",
       {{"pendulum-energy", "The pendulum's energy"}, {"ball-friction", "Sticky ball, sliding ball"}},
       "<i>tan <em>θ</em> &gt; <em>μ</em></i><span>Coulomb: on a slope of angle θ it slides, else it sticks</span>",
       "<p>Contact is where engines differ most. Particles on slopes have a known answer: by Coulomb's law all points "
       "fall on one line. What sticks where it should slide, or creeps where it should rest, leaves it.</p>"},
      {"adequacy",
       "How little model is enough",
       "Least model",
       {"fabric"},
       {"*-adequacy"},
       "",
       "<p>Each scene runs again without each of its ingredients, then without several, the cheapest to lose first, "
       "and "
       "is held against the truth of the full scene.</p><p>What can go depends on the error that you accept: <b>at 1 % "
       "of the motion most scenes need all they have, at 10 % a family of springs can often go</b>. Fewer springs also "
       "lower the fastest "
       "frequency, so that the step may grow.</p>",
       {{"bend-springs", "What bend springs do"}}},
  };
}

std::string contents_html(const PageContent& c) {
  std::string out = "<nav aria-label=\"Contents\"><div>\n<a class=\"name\" href=\"#top\">Crosscheck</a>\n";
  if (!c.against.empty()) out += "<a href=\"#changes\">What changed</a>\n";
  for (const Chapter& chapter : c.chapters)
    if (!chapter.entries.empty() || chapter.id == "same-answer")
      out += fmt::format("<a href=\"#{}\" title=\"{}\">{}</a>\n", chapter.id, escaped(chapter.title),
                         escaped(chapter.label));
  if (std::ranges::any_of(c.scenes, [](const ScenePart& part) { return part.take.has_value(); }))
    out += "<a href=\"#which-method\">Which method</a>\n";
  if (!c.scenes.empty()) out += "<a href=\"#scenes\">Scenes</a>\n";
  out += "<a href=\"#words\">Words</a>\n";
  return out + "</div></nav>\n";
}

namespace {

struct Word {
  const char *id, *term, *sentence;
};

constexpr Word words[] = {
    {"scene", "scene",
     "Particles, springs, pins, a start and a question, built alike in every engine. A number behind its name: "
     "the same cloth with so many particles along its longer side."},
    {"method", "method",
     "An engine with a stepper: mysim/leapfrog is mysim's leapfrog, bullet/pbd Bullet's position-based world."},
    {"evaluation", "force evaluation", "One computation of all forces; a step of leapfrog takes one, of rk4 four."},
    {"truth", "truth",
     "What an error is measured from. Exact: a closed form. Converged: two independent routes refined until they "
     "agree, with an error bar. Another engine: no truth, only a difference."},
    {"error", "error",
     "How far a run is from the truth: root mean square (RMS) over the particles, the largest over time; in % of the "
     "motion. None is said to be less than the truth's error bar."},
    {"motion", "motion", "The largest RMS distance of the particles from where they started."},
    {"window", "window",
     "The time up to which positions are compared: later a perturbation of 1e-10 m has grown until two correct engines "
     "differ."},
    {"round-off", "round-off",
     "The error of arithmetic with 16 digits; two engines that differ by no more take the same steps."},
    {"failed", "failed",
     "Blew up: a particle is more than ten times as fast as any in the true motion. Overstretched: a spring is more "
     "than ten times as long. Frozen: nothing moves. Solver gave up: not converged."},
    {"least", "least model",
     "A scene without what is not needed for an error of 1 %, or 10 %, of the motion; checked from three other "
     "starts."},
    {"stable", "critical time step", "The largest stable time step: beyond it vibrations grow until the run blows up."},
    {"symplectic", "symplectic",
     "Steppers whose energy oscillates about its first value in an undamped motion, and does not drift."},
    {"residual", "energy residual",
     "Energy now, plus what was dissipated, less what was supplied, less energy at the start: zero in an exact "
     "solution. Relative: over what was turned over, the largest change of any energy."},
    {"implicit", "implicit",
     "Steppers that solve an equation for the next state: stable at long time steps, often with numerical damping."},
    {"trapezoidal", "trapezoidal", "Here the explicit rule, also called Heun's method."},
    {"sticky", "sticky sphere", "The ball of the classic assignment, to which particles freeze; kept to be compared."},
    {"creep", "creep", "The sliding speed of particles in contact that should be at rest."},
    {"bound", "bound by",
     "What keeps a step from being longer: stability, accuracy, or sampling, the time between samples."},
    {"sweep", "fused step",
     "One vectorised pass over the grid, in which mysim steps regular cloths; +plain asks for the general engine "
     "instead."},
    {"position-based", "position-based",
     "Moves particles until distances fit, and takes speeds from the moves; stiffness depends on step and iterations."},
    {"different-law", "different law", "The method models the ingredient by another formula; compared all the same."},
    {"certificate", "parity certificate", "Masses, springs and the rest as read back from the other engine's memory."},
};

}  // namespace

std::string glossary_html() {
  std::string out = "<dl>\n";
  for (const Word& word : words)
    out += fmt::format("<div id=\"word-{}\"><dt>{}</dt><dd>{}</dd></div>\n", word.id, prose(word.term),
                       prose(word.sentence));
  return out + "</dl>\n";
}

}  // namespace crosscheck
