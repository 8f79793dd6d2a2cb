// The protocol's two example engines agree with mysim.

#include "reference/certificate/certificate.h"
#include "reference/method.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class ExampleEngines : public InFolder {
 protected:
  /// Debian's python3, which has python3-numpy. Another python3 may come first in PATH.
  std::string python() const {
    return script("example_engine.py",
                  "exec /usr/bin/python3 '" CROSSCHECK_SOURCE "/reference/protocol/example_engine.py' \"$@\"\n");
  }
};

TEST_F(ExampleEngines, AreSymplecticEuler) {
  for (const auto name : {"spring", "pendulum", "chain", "projectile", "cloth-hang", "cloth-swing", "chain-link"}) {
    const Scene scene = shipped_scene(name);
    // Python loops need 0.2 ms per step of the cloth.
    const double part = scene.start.x.cols() > 50 ? 0.1 : 1;
    const crosscheck::Run run{scene.step, part * scene.duration, static_cast<int>(std::lround(part * scene.samples))};
    const MethodRun ours = run_and_record("symplectic-euler", scene, run);
    for (const std::string& engine : {std::string(CROSSCHECK_EXAMPLE), python()}) {
      SCOPED_TRACE(std::string(name) + " by " + engine);
      const MethodRun theirs = run_and_record("exec:" + engine, scene, run);
      ASSERT_EQ(theirs.outcome.verdict, Verdict::ok) << theirs.outcome.reason;
      EXPECT_EQ(theirs.outcome.remark, "");
      EXPECT_EQ(theirs.outcome.steps, ours.outcome.steps);
      // only the summation order differs: 1e-15 m times a growth of perturbations below 1e3
      EXPECT_LE(sup_distance(ours.trajectory, theirs.trajectory), 1e-12);
      for (int i = 0; i < ours.trajectory.frames(); ++i)
        EXPECT_LE(largest_column(ours.trajectory.v[i] - theirs.trajectory.v[i]), 1e-10);  // m/s; omega up to 100/s
    }
  }
}

TEST_F(ExampleEngines, AttestAllThatTheCertificateAsks) {
  for (const auto name : {"spring", "pendulum", "chain", "projectile", "cloth-hang", "cloth-swing", "chain-link"}) {
    const Scene scene = shipped_scene(name);
    for (const std::string& engine : {std::string(CROSSCHECK_EXAMPLE), python()}) {
      SCOPED_TRACE(std::string(name) + " by " + engine);
      const Outcome out = run_and_record("exec:" + engine, scene, {scene.step, 4 * scene.step, 2}).outcome;
      ASSERT_EQ(out.verdict, Verdict::ok) << out.reason;
      for (const CertificateRow& row : certify("engine", scene, out).rows)
        EXPECT_EQ(row.parity, Parity::match) << row.quantity << ": " << row.read_back;
    }
  }
}

TEST_F(ExampleEngines, RefuseWhatTheyLack) {
  for (const auto name : {"circle", "rod", "cloth-wind", "slide"})
    for (const std::string& engine : {std::string(CROSSCHECK_EXAMPLE), python()}) {
      const Scene scene = shipped_scene(name);
      const Outcome out = run_and_record("exec:" + engine, scene, {scene.step, 2 * scene.step, 1}).outcome;
      EXPECT_EQ(out.verdict, Verdict::unsupported) << out.reason;
      EXPECT_TRUE(contains(out.reason, " has no "));
    }
}

}  // namespace
}  // namespace crosscheck
