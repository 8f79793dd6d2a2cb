// Every engine is judged by the same evidence: verdicts depend neither on units nor on whether an engine is an external
// program, and the rule of a method is identified from its runs.

#include <optional>

#include "experiments/check/check.h"
#include "experiments/check/transformations.h"
#include "experiments/stability/limit.h"
#include "reference/certificate/certificate.h"
#include "reference/protocol/trajectory_files.h"
#include "reference/which_rule.h"
#include "tests/unit/experiments/defects.h"
#include "tests/unit/experiments/verdict_trials.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
using EngineRun = crosscheck::Run;

/// Restricts a method to what an external program would output: only the states on which verdicts are based.
Method as_program(Method method) {
  method.engine = [inner = method.engine](const Scene& scene, const EngineRun& asked, Observer& observer) {
    const TimeGrid grid = time_grid(asked);
    const int per_sample =
        observer.between_samples() ? grid.steps_per_sample / verdict_stride(grid, scene.model.particles.size()) : 1;
    EngineRun run = asked;
    run.samples *= per_sample;
    Recorder recorder;
    Outcome out = inner(scene, run, recorder);
    out.steps = 0;
    replay({recorder.trajectory.x, recorder.trajectory.v}, scene, run, observer, out, per_sample);
    return out;
  };
  method.name = "exec:" + method.name, method.rule = "", method.stepper = nullptr,
  method.contact = ContactLoss::sampled;
  method.adaptive = method.implicit = method.position_based = false;
  identify_by_runs(method);
  return method;
}

Method as_program(const char* name) { return as_program(find_method(name)); }

Outcome outcome_of(const Method& method, const Scene& scene, const EngineRun& run) {
  return run_method(method, scene, run, {});
}

TEST(Verdicts, AreTheSameInAllUnits) {
  // scaling by powers of two is exact
  const Scaling scalings[] = {{0x1p-10, 1, 1}, {1, 0x1p13, 1}, {1, 1, 0x1p-7}, {0x1p20, 0x1p-20, 0x1p10}};
  int failed = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const TrialScene trial = trial_scene(random);
    const Method method = find_method(std::array{"leapfrog", "symplectic-euler", "rk4", "explicit-euler"}[seed % 4]);
    const double step = std::array{0.5, 1.9, 2.1, 3.1}[seed / 4 % 4] / trial.omega;
    const EngineRun run{step, step * 300, 10, 1e-6, false};
    const Outcome here = outcome_of(method, trial.scene, run);
    failed += here.verdict != Verdict::ok;
    for (const Scaling& scaling : scalings) {
      EngineRun other = run;
      other.step *= scaling.time, other.duration *= scaling.time;
      const Outcome there = outcome_of(method, scaled(trial.scene, scaling), other);
      EXPECT_EQ(name_of(there.verdict), name_of(here.verdict)) << seed << " " << trial.kind;
      EXPECT_EQ(there.end, here.end * scaling.time) << seed << " " << trial.kind;
    }
  }
  EXPECT_GE(failed, 8);
}

TEST(Verdicts, DoNotDependOnALengthInMetres) {
  // a cloth on a ball, 11 % above the stability limit of its fastest vibration, in m and in mm
  const Scene cloth = parse_scene(
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 0.5\nstep = 0.001\nwindow = 0.5\nsamples = 7\n"
      "tolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = [7, 7]\norigin = [-0.25, 1.05, -0.2]\n"
      "u = [0.5, 0, 0]\nv = [0, 0, 0.5]\nmass = 0.4\n[grid.stiffness]\nstructural = 200\nshear = 200\nbend = 200\n"
      "[gravity]\nacceleration = [0, -9.81, 0]\n[[sphere]]\ncentre = [0, 0, 0]\nradius = 0.98\nmargin = 0.02\n"
      "friction = 0.5\n[drag]\ngamma = 3\n",
      "cloth-in-m");
  const Scaling millimetres{1e-3, 1e-6, std::sqrt(1e-3)};  // gravity has the same numerical value
  const EngineRun run{5.4945054945e-3, 0.14285714285714285, 2, 1e-6, false};
  EngineRun other = run;
  other.step *= millimetres.time, other.duration *= millimetres.time;
  const Method method = find_method("symplectic-euler");
  EXPECT_EQ(name_of(outcome_of(method, cloth, run).verdict), "energy");
  EXPECT_EQ(name_of(outcome_of(method, scaled(cloth, millimetres), other).verdict), "energy");
}

