// Bullet compared with mysim on small scenes: the explicit world, the implicit world, the position-based world with the
// law of its links, and refused scenes.

#include <Eigen/Dense>

#include <complex>
#include <numbers>

#include "reference/certificate/certificate.h"
#include "reference/method.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Largest distance (m) of corresponding particles between symplectic Euler and Bullet's explicit world.
double apart(const Scene& scene, const Run& run, const std::string& carried_by) {
  const MethodRun ours = run_and_record("symplectic-euler", scene, run),
                  theirs = run_and_record("bullet/deformable-explicit", scene, run);
  EXPECT_EQ(ours.outcome.verdict, Verdict::ok);
  EXPECT_EQ(theirs.outcome.verdict, Verdict::ok) << theirs.outcome.reason;
  EXPECT_TRUE(theirs.outcome.readback);
  if (theirs.outcome.readback) {
    EXPECT_TRUE(contains(theirs.outcome.readback->mapped.at("stiffness"), carried_by));
    EXPECT_FALSE(certify("bullet/deformable-explicit", scene, theirs.outcome).mismatch());
  }
  return sup_distance(ours.trajectory, theirs.trajectory);
}

constexpr auto bullets_force = "Bullet's own mass-spring force";
constexpr auto own_force = "force class of our own";
// required bound: round-off due to the summation order (1e-15 m), times the growth of a perturbation (below 1e3)
constexpr double identity = 1e-12;  // m

TEST(BulletExplicit, IsSymplecticEulerOnSpringPendulumAndChain) {
  for (const auto name : {"spring", "pendulum", "chain"}) {
    const Scene scene = shipped_scene(name);
    for (const double factor : {0.5, 1.0, 2.0}) {
      SCOPED_TRACE(fmt::format("{} at {} of its step", name, factor));
      EXPECT_LE(apart(scene, {factor * scene.step, scene.duration, scene.samples}, bullets_force), identity);
    }
  }
}

TEST(BulletExplicit, IsSymplecticEulerOnASmallClothWithEveryIngredient) {
  // three stiffnesses, wind, moving pins: Crosscheck's own force class
  EXPECT_LE(apart(small_cloth(), {1e-3, 1, 20}, own_force), identity);
}

TEST(BulletExplicit, IsSymplecticEulerOnAClothThatBends) {
  EXPECT_LE(apart(small_cloth("bending = 0.1\n"), {1e-3, 1, 20}, own_force), identity);
}

TEST(BulletExplicit, CarriesTwoStiffnessesByItself) {
  Scene scene = small_cloth();
  for (Spring& s : scene.model.find<Springs>()->list)
    if (s.family == Family::shear) s.k = 40;
  EXPECT_LE(apart(scene, {1e-3, 1, 20}, bullets_force), identity);
}

TEST(BulletExplicit, CarriesUnequalMassesUnderOneDragCoefficient) {
  Scene scene = shipped_scene("chain");
  scene.model.particles.mass << 0.1, 0.3, 0.05, 0.2;
  *scene.model.find<Drag>() = Drag{Eigen::VectorXd::Constant(4, 0.1)};
  EXPECT_LE(apart(scene, {1e-3, 3, 60}, bullets_force), identity);
  *scene.model.find<Drag>() = Drag{2 * scene.model.particles.mass};  // a single rate again
  EXPECT_LE(apart(scene, {1e-3, 3, 60}, bullets_force), identity);
}

TEST(BulletExplicit, FollowsEachIngredientAlone) {
  const std::string two =
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0.6, -0.7, 0.1]\nmass = 2\n"
      "velocity = [0.2, 0, 0.3]\n[[spring]]\nends = [0, 1]\nstiffness = 100\nrest = 0.8\n";
  const std::string pins = "[pins]\nparticles = [0]\n";
  for (const std::string& more :
       {std::string(), pins, pins + "[pins.motion]\namplitude = [0.1, 0, 0.1]\nfrequency = 1\nramp = 0.5\n",
        std::string(gravity_text), std::string("[drag]\ngamma = 2\n"),
        std::string("[wind]\nacceleration = [1, 0, 0]\n")}) {
    SCOPED_TRACE(more);
    EXPECT_LE(apart(small_scene(two + more), {1e-3, 1, 20}, bullets_force), identity);
  }
}

