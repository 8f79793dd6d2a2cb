// Bullet's implicit world is one Newton step of backward Euler: mysim's implicit-euler+linear.
#include <Eigen/Dense>
#include <complex>

#include "experiments/scenes.h"
#include "reference/certificate.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// An 8 x 8 cloth of 0.7 m held at two corners, with more ingredients; its springs are pulled and pushed.
Scene cloth(const std::string& more, const std::string& grid = "", const std::string& pins = "") {
  return small_scene("[grid]\nsize = [8, 8]\norigin = [0, 0, 0]\nu = [0.7, 0, 0]\nv = [0, -0.2, 0.6]\nmass = 0.3\n" +
                         grid +
                         "[grid.stiffness]\nstructural = 120\nshear = 80\nbend = 30\n[pins]\nparticles = [0, 7]\n" +
                         pins + gravity_text + more,
                     1.5, 5e-3, 30);
}

Scene shortened(const char* name, double step) {
  Scene scene = load_scene(name);
  scene.duration = 1.5, scene.samples = 30, scene.step = step;
  return scene;
}

double apart(const std::string& method, const Scene& scene) {
  const crosscheck::Run run = default_run(scene);
  const Answered ours = answer("implicit-euler+linear", scene, run), theirs = answer(method, scene, run);
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
  Scene dashed = load_scene("spring");
  dashed.model.terms.emplace_back(Dashpots{{{0, 1, 2.0}}});
  dashed.duration = 1.5, dashed.samples = 30;
  return {{"spring", shortened("spring", 1. / 60)},
          {"chain", shortened("chain", 1. / 240)},
          {"cloth", cloth("")},
          {"cloth with drag", cloth(drag)},
          {"cloth on moved pins", cloth("", "", moved)},
          {"cloth in gusts", cloth(wind)},
          {"cloth in air", cloth(air)},
          {"spring with a dashpot", dashed},
          {"cloth with dashpots", cloth("", dashpots)},
          {"cloth with everything", cloth(drag + air, dashpots, moved)}};
}

TEST(BulletImplicit, TightIsOneNewtonStepOfBackwardEuler) {
  for (const Case& c : cases()) {
    const double tight = apart("bullet/deformable-implicit+tight", c.scene);
    fmt::print("{:24} {:.2g} m\n", c.name, tight);
    // the bound: both solve to round-off, 1e-15 m a step, and drag and implicitness damp what grows
    EXPECT_LE(tight, 1e-12) << c.name;
  }
}

TEST(BulletImplicit, DefaultToleranceCostsEightDigits) {
  // conjugate gradients end at a squared residual of 2.2e-16 of what they began with: 1.5e-8 of each step's change of
  // velocity is left; over the changes of a run, some m/s for 1.5 s, that makes some 1e-8 m
  for (const Scene& scene : {shortened("chain", 1. / 240), cloth(""), cloth(drag)}) {
    const double tight = apart("bullet/deformable-implicit+tight", scene),
                 loose = apart("bullet/deformable-implicit", scene);
    fmt::print("{}: {:.2g} m, tight {:.2g} m\n", scene.name, loose, tight);
    EXPECT_LE(loose, 1e-7);
    EXPECT_GT(loose, 10 * tight);
  }
}

/// The pair of roots of y_{n+2} = p y_{n+1} - q y_n that fits a sequence best.
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
  const Scene scene = load_scene("spring");  // 1 kg
  for (const double k : {10., 100., 1000.})
    for (const double h : {1. / 60, 1. / 240, 1. / 1000}) {
      SCOPED_TRACE(fmt::format("{} N/m, {:.3g} s", k, h));
      Scene own = scene;
      own.model.find<Springs>()->list[0].k = k;
      const double omega = std::sqrt(k), rest = -1 - 9.81 / k;
      const int steps = 60;
      own.start.x(1, 1) = rest + 0.1;
      const Trajectory path = answer("bullet/deformable-implicit", own, {h, steps * h, steps}).trajectory;
      std::vector<double> y;
      for (const Points& x : path.x) y.push_back(x(1, 1) - rest);
      const std::complex<double> root = root_of(y);
      EXPECT_NEAR(std::arg(root) / std::atan(omega * h), 1, 1e-6);
      EXPECT_NEAR(std::abs(root) * std::sqrt(1 + omega * omega * h * h), 1, 1e-6);
      // two-sided: neither the continuous spring's nor symplectic Euler's frequency, which are 1/3 (h omega)^2 or more
      // away
      const double away = omega * omega * h * h / 4;
      EXPECT_GT(std::abs(std::arg(root) / (omega * h) - 1), std::min(away, 0.05));
    }
}

/// The same scene with its particles in the opposite order.
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
  // links keep their order: sums over links have the same bits; those of the implicit solver run over nodes
  for (const Scene& scene : {shortened("chain", 1e-3), cloth(drag, "", moved)})
    for (const auto& [method, bound] : {std::pair{"bullet/deformable-explicit", 0.},
                                        {"bullet/pbd", 0.},
                                        {"bullet/deformable-implicit+tight", 1e-12}}) {
      SCOPED_TRACE(fmt::format("{} {}", scene.name, method));
      const crosscheck::Run run{1e-3, 0.5, 20};
      const Trajectory first = answer(method, scene, run).trajectory;
      Trajectory last = answer(method, reversed(scene), run).trajectory;
      for (Points& x : last.x) x = x.rowwise().reverse().eval();
      EXPECT_LE(sup_distance(first, last), bound);
      EXPECT_GT((first.x.back() - first.x.front()).cwiseAbs().maxCoeff(), 0.1);
    }
}

}  // namespace
}  // namespace crosscheck