TEST(Verdicts, AreThoseOfAProgramWithTheSameRule) {
  for (unsigned seed = 0; seed < 16; ++seed) {
    Random random(seed);
    const TrialScene trial = trial_scene(random);
    const Method method = find_method(std::array{"leapfrog", "symplectic-euler", "rk4", "implicit-euler"}[seed % 4]);
    const double step = std::array{0.5, 1.9, 2.1, 3.1}[seed / 4 % 4] / trial.omega;
    // 3000 steps in 3 samples, which are all observed, or 30 000, of which every fifth is observed
    const EngineRun run{step, step * (seed % 8 == 0 ? 30000 : 3000), 3, 1e-6, false};
    const Outcome inside = outcome_of(method, trial.scene, run),
                  outside = outcome_of(as_program(method), trial.scene, run);
    EXPECT_EQ(name_of(outside.verdict), name_of(inside.verdict)) << seed << " " << trial.kind;
    EXPECT_NEAR(outside.end, inside.end, 1e-9 * inside.end) << seed << " " << trial.kind;
  }
}

TEST(Verdicts, SeeWhatHappensBetweenSamples) {
  // leapfrog 1 % above its limit; the only sample is at the end of the run
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1.1, 0, 0]\nmass = 1\n[[spring]]\n"
      "ends = [0, 1]\nstiffness = 100\nrest = 1\n[pins]\nparticles = [0]\n");
  // The mass makes a large excursion in one step, and is then caught again, as by a sphere.
  Method caught = with_defect("leapfrog", nullptr, [](const Scene& s, State& state) {
    if (state.t > 19 * 0.1)
      state.x = s.start.x, state.v = s.start.v;
    else if (state.t > 0.95)
      state.x(0, 1) = state.t < 1.05 ? -20 : 20;
  });
  EXPECT_NE(outcome_of(caught, scene, {0.1, 2, 1}).verdict, Verdict::ok);
}

TEST(Verdicts, NoteVibrationsThatReverseInEveryStep) {
  // Leapfrog runs 3 % above the limit of a chain that lies on a ball. Differences over two steps hide most of the
  // vibration.
  std::string text =
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 0.79\nstep = 0.001\nwindow = 0.79\nsamples = 20\n"
      "tolerance = 1e-3\nmethod = \"leapfrog\"\n[gravity]\nacceleration = [0, -9.81, 0]\n[[sphere]]\n"
      "centre = [0, 0, 0]\nradius = 0.98\nmargin = 0.02\nfriction = 0.3\n[drag]\ngamma = 1\n";
  const double mass[] = {0.0578, 0.0363, 0.0625, 0.0351, 0.0444, 0.0473, 0.0612, 0.0565, 0.0351},
               stiffness[] = {295, 223, 277, 294, 232, 254, 212, 249};
  for (int i = 0; i < 9; ++i)
    text += fmt::format("[[particle]]\nposition = [{}, {}, {}]\nmass = {}\n", -0.4 + 0.0995 * i, 1.08 + 0.00998 * i,
                        (i % 2 ? 1e-3 : -6e-4), mass[i]);
  for (int i = 0; i < 8; ++i)
    text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = 0.1\n", i, i + 1, stiffness[i]);
  const Scene scene = parse_scene(text, "chain-on-ball");
  for (const Method& method : {find_method("leapfrog"), as_program("leapfrog")}) {
    const Outcome out = outcome_of(method, scene, {0.01316667, 0.79, 20, 1e-6, false});
    EXPECT_TRUE(out.verdict != Verdict::ok || contains(out.remark, "times as fast")) << out.remark;
    EXPECT_EQ(outcome_of(method, scene, {0.011, 0.79, 20, 1e-6, false}).remark, "");
  }
}