TEST(BulletExplicit, CarriesRestLengthZero) {
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0.6, -0.7, 0.1]\n"
      "mass = 2\n[[spring]]\nends = [0, 1]\nstiffness = 100\nrest = 0\n[pins]\nparticles = [0]\n");
  EXPECT_LE(apart(scene, {1e-3, 1, 20}, bullets_force), identity);
}

TEST(BulletExplicit, NeverLimitsASpeedInSilence) {
  // The explicit world limits speeds to the diagonal of the body's box per step. With a sphere in the scene, the box of
  // a lone particle is as large as its margin. Far from the sphere, the particle must fly freely in both engines, or
  // the limit must be reported.
  for (const auto margin : {"", "margin = 0.02\n"}) {
    SCOPED_TRACE(margin);
    const Scene scene = small_scene(std::string("[[particle]]\nposition = [0, 3, 0]\nmass = 1\nvelocity = [30, 0, 0]\n"
                                                "[sphere]\ncentre = [0, 0, 0]\nradius = 1\n") +
                                    margin);
    const crosscheck::Run run{1e-2, 1, 20};
    const MethodRun theirs = run_and_record("bullet/deformable-explicit", scene, run);
    if (theirs.outcome.verdict == Verdict::unsupported) continue;
    bool said = certify("bullet/deformable-explicit", scene, theirs.outcome).mismatch();
    for (const std::string& law : theirs.outcome.different_law) said |= law.find("speed") != std::string::npos;
    if (said) continue;
    EXPECT_LE(sup_distance(run_and_record("symplectic-euler", scene, run).trajectory, theirs.trajectory), identity);
  }
}

TEST(Bullet, RunsAreBitEqual) {
  for (const auto method : {"bullet/deformable-explicit", "bullet/pbd"})
    for (const auto name : {"chain", "cloth-wind", "cloth-sphere"}) {
      SCOPED_TRACE(fmt::format("{} {}", method, name));
      const Scene scene = shipped_scene(name);
      const crosscheck::Run run{scene.step, std::min(0.25, scene.duration), 5};
      EXPECT_TRUE(
          identical(run_and_record(method, scene, run).trajectory, run_and_record(method, scene, run).trajectory));
    }
}

TEST(BulletPbd, SingleLinkSwingsAtTheBackwardEulerFrequencyAndReadsBackItsStiffness) {
  const double mass = 0.5, k = 50, omega = 10;
  Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, -1.0001, 0]\nmass = 0.5\n"
      "[[spring]]\nends = [0, 1]\nstiffness = 50\nrest = 1\n[pins]\nparticles = [0]\n");
  ASSERT_DOUBLE_EQ(std::sqrt(k / mass), omega);
  for (const auto method : {"bullet/pbd", "bullet/pbd+n=10"})
    for (const double h : {1.0 / 250, 1.0 / 1000}) {
      SCOPED_TRACE(fmt::format("{} h = {}", method, h));
      const MethodRun a = run_and_record(method, scene, {h, 4, static_cast<int>(4 / h)});
      double first = 0, last = 0;
      int periods = -1;
      for (int i = 1; i < a.trajectory.frames(); ++i) {
        const double before = -a.trajectory.x[i - 1](1, 1) - 1, after = -a.trajectory.x[i](1, 1) - 1;
        if (before > 0 || after <= 0) continue;
        last = a.trajectory.t[i - 1] + h * before / (before - after);
        if (++periods == 0) first = last;
      }
      ASSERT_GT(periods, 3);
      const double measured = 2 * std::numbers::pi * periods / (last - first);
      EXPECT_NEAR(measured / (std::atan(omega * h) / h), 1, 1e-3);  // 27 earlier measurements agreed to 1e-4
      ASSERT_TRUE(a.outcome.readback && a.outcome.readback->links[0].stiffness);
      // k is computed from 1 - kLST, with a relative error of n eps / (k h^2 / mu), which is 2e-12 n
      EXPECT_NEAR(*a.outcome.readback->links[0].stiffness / k, 1, 1e-8);
      EXPECT_FALSE(certify(method, scene, a.outcome).mismatch());
    }
}

