// Scenes written in other units of length, mass and time give the same truths, error bars and advice.

#include <regex>

#include "experiments/advise/advice.h"
#include "experiments/advise/dense_truth.h"
#include "mysim/base/text.h"
#include "reference/method.h"
#include "reference/truth/independent/integrators.h"
#include "reference/truth/truth.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

struct Units {
  double length = 1, mass = 1, time = 1;
};

/// Converts each number that is followed by a unit to the given units. The conversion is exact for powers of two.
std::string in_units(const std::string& text, const Units& u) {
  const std::pair<const char*, double> factors[] = {
      {"kg/m3", u.mass / (u.length * u.length * u.length)},
      {"m/s2", u.length / (u.time * u.time)},
      {"N/m", u.mass / (u.time * u.time)},
      {"Ns/m", u.mass / u.time},
      {"m/s", u.length / u.time},
      {"1/s", 1 / u.time},
      {"kg", u.mass},
      {"m", u.length},
      {"s", u.time},
  };
  static const std::regex quantity(R"((-?[0-9][-0-9.e]*) (kg/m3|m/s2|N/m|Ns/m|m/s|1/s|kg|m|s)\b)");
  std::string out;
  auto at = text.begin();
  for (std::sregex_iterator found(text.begin(), text.end(), quantity), end; found != end; ++found) {
    out.append(at, (*found)[0].first);
    for (const auto& [unit, factor] : factors)
      if ((*found)[2] == unit) {
        out += fmt::format("{}", std::stod((*found)[1]) * factor);
        break;
      }
    at = (*found)[0].second;
  }
  return out.append(at, text.end());
}

struct Kind {
  std::string name, text;
  double duration;
};

const char* const falls = "[gravity]\nacceleration = [0 m/s2, -9.81 m/s2, 0 m/s2]\n";
const char* const ball = "[[sphere]]\ncentre = [0 m, 0 m, 0 m]\nradius = 0.98 m\nmargin = 0.02 m\nfriction = 0.2\n";
const char* const slope =
    "[[plane]]\npoint = [0 m, 0 m, 0 m]\nnormal = [-0.6, 0.8, 0]\nmargin = 0.02 m\nfriction = 0.3\n";
const char* const hung =
    "[[particle]]\nposition = [0 m, 0 m, 0 m]\nmass = 1 kg\n[[particle]]\nposition = [0.5 m, -0.3 m, 0 m]\n"
    "mass = 0.3 kg\n[[spring]]\nends = [0, 1]\nstiffness = 100 N/m\nrest = 0.5 m\n[pins]\nparticles = [0]\n";
const char* const sheet =
    "[grid]\nsize = [3, 3]\norigin = [0 m, 0 m, 0 m]\nu = [1 m, 0 m, 0 m]\nv = [0 m, -0.9 m, 0.4 m]\nmass = 0.25 kg\n"
    "[grid.stiffness]\nstructural = 40 N/m\nshear = 30 N/m\n[pins]\nparticles = [0, 1, 2]\n";