TEST(VerdictStride, DividesTheSamplingIntervalAndBoundsTheStates) {
  for (const int per_sample : {1, 7, 40, 60, 4099, 100000, 1000000000})
    for (const int samples : {1, 100, 20000})
      for (const int particles : {1, 1000, 100000}) {
        const int stride = verdict_stride({1e-3, per_sample, samples}, particles);
        EXPECT_EQ(per_sample % stride, 0);
        EXPECT_TRUE(stride == per_sample ||
                    double(per_sample / stride) * samples <= std::min(8192., 0x1p20 / particles));
      }
  EXPECT_EQ(verdict_stride({1e-3, 40, 100}, 10), 1);
}

TEST(LargestSteps, AreThoseOfAProgramWithTheSameRule) {
  const BaseState base = base_state_of(shipped_scene("spring"));
  for (const char* name : {"rk4", "symplectic-euler", "leapfrog", "trapezoidal"}) {
    SCOPED_TRACE(name);
    const auto limit = [&](const Method& method) {
      return measured_limit(method, base, 1000, {predicted_limit(method, base.spectrum).mode}, 0.004);
    };
    const MeasuredLimit inside = limit(find_method(name)), outside = limit(as_program(name));
    EXPECT_EQ(outside.kind, inside.kind);
    // both searches try the same steps
    EXPECT_NEAR(outside.held, inside.held, 0.005 * inside.held);
    EXPECT_NEAR(outside.failed, inside.failed, 0.005 * inside.failed);
  }
}

TEST(WhichRule, IsTheOneThatTheProgramFollows) {
  for (const char* name : {"explicit-euler", "trapezoidal", "rk4", "symplectic-euler", "leapfrog", "suzuki4",
                           "implicit-euler", "implicit-euler+linear", "implicit-midpoint", "xpbd"}) {
    SCOPED_TRACE(name);
    const FoundRule found = as_program(name).identify();
    EXPECT_EQ(found.kind, FoundRule::same) << sentence_of(found);
    EXPECT_EQ(found.rule, name);
    EXPECT_TRUE(found.own_drag) << sentence_of(found);
    EXPECT_TRUE(contains(found.tried, "drag"));
  }
  const Method odeint = find_method("odeint/rk4");
  EXPECT_EQ(find_rule(odeint).rule, "rk4");
}