TEST(BulletPbd, IsMarkedAsAnotherLaw) {
  const auto laws = [](const Scene& scene) {
    std::string text;
    for (const auto& law : run_and_record("bullet/pbd", scene, {scene.step, 0.02, 2}).outcome.different_law)
      text += law + "\n";
    return text;
  };
  EXPECT_TRUE(contains(laws(shipped_scene("chain")), "springs: "));
  EXPECT_TRUE(contains(laws(shipped_scene("cloth-sphere")), "friction: "));
  const Outcome explicit_run =
      run_and_record("bullet/deformable-explicit", shipped_scene("chain"), {1e-3, 0.02, 2}).outcome;
  EXPECT_TRUE(explicit_run.different_law.empty());
}

TEST(Bullet, RefusesWhatItLacksWithTheReason) {
  const std::string ball = std::string("[[particle]]\nposition = [0, 1.5, 0]\nmass = 1\n") + gravity_text;
  const std::string sphere = "[sphere]\ncentre = [0, 0, 0]\nradius = 1\n";
  const std::string lone = "[[particle]]\nposition = [0.5, 1.5, 0]\nmass = 1\n";
  const struct {
    Scene scene;
    std::string reason;
  } cases[] = {{shipped_scene("circle"), "first-order"},
               {small_scene(ball + sphere + "restitution = 0.5\n"), "restitution"},
               {small_scene(lone + ball + sphere), "do not join all particles"}};
  for (const auto& c : cases)
    for (const auto method : {"bullet/deformable-explicit", "bullet/pbd"}) {
      const Outcome out = run_and_record(method, c.scene, {1e-2, 0.1, 1}).outcome;
      EXPECT_EQ(out.verdict, Verdict::unsupported);
      EXPECT_TRUE(contains(out.reason, c.reason));
    }
  const std::pair<std::string, std::string> options[] = {
      {"bullet/deformable-implicit+shipped", "Hooke's law and at most two stiffnesses"},
      {"bullet/pbd+own-wind", "presses on triangles: the scene has none"}};
  for (const auto& [method, reason] : options) {
    const Outcome out = run_and_record(method, small_cloth(), {1e-3, 2e-3, 1}).outcome;
    EXPECT_EQ(out.verdict, Verdict::unsupported);
    EXPECT_TRUE(contains(out.reason, reason));
  }
  Scene uneven = shipped_scene("chain");
  uneven.model.particles.mass[1] = 0.3;
  uneven.model.find<Drag>()->c.setConstant(0.1);
  EXPECT_TRUE(contains(run_and_record("bullet/pbd", uneven, {1e-3, 0.02, 2}).outcome.reason, "one drag rate"));
  // without a sphere this network works
  EXPECT_EQ(run_and_record("bullet/deformable-explicit", small_scene(lone + ball), {1e-2, 0.1, 1}).outcome.verdict,
            Verdict::ok);
}

using namespace testing_tools;

/// An 8 x 8 cloth of 0.7 m, held at two corners, with springs under tension and compression, and the additional scene
/// sections `more`.
Scene cloth(const std::string& more, const std::string& grid = "", const std::string& pins = "") {
  return small_scene("[grid]\nsize = [8, 8]\norigin = [0, 0, 0]\nu = [0.7, 0, 0]\nv = [0, -0.2, 0.6]\nmass = 0.3\n" +
                         grid +
                         "[grid.stiffness]\nstructural = 120\nshear = 80\nbend = 30\n[pins]\nparticles = [0, 7]\n" +
                         pins + gravity_text + more,
                     1.5, 5e-3, 30);
}

Scene shortened(const char* name, double step) {
  Scene scene = shipped_scene(name);
  scene.duration = 1.5, scene.samples = 30, scene.step = step;
  return scene;
}