std::vector<Kind> kinds() {
  const std::string dropped =
      "[[particle]]\nposition = [0.02 m, 1.3 m, 0.01 m]\nmass = 0.2 kg\n[[particle]]\nposition = [0.3 m, 1.4 m, "
      "0.05 m]\nmass = 0.3 kg\nvelocity = [0 m/s, 0 m/s, 0.2 m/s]\n[[spring]]\nends = [0, 1]\nstiffness = 80 N/m\n"
      "rest = 0.25 m\n[drag]\ngamma = 0.3 1/s\n";
  return {
      {"circle", "[[particle]]\nposition = [0.7 m, 0 m, 0 m]\n[rotation]\nrate = 1.5 1/s\n", 2},
      {"projectile",
       std::string("[[particle]]\nposition = [0 m, 1 m, 0 m]\nmass = 0.3 kg\nvelocity = [3 m/s, 2 m/s, 0 m/s]\n[drag]\n"
                   "gamma = 0.4 1/s\n") +
           falls,
       1},
      {"pendulum", std::string(hung) + falls, 1},
      {"moved pin",
       std::string(hung) + "[pins.motion]\namplitude = [0.2 m, 0 m, 0 m]\nfrequency = 1 1/s\nramp = 0.3 s\n" + falls,
       1},
      {"dashpot and drag",
       std::string(hung) + "[drag]\ngamma = 2 1/s\n[wind]\nacceleration = [1 m/s2, 0 m/s2, 2 m/s2]\n" + falls, 1},
      {"sheet", std::string(sheet) + falls, 0.5},
      {"sheet in air",
       std::string(sheet) + "[aerodynamics]\ndensity = 1.2 kg/m3\ncoefficient = 1\nvelocity = [0 m/s, 0 m/s, 3 m/s]\n" +
           falls,
       0.5},
      {"bounces", dropped + ball + "restitution = 0.5\n" + falls, 0.7},
      {"slide in drag",
       std::string("[[particle]]\nposition = [0 m, 1 m, 0 m]\nmass = 1 kg\nvelocity = [1 m/s, 0 m/s, 0.1 m/s]\n[drag]\n"
                   "gamma = 0.2 1/s\n") +
           ball + falls,
       0.8},
      {"moved ball",
       std::string("[[particle]]\nposition = [0 m, 1 m, 0 m]\nmass = 1 kg\n") + ball +
           "[sphere.motion]\namplitude = [0.05 m, 0.02 m, 0.03 m]\nfrequency = 0.7 1/s\nramp = 0.5 s\n" + falls,
       0.4},
      {"slope",
       std::string("[[particle]]\nposition = [-0.012 m, 0.016 m, 0 m]\nmass = 2 kg\nvelocity = [1.2 m/s, 0.9 m/s, 0 "
                   "m/s]\n") +
           slope + falls,
       0.8},
      {"room",
       std::string("[[particle]]\nposition = [0.3 m, 0.4 m, 0.2 m]\nmass = 0.5 kg\nvelocity = [1.5 m/s, -1 m/s, 0.7 "
                   "m/s]\n[[plane]]\npoint = [0 m, 0 m, 0 m]\nnormal = [0, 1, 0]\nrestitution = 0.5\n[[plane]]\npoint "
                   "= [0.9 m, 0 m, 0 m]\nnormal = [-1, 0, 0]\nrestitution = 0.5\n") +
           falls,
       0.7},
      {"pair on a slope",
       "[[particle]]\nposition = [0.02 m, 0.3 m, 0.01 m]\nmass = 0.2 kg\n[[particle]]\nposition = [0.3 m, 0.4 m, 0.05 "
       "m]\nmass = 0.3 kg\nvelocity = [0 m/s, 0 m/s, 0.2 m/s]\n[[spring]]\nends = [0, 1]\nstiffness = 80 N/m\nrest = "
       "0.25 m\n[drag]\ngamma = 0.3 1/s\n" +
           std::string(slope) + "restitution = 0.5\n" + falls,
       0.7},
      {"moved floor",
       std::string("[[particle]]\nposition = [0 m, 0.1 m, 0 m]\nmass = 1 kg\nvelocity = [0.5 m/s, 0 m/s, 0 m/s]\n"
                   "[[plane]]\npoint = [0 m, 0 m, 0 m]\nnormal = [0, 1, 0]\nfriction = 0.4\nvelocity = [0.3 m/s, "
                   "0.1 m/s, 0 m/s]\n") +
           falls,
       0.6},
  };
}

Scene scene_in(const Kind& kind, const Units& u) {
  const std::string head = fmt::format(
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = {0} s\nsamples = 8\nstep = 0.001 s\nwindow = {0} s\n"
      "tolerance = 0.001 m\nmethod = \"leapfrog\"\n",
      kind.duration);
  return parse_scene(in_units(head + kind.text, u), kind.name);
}

/// Units of length, mass or time, each scaled alone up and down by each of the factors; followed by `mixed`
/// combinations of all three.
std::vector<Units> units_by(std::vector<double> factors, int mixed, unsigned seed) {
  std::vector<Units> list;
  for (const double factor : factors)
    for (const double f : {factor, 1 / factor})
      for (const Units& u : {Units{f, 1, 1}, Units{1, f, 1}, Units{1, 1, f}}) list.push_back(u);
  Random random(seed);
  const auto draw = [&] {
    const double f = factors[static_cast<size_t>(random.between(0, static_cast<double>(factors.size())))];
    return random.between(-1, 1) < 0 ? 1 / f : f;
  };
  for (int i = 0; i < mixed; ++i) {
    const double length = draw(), mass = draw(), time = draw();
    list.push_back({length, mass, time});
  }
  return list;
}