TEST(WhichRule, TellsDragApart) {
  // drag is applied after the step, either exactly or implicitly
  struct Case {
    const char* name;
    double (*factor)(double z);
  };
  for (const auto& [name, factor] :
       {Case{"exact", [](double z) { return std::exp(-z); }}, Case{"implicit", [](double z) { return 1 / (1 + z); }}}) {
    Method method = find_method("leapfrog");
    method.engine = [factor = factor](const Scene& scene, const EngineRun& run, Observer& observer) {
      Scene free = scene;
      std::erase_if(free.model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
      const auto* drag = scene.model.find<Drag>();
      const double h = time_grid(run).h, gamma = drag ? drag->c[0] / scene.model.particles.mass[0] : 0;
      System f(free.model);
      Workspace w(free.start);
      State s = free.start;
      observer.observe(s, true);
      for (int i = 1; i <= run.samples; ++i) {
        stepper("leapfrog").step(f, s, h, w);
        s.v *= factor(gamma * h), s.t = i * h;
        observer.observe(s, true);
      }
      return Outcome{.step = h};
    };
    const FoundRule found = find_rule(method);
    EXPECT_EQ(found.rule, "leapfrog");
    EXPECT_EQ(found.drag, name) << sentence_of(found);
    EXPECT_FALSE(found.own_drag);
  }
}

TEST(WhichRule, NamesTheNearestWhereItIsNone) {
  const Method wrong =
      as_program(with_defect("rk4", [](Scene& s, const EngineRun&) { multiply_stiffness(s, 1 + 1e-6); }));
  const FoundRule found = wrong.identify();
  EXPECT_EQ(found.kind, FoundRule::nearest) << sentence_of(found);
  EXPECT_EQ(found.rule, "rk4");
  EXPECT_GT(found.distance, 1e-8);
  EXPECT_LT(found.distance, 1e-5);
  EXPECT_EQ(stepper_of(wrong), nullptr);
}

/// A program that ignores the requested step and uses `step`.
Method with_step(const char* base, double step) {
  Method method = find_method(base);
  method.engine = [inner = method.engine, step](const Scene& scene, const EngineRun& asked, Observer& observer) {
    EngineRun run = asked;
    run.step = step;
    Outcome out = inner(scene, run, observer);
    out.step = time_grid(asked).h, out.steps = 0;
    return out;
  };
  return as_program(method);
}

TEST(WhichRule, SeesThatStepsAreChosenOrIgnored) {
  EXPECT_EQ(as_program("dopri5").identify().kind, FoundRule::own_steps);
  EXPECT_EQ(find_rule(find_method("dopri5")).kind, FoundRule::own_steps);
  EXPECT_EQ(with_step("symplectic-euler", 0x1p-10).identify().kind, FoundRule::ignores_step);
}

TEST(WhichRule, SpeaksOfTheIngredientsTriedOnly) {
  const Method method = as_program("rk4"), built_in = find_method("rk4");
  const auto same = [](const Method& a, const char* b, const char* scene) {
    return same_rule(a, find_method(b), shipped_scene(scene).model);
  };
  EXPECT_EQ(same(method, "rk4", "chain"), true);
  EXPECT_EQ(same(method, "leapfrog", "cloth-sphere"), false);
  for (const char* name : {"cloth-sphere", "cloth-swing", "circle"}) {
    EXPECT_EQ(same(method, "rk4", name), std::nullopt) << name;
    EXPECT_EQ(same(built_in, "odeint/rk4", name), true) << name;
  }
}

TEST(WhichRule, OfBulletsWorldsIsMeasuredToo) {
  const auto same = [](const char* a, const char* b) {
    return same_rule(find_method(a), find_method(b), shipped_scene("cloth-wind").model);
  };
  EXPECT_EQ(same("bullet/deformable-explicit", "symplectic-euler"), true);
  EXPECT_EQ(same("bullet/deformable-explicit", "leapfrog"), false);
  EXPECT_EQ(same("bullet/deformable-implicit+tight", "implicit-euler+linear"), true);
  EXPECT_EQ(same("bullet/deformable-implicit", "implicit-euler+linear"), std::nullopt)
      << "its solver leaves a larger residual";
  EXPECT_EQ(same("bullet/pbd", "symplectic-euler"), false);
  EXPECT_EQ(rule_of(find_method("bullet/deformable-implicit")), "implicit-euler+linear, solver above rounding");
}

/// A program that stores positions in single precision, and reports their differences as velocities.
Method in_single_precision(const char* rule, bool reversed) {
  Method method = find_method(rule);
  method.engine = [step = stepper(rule).step, reversed](const Scene& asked, const EngineRun& run, Observer& observer) {
    Scene scene = asked;
    if (reversed)
      for (Term& term : scene.model.terms)
        if (auto* springs = std::get_if<Springs>(&term)) std::ranges::reverse(springs->list);
    const TimeGrid grid = time_grid(run);
    System f(scene.model);
    Workspace w(scene.start);
    State s = scene.start;
    s.x = s.x.cast<float>().cast<double>(), s.v = s.v.cast<float>().cast<double>();
    observer.observe(s, true);
    for (int i = 1; i <= grid.samples * grid.steps_per_sample; ++i) {
      step(f, s, grid.h, w);
      s.x = s.x.cast<float>().cast<double>(), s.v = s.v.cast<float>().cast<double>(), s.t = i * grid.h;
      observer.observe(s, i % grid.steps_per_sample == 0);
    }
    return Outcome{.step = grid.h};
  };
  return as_program(method);
}

TEST(WhichRule, IsFoundInSinglePrecision) {
  const Method same = in_single_precision("symplectic-euler", false);
  EXPECT_EQ(rule_of(same), "symplectic-euler, single precision") << sentence_of(same.identify());
  EXPECT_EQ(same_rule(same, find_method("symplectic-euler"), shipped_scene("chain").model), true);
  const Method other_order = in_single_precision("xpbd", true);
  EXPECT_EQ(other_order.identify().kind, FoundRule::nearest) << "a Gauss-Seidel sweep in another order";
  EXPECT_EQ(rule_of(other_order), "xpbd on one spring, single precision") << sentence_of(other_order.identify());
}

TEST(RowsOfRules, HangOnTheRuleFoundAndNotOnAName) {
  const auto known = read_known_breaks(shipped_known_breaks());
  const auto marks = [&](Method method, const char* name) {
    method.name = name;
    std::string text;
    for (const char* relation : {"spring-order", "no-force"})
      for (const Answer& a : answers_of(method, {}, 1, known, {}, {}, &find_relation(relation)))
        text += fmt::format("{} ", name_of(a.mark));
    return text;
  };
  const Method xpbd = as_program("xpbd"), right = as_program("leapfrog");
  const std::string breaks = marks(xpbd, "exec:./engine");
  EXPECT_TRUE(contains(breaks, "known")) << breaks;
  for (const char* name : {"exec:./jolt", "exec:./leapfrog", "exec:./bullet/pbd"})
    EXPECT_EQ(marks(xpbd, name), breaks) << name;
  // a correct name does not excuse a defect
  Method idle = right;
  idle.engine = [](const Scene& scene, const EngineRun& run, Observer& observer) {
    Outcome out{.step = time_grid(run).h};
    replay({std::vector<Points>(run.samples + 1, scene.start.x), std::vector<Points>(run.samples + 1, scene.start.v)},
           scene, run, observer, out);
    return out;
  };
  identify_by_runs(idle);
  EXPECT_TRUE(contains(marks(idle, "exec:./jolt-compare/engine"), "broken"));
}

std::vector<std::string> broken_by(const Method& method) {
  std::vector<std::string> names;
  for (const Answer& a : answers_of(method, {}, 1, {}))
    if (a.mark == RelationMark::broken) names.push_back(fmt::format("{}: {}", a.relation->name, a.sentence()));
  return names;
}

TEST(RelationsOfPrograms, AreBrokenByNoRuleThatIsRight) {
  // rk4 and explicit Euler change the energy by errors of their order, as they should
  for (const char* name : {"rk4", "explicit-euler", "dopri5"})
    for (const std::string& broken : broken_by(as_program(name))) ADD_FAILURE() << name << ": " << broken;
  Method unknown = as_program("rk4");
  unknown.identify = nullptr;
  for (const std::string& broken : broken_by(unknown)) ADD_FAILURE() << broken;
}

TEST(RelationsOfPrograms, AreBrokenByControlEngines) {
  const auto breaks = [](const Method& method, const std::string& relation) {
    const auto broken = broken_by(method);
    return std::ranges::any_of(broken, [&](const std::string& text) { return text.starts_with(relation + ":"); });
  };
  for (const bool velocities : {true, false}) {
    Method idle = as_program("leapfrog");
    idle.engine = [velocities](const Scene& scene, const EngineRun& run, Observer& observer) {
      Outcome out{.step = time_grid(run).h};
      replay({std::vector<Points>(run.samples + 1, scene.start.x),
              velocities ? std::vector<Points>(run.samples + 1, scene.start.v) : std::vector<Points>()},
             scene, run, observer, out);
      return out;
    };
    for (const char* relation : {"free-fall", "turned", "half-step", "one-answer", "extension", "stiffness", "momentum",
                                 "scaling", "mirror", "particle-order"})
      EXPECT_TRUE(breaks(idle, relation)) << relation << velocities;
  }
  for (const char* relation : {"half-step", "one-answer"})
    EXPECT_TRUE(breaks(with_step("symplectic-euler", 0x1p-11), relation)) << relation;
  const Method other =
      as_program(with_defect("leapfrog", [](Scene& s, const EngineRun&) { multiply_gravity(s, 1.01); }));
  for (const char* relation : {"free-fall", "extension"}) EXPECT_TRUE(breaks(other, relation)) << relation;
  const Method leaking = as_program(with_defect(
      "leapfrog", [](Scene& s, const EngineRun&) { s.model.terms.emplace_back(Drag{1e-2 * s.model.particles.mass}); }));
  EXPECT_TRUE(breaks(leaking, "energy"));
}

/// Free fall whose kicks and drifts are split into several parts, each of which is rounded. The force is scaled by
/// `factor`.
Method in_parts(int kicks, int drifts, bool kick_first, double factor) {
  Method method = find_method("leapfrog");
  method.engine = [=](const Scene& scene, const EngineRun& run, Observer& observer) {
    const TimeGrid grid = time_grid(run);
    System f(scene.model);
    State s = scene.start;
    Points a = s.x;
    const auto kick = [&](double h) {
      f.acceleration(s, a);
      for (int i = 0; i < kicks; ++i) s.v += factor * (h / kicks) * a;
    };
    const auto drift = [&](double h) {
      for (int i = 0; i < drifts; ++i) s.x += h / drifts * s.v;
    };
    observer.observe(s, true);
    for (int i = 1; i <= grid.samples * grid.steps_per_sample; ++i) {
      if (kick_first)
        kick(grid.h / 2), drift(grid.h), kick(grid.h / 2);
      else
        drift(grid.h / 2), kick(grid.h), drift(grid.h / 2);
      s.t = grid.time(0, i);
      observer.observe(s, i % grid.steps_per_sample == 0);
    }
    return Outcome{.step = grid.h};
  };
  return as_program(method);
}

TEST(FreeFall, AllowsForTheRoundingOfKicksInPartsAndNoMore) {
  // A relative error of 1e-9 in the force moves a net by 5e-9 m in 1 s; rounding moves it by 1e-13 m.
  for (const bool kick_first : {true, false})
    for (const auto& [kicks, drifts] : {std::pair{1, 1}, {2, 1}, {1, 2}, {3, 2}})
      for (const double step : {1.0, 0.7, 0.31})
        for (const double factor : {1.0, 1 + 1e-9, 1 - 1e-9}) {
          Subject subject(in_parts(kicks, drifts, kick_first, factor));
          Scene scene = find_relation("free-fall").smallest()[0];
          scene.step *= step;
          const RelationResult result = find_relation("free-fall").ask(subject, scene, 1);
          EXPECT_EQ(result.holds(), factor == 1)
              << kicks << drifts << kick_first << step << " " << factor << ": " << result.ratio();
        }
}

TEST(Certificates, PassRoundingsAndNothingMore) {
  const Scene scene = shipped_scene("chain");
  Outcome out = outcome_of(find_method("bullet/deformable-explicit"), scene, default_run(scene));
  ASSERT_TRUE(out.readback);
  EXPECT_FALSE(certify("m", scene, out).mismatch());
  out.readback->step = std::nextafter(out.step, 1);
  EXPECT_FALSE(certify("m", scene, out).mismatch());
  out.readback->step = out.step * (1 + 1e-9);
  EXPECT_TRUE(certify("m", scene, out).mismatch());
  out.readback->step = out.step;
  ASSERT_TRUE(out.readback->probe);
  Points& dashpots = out.readback->probe->dashpots;
  dashpots = Points::Zero(3, scene.model.particles.size());
  dashpots(0, 1) = 1e-17;
  EXPECT_FALSE(certify("m", scene, out).mismatch());
  dashpots(0, 1) = 1e-3;
  EXPECT_TRUE(certify("m", scene, out).mismatch());
}

}  // namespace
}  // namespace crosscheck