double distance_to_newton_step(const std::string& method, const Scene& scene) {
  const crosscheck::Run run = default_run(scene);
  const MethodRun ours = run_and_record("implicit-euler+linear", scene, run),
                  theirs = run_and_record(method, scene, run);
  EXPECT_EQ(ours.outcome.verdict, Verdict::ok) << ours.outcome.reason;
  EXPECT_EQ(theirs.outcome.verdict, Verdict::ok) << theirs.outcome.reason;
  EXPECT_FALSE(certify(method, scene, theirs.outcome).mismatch());
  return sup_distance(ours.trajectory, theirs.trajectory);
}

const std::string drag = "[drag]\ngamma = 2\n",
                  moved = "[pins.motion]\namplitude = [0, 0.05, 0.1]\nfrequency = 1\nramp = 0.5\n",
                  wind = "[wind]\nacceleration = [1, 0, 3]\n[wind.gusts]\nvariation = 1\nside = [1, 0, 0]\nseed = 3\n",
                  air = "[aerodynamics]\nvelocity = [0.5, 0, 3]\ndensity = 1.2\ncoefficient = 1\n",
                  dashpots = "dashpot = 0.05\n";

struct Case {
  std::string name;
  Scene scene;
};
std::vector<Case> cases() {
  Scene dashed = shipped_scene("spring");
  dashed.model.terms.emplace_back(Dashpots{{{0, 1, 2.0}}});
  dashed.duration = 1.5, dashed.samples = 30;
  return {{"spring", shortened("spring", 1. / 60)},
          {"chain", shortened("chain", 1. / 240)},
          {"cloth", cloth("")},
          {"cloth with drag", cloth(drag)},
          {"cloth on moved pins", cloth("", "", moved)},
          {"cloth in gusts", cloth(wind)},
          {"cloth in air", cloth(air)},
          {"cloth that bends", cloth("", "bending = 0.02\n")},
          {"spring with a dashpot", dashed},
          {"cloth with dashpots", cloth("", dashpots)},
          {"cloth with everything", cloth(drag + air, dashpots + "bending = 0.02\n", moved)}};
}

TEST(BulletImplicit, TightIsOneNewtonStepOfBackwardEuler) {
  for (const Case& c : cases()) {
    const double tight = distance_to_newton_step("bullet/deformable-implicit+tight", c.scene);
    fmt::print("{:24} {:.2g} m\n", c.name, tight);
    // Required bound: both solvers leave round-off of 1e-15 m per step; drag and implicit steps damp its growth.
    EXPECT_LE(tight, 1e-12) << c.name;
  }
}

TEST(BulletImplicit, DefaultToleranceCostsEightDigits) {
  // Conjugate gradients stop at a squared residual of 2.2e-16 of the initial one, which leaves 1.5e-8 of each step's
  // change of velocity. A run of 1.5 s changes velocities by some m/s, so positions are off by about 1e-8 m.
  for (const Scene& scene : {shortened("chain", 1. / 240), cloth(""), cloth(drag)}) {
    const double tight = distance_to_newton_step("bullet/deformable-implicit+tight", scene),
                 loose = distance_to_newton_step("bullet/deformable-implicit", scene);
    fmt::print("{}: {:.2g} m, tight {:.2g} m\n", scene.name, loose, tight);
    EXPECT_LE(loose, 1e-7);
    EXPECT_GT(loose, 10 * tight);
  }
}

/// Root with positive imaginary part of the recurrence y_{n+2} = p y_{n+1} - q y_n that fits `y` best.
std::complex<double> root_of(const std::vector<double>& y) {
  Eigen::MatrixXd known(y.size() - 2, 2);
  Eigen::VectorXd next(y.size() - 2);
  for (size_t i = 0; i + 2 < y.size(); ++i) {
    known.row(i) << y[i + 1], -y[i];
    next[i] = y[i + 2];
  }
  const Eigen::Vector2d pq = (known.transpose() * known).ldlt().solve(known.transpose() * next);
  return {pq[0] / 2, std::sqrt(pq[1] - pq[0] * pq[0] / 4)};
}