TEST(Units, ByPowersOfTwoChangeNoBitOfTruths) {
  unsigned seed = 1;
  for (const Kind& kind : kinds()) {
    const Scene scene = scene_in(kind, {});
    const auto truth = truth_of(scene, default_run(scene));
    ASSERT_TRUE(truth) << kind.name;
    for (const Units& u : units_by({0x1p10, 0x1p20}, 2, seed++)) {
      SCOPED_TRACE(fmt::format("{} {:a} {:a} {:a}", kind.name, u.length, u.mass, u.time));
      const Scene other = scene_in(kind, u);
      EXPECT_EQ(other.size(), scene.size() * u.length);
      const auto there = truth_of(other, default_run(other));
      ASSERT_TRUE(there);
      EXPECT_EQ(there->tier, truth->tier);
      EXPECT_EQ(there->error_bar, truth->error_bar * u.length);
      EXPECT_EQ(there->until, truth->until * u.time);
      ASSERT_EQ(there->trajectory.frames(), truth->trajectory.frames());
      for (int i = 0; i < truth->trajectory.frames(); ++i) {
        EXPECT_EQ(there->trajectory.t[i], truth->trajectory.t[i] * u.time);
        EXPECT_EQ(there->trajectory.x[i], truth->trajectory.x[i] * u.length) << i;
      }
    }
  }
}

TEST(Units, ByPowersOfTenKeepTierErrorsWithinTheBarsAndBarsWithinAFactorTwo) {
  unsigned seed = 1;
  for (const Kind& kind : kinds()) {
    const Scene scene = scene_in(kind, {});
    const auto truth = truth_of(scene, default_run(scene));
    ASSERT_TRUE(truth) << kind.name;
    for (const Units& u : units_by({1e3}, 2, seed++)) {
      SCOPED_TRACE(fmt::format("{} {} {} {}", kind.name, u.length, u.mass, u.time));
      const Scene other = scene_in(kind, u);
      const auto there = truth_of(other, default_run(other));
      ASSERT_TRUE(there);
      EXPECT_EQ(there->tier, truth->tier);
      EXPECT_EQ(std::isinf(there->until), std::isinf(truth->until));
      if (std::isfinite(truth->until)) {
        EXPECT_NEAR(there->until, truth->until * u.time, 1e-12 * truth->until * u.time);
      }
      const double bar = there->error_bar / u.length;
      EXPECT_LE(std::max(bar, truth->error_bar), 2 * std::min(bar, truth->error_bar));
      for (int i = 0; i < truth->trajectory.frames(); ++i)
        EXPECT_LE(rms_distance(there->trajectory.x[i] / u.length, truth->trajectory.x[i]), bar + truth->error_bar);
    }
  }
}

/// Runs the scene in the units `u`, to which `step` (s) is converted.
MethodRun run_in(const Kind& kind, const Units& u, const std::string& method, double step) {
  const Scene scene = scene_in(kind, u);
  return run_and_record(method, scene, {step * u.time, 8 * step * u.time * 12, 8, 1e-6});
}

TEST(Units, ChangeNoVerdict) {
  unsigned seed = 1;
  int failed = 0, good = 0, overflows = 0;
  for (const Kind& kind : kinds()) {
    const bool first_order = kind.name == "circle";
    for (const char* method : {"rk4", "trapezoidal", "dopri5", "leapfrog", "symplectic-euler", "implicit-euler"})
      for (const double step : {0.002, 0.03, 0.3}) {
        if (first_order && method[0] != 'r' && method[0] != 't' && method[0] != 'd') continue;
        const MethodRun here = run_in(kind, {}, method, step);
        (here.outcome.verdict == Verdict::ok ? good : failed)++;
        for (const Units& u : units_by({0x1p10, 0x1p20}, 1, seed++)) {
          const MethodRun there = run_in(kind, u, method, step);
          SCOPED_TRACE(fmt::format("{} {} {} {:a} {:a} {:a}", kind.name, method, step, u.length, u.mass, u.time));
          // The largest floating-point number is the same in all units, so that squares overflow one step earlier in
          // some of them.
          const auto blew_up = [](Verdict v) { return v == Verdict::energy || v == Verdict::nan; };
          if (there.outcome.verdict != here.outcome.verdict && blew_up(there.outcome.verdict) &&
              blew_up(here.outcome.verdict)) {
            ++overflows;
            continue;
          }
          ASSERT_EQ(there.outcome.verdict, here.outcome.verdict);
          EXPECT_EQ(there.outcome.end, here.outcome.end * u.time);
          EXPECT_EQ(there.outcome.remark.empty(), here.outcome.remark.empty());
          ASSERT_EQ(there.trajectory.frames(), here.trajectory.frames());
          for (int i = 0; i < here.trajectory.frames(); ++i)
            EXPECT_EQ(there.trajectory.x[i], here.trajectory.x[i] * u.length) << i;
        }
        for (const Units& u : units_by({1e3}, 1, seed++)) {
          SCOPED_TRACE(fmt::format("{} {} {} {} {} {}", kind.name, method, step, u.length, u.mass, u.time));
          EXPECT_EQ(run_in(kind, u, method, step).outcome.verdict == Verdict::ok, here.outcome.verdict == Verdict::ok);
        }
      }
  }
  EXPECT_GT(std::min(good, failed), 20);
  EXPECT_LT(overflows, 10) << "of several thousand runs";
}