TEST(BulletImplicit, OneSpringHasBackwardEulersFrequencyAndDecayToSixDigits) {
  const Scene scene = shipped_scene("spring");  // 1 kg
  for (const double k : {10., 100., 1000.})
    for (const double h : {1. / 60, 1. / 240, 1. / 1000}) {
      SCOPED_TRACE(fmt::format("{} N/m, {:.3g} s", k, h));
      Scene own = scene;
      own.model.find<Springs>()->list[0].k = k;
      const double omega = std::sqrt(k), rest = -1 - 9.81 / k;
      const int steps = 60;
      own.start.x(1, 1) = rest + 0.1;
      const Trajectory path = run_and_record("bullet/deformable-implicit", own, {h, steps * h, steps}).trajectory;
      std::vector<double> y;
      for (const Points& x : path.x) y.push_back(x(1, 1) - rest);
      const std::complex<double> root = root_of(y);
      EXPECT_NEAR(std::arg(root) / std::atan(omega * h), 1, 1e-6);
      EXPECT_NEAR(std::abs(root) * std::sqrt(1 + omega * omega * h * h), 1, 1e-6);
      // Conversely, the frequency is neither that of the continuous spring nor that of symplectic Euler. From each of
      // them it differs by about (h omega)^2 / 3 or more.
      const double away = omega * omega * h * h / 4;
      EXPECT_GT(std::abs(std::arg(root) / (omega * h) - 1), std::min(away, 0.05));
    }
}

Scene reversed(const Scene& scene) {
  Scene other = scene;
  const int n = scene.model.particles.size();
  Particles& p = other.model.particles;
  p.mass.reverseInPlace();
  std::reverse(p.pinned.begin(), p.pinned.end());
  std::reverse(p.pins.begin(), p.pins.end());
  for (int& pin : p.pins) pin = n - 1 - pin;
  p.pin_home = scene.model.particles.pin_home.rowwise().reverse();
  other.start.x = scene.start.x.rowwise().reverse();
  other.start.v = scene.start.v.rowwise().reverse();
  for (Spring& s : other.model.find<Springs>()->list) s.a = n - 1 - s.a, s.b = n - 1 - s.b;
  if (auto* d = other.model.find<Drag>()) d->c.reverseInPlace();
  return other;
}

TEST(Bullet, PinsFirstOrLastMakeNoDifference) {
  // Sums over links agree bit for bit, as links keep their order. The implicit solver sums over nodes, which are
  // reversed.
  for (const Scene& scene : {shortened("chain", 1e-3), cloth(drag, "", moved)})
    for (const auto& [method, bound] : {std::pair{"bullet/deformable-explicit", 0.},
                                        {"bullet/pbd", 0.},
                                        {"bullet/deformable-implicit+tight", 1e-12}}) {
      SCOPED_TRACE(fmt::format("{} {}", scene.name, method));
      const crosscheck::Run run{1e-3, 0.5, 20};
      const Trajectory first = run_and_record(method, scene, run).trajectory;
      Trajectory last = run_and_record(method, reversed(scene), run).trajectory;
      for (Points& x : last.x) x = x.rowwise().reverse().eval();
      EXPECT_LE(sup_distance(first, last), bound);
      EXPECT_GT((first.x.back() - first.x.front()).cwiseAbs().maxCoeff(), 0.1);
    }
}

using namespace testing_tools;

TEST(BulletLink, PositionBasedWorldConvergesToItsLinkLawAndNotToHookes) {
  const Scene linked = shipped_scene("chain-link");
  Scene hooke = linked;
  hooke.model.find<Springs>()->law = SpringLaw::hooke;
  const crosscheck::Run fine{1e-4, 1.5, 30};
  const Trajectory to_link = run_and_record("rk4", linked, fine).trajectory,
                   to_hooke = run_and_record("rk4", hooke, fine).trajectory;
  std::vector<double> link, law;
  for (const double h : {1e-3, 5e-4, 2.5e-4, 1.25e-4}) {
    const Trajectory t = run_and_record("bullet/pbd", linked, {h, 1.5, 30}).trajectory;
    link.push_back(sup_rms(t, to_link));
    law.push_back(sup_rms(t, to_hooke));
  }
  fmt::print("bullet/pbd from its link law {:.3g} to {:.3g} m, from Hooke's {:.3g} to {:.3g} m\n", link.front(),
             link.back(), law.front(), law.back());
  for (size_t i = 1; i < link.size(); ++i)
    EXPECT_NEAR(slope(link[i - 1], link[i]), 1, 0.1);  // first order; the next term is smaller by h omega = 0.03
  // The remaining difference from Hooke's springs is due to the law: a tenth of the force at these strains.
  EXPECT_GT(law.back(), 10 * link.back());
  EXPECT_GT(law.back(), 0.01);
}

TEST(BulletLink, ExplicitWorldFollowsTheLinkLawToRoundOff) {
  const Scene scene = shipped_scene("chain-link");
  const MethodRun ours = run_and_record("symplectic-euler", scene, default_run(scene)),
                  theirs = run_and_record("bullet/deformable-explicit", scene, default_run(scene));
  EXPECT_LE(sup_distance(ours.trajectory, theirs.trajectory), 1e-12);  // bound of the identity tests
  EXPECT_FALSE(certify("bullet/deformable-explicit", scene, theirs.outcome).mismatch());
  // the certificate must detect an engine that follows Hooke's law
  Scene hooke = scene;
  hooke.model.find<Springs>()->law = SpringLaw::hooke;
  const MethodRun other = run_and_record("bullet/deformable-explicit", hooke, default_run(scene));
  EXPECT_TRUE(certify("bullet/deformable-explicit", scene, other.outcome).mismatch());
}

TEST(BulletLink, HardDistancesAreLinksThatGiveWayToNothing) {
  for (const auto name : {"rod", "cloth-inextensible"}) {
    SCOPED_TRACE(name);
    const Scene scene = shipped_scene(name);
    const crosscheck::Run run{scene.step, 0.5, 10};
    const MethodRun one = run_and_record("bullet/pbd", scene, run), ten = run_and_record("bullet/pbd+n=10", scene, run);
    const Certificate certificate = certify("bullet/pbd", scene, one.outcome);
    EXPECT_FALSE(certificate.mismatch());
    bool listed = false;
    for (const CertificateRow& row : certificate.rows) listed |= row.quantity == "hard distances";
    EXPECT_TRUE(listed);
    auto stretch = [&](const MethodRun& a) {
      double worst = 0;
      for (const Points& x : a.trajectory.x)
        worst = std::max(worst, largest_constraint_error(*scene.model.find<Constraints>(), x));
      return worst;
    };
    EXPECT_LT(stretch(one), 0.02);
    EXPECT_LT(stretch(ten), 0.5 * stretch(one));  // more iterations help
    EXPECT_LT(sup_rms(one.trajectory, truth_of(scene, run)->trajectory), 0.02);
    // a length that changes during the run is a mismatch
    Outcome wrong = one.outcome;
    wrong.readback->links.back().rest *= 1.001;
    EXPECT_TRUE(certify("bullet/pbd", scene, wrong).mismatch());
    const Outcome refused = run_and_record("bullet/deformable-explicit", scene, run).outcome;
    EXPECT_EQ(refused.verdict, Verdict::unsupported);
    EXPECT_TRUE(contains(refused.reason, "no hard distances"));
  }
}

TEST(BulletLink, EverySceneIsHandedOverOrRefusedWithTheReason) {
  const std::pair<std::string, std::string> refused[] = {
      {"circle", "first-order"}, {"bounce", "restitution"}, {"room-bounce", "restitution"}};
  for (const auto& name : shipped_scene_names())
    for (const auto method : {"bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd"}) {
      const Scene scene = shipped_scene(std::string(name));
      const Outcome out = run_and_record(method, scene, {scene.step, 2 * scene.step, 1}).outcome;
      std::string reason;
      for (const auto& [which, why] : refused)
        if (which == name) reason = why;
      if (scene.model.find<Constraints>() && method != std::string("bullet/pbd")) reason = "hard distances";
      if (name == "curtain" && method == std::string("bullet/pbd")) reason = "one drag rate";  // its masses differ
      EXPECT_EQ(out.verdict == Verdict::unsupported, !reason.empty()) << name << ", " << method << ": " << out.reason;
      EXPECT_TRUE(contains(out.reason, reason));
    }
}

}  // namespace
}  // namespace crosscheck