TEST(Units, ByPowersOfTwoChangeNoBitOfAdvice) {
  unsigned seed = 1;
  for (const Kind& kind : kinds()) {
    const auto methods = [&] { return find_methods(kind.name == "circle" ? "rk4,dopri5" : "leapfrog,dopri5"); };
    const Advice a = advise(scene_in(kind, {}), 1e-2, methods());
    for (const Units& u : units_by({seed % 2 == 0 ? 0x1p10 : 0x1p20}, 2, seed)) {
      SCOPED_TRACE(fmt::format("{} {:a} {:a} {:a}", kind.name, u.length, u.mass, u.time));
      const Advice b = advise(scene_in(kind, u), 1e-2 * u.length, methods());
      EXPECT_EQ(b.trials[b.chosen].method, a.trials[a.chosen].method);
      EXPECT_EQ(b.trials[b.chosen].step, a.trials[a.chosen].step * u.time);
      EXPECT_EQ(b.trials[b.chosen].relative, a.trials[a.chosen].relative);
      EXPECT_EQ(b.error_bar, a.error_bar * u.length);
      EXPECT_EQ(b.checked, a.checked * u.length);
    }
    ++seed;
  }
}

/// Largest distance (m) between the dense truth and the event-driven solution at times between its samples.
double distance_between_samples(const Scene& scene, const DenseTruth& truth) {
  Run run = default_run(scene);
  run.samples = 7 * truth.dense().samples, run.tolerance = 1e-12;
  run.step = std::min(run.step, run.duration / run.samples);
  Recorder path;
  run_event_driven(scene, run, path);
  double most = 0;
  for (int i = 0; i < path.trajectory.frames() && path.trajectory.t[i] <= truth.until(); ++i)
    most = std::max(most, rms_distance(truth.at(path.trajectory.t[i]), path.trajectory.x[i]));
  return most;
}

TEST(DenseTruth, OfASmallSceneIsKnownBetweenItsSamplesThoughItIsHit) {
  const Scene scene = small_scene(
      std::string(
          "[[particle]]\nposition = [2e-5, 1.3e-3, 1e-5]\nmass = 1e-6\n[[particle]]\n"
          "position = [3e-4, 1.35e-3, 0]\nmass = 1e-6\n[[spring]]\nends = [0, 1]\nstiffness = 0.3\n"
          "[[sphere]]\ncentre = [0, 0, 0]\nradius = 9.8e-4\nmargin = 2e-5\nfriction = 0.3\nrestitution = 0.4\n") +
          gravity_text,
      0.04, 2e-5, 50);
  for (const double tolerance : {4.04e-7, 4.04e-8}) {
    const DenseTruth truth(scene, tolerance);
    EXPECT_LE(truth.error_bar(), tolerance / 30);
    EXPECT_LE(distance_between_samples(scene, truth), truth.error_bar());
  }
}

TEST(DenseTruth, OfRandomScenesWithContactLiesWithinItsBarBetweenTheSamples) {
  for (const unsigned seed : {1, 4, 5, 7, 8, 13}) {
    const Scene scene = random_contact_scene(seed);
    const DenseTruth truth(scene, 1e-5 * scene.size());
    EXPECT_LE(distance_between_samples(scene, truth), truth.error_bar()) << seed;
  }
}

}  // namespace
}  // namespace crosscheck
