// Tests Jolt as an engine: npm's build if npm is available, and a native build if CROSSCHECK_JOLT names a source tree
// of Jolt.

#include <fmt/format.h>

#include <cstdlib>

#include "reference/protocol/trajectory_files.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck::testing_tools {
namespace {

class Jolt : public Cli, public ::testing::WithParamInterface<std::string> {
 protected:
  /// Skips npm's build if there is no registry, and the native build if there is no source tree.
  void SetUp() override {
    Cli::SetUp();
    const char* tree = std::getenv("CROSSCHECK_JOLT");
    if (is_native() && !tree) GTEST_SKIP() << "this machine has no source tree of Jolt named by CROSSCHECK_JOLT";
    if (is_native()) from_ = {"--prefix", tree};
    if (!is_native() && (!on_path("npm") ||
                         run_program({"npm", "view", "jolt-physics", "version", "--fetch-retries=0"}, folder_).status))
      GTEST_SKIP() << "this machine has no npm with access to a registry: Jolt is not tested";
  }
  static bool is_native() { return GetParam() == "native"; }
  /// Builds the adapter and moves it to another folder, because it must not need files next to it. Returns the method's
  /// name, or "" if the build failed.
  std::string built() const {
    std::vector<std::string> words{"engine", "jolt", "-o", "made"};
    words.insert(words.end(), from_.begin(), from_.end());
    const ProgramResult made = call(words);
    EXPECT_EQ(made.status, 0) << "npm needs its registry, or jolt-physics in its cache: " << made.err;
    if (made.status != 0) return "";
    fs::create_directories(folder_ / "moved");
    fs::rename(folder_ / "made", folder_ / "moved/jolt");
    return "exec:" + (folder_ / "moved/jolt").string();
  }

 private:
  std::vector<std::string> from_;
};
INSTANTIATE_TEST_SUITE_P(Both, Jolt, ::testing::Values("npm", "native"),
                         [](const auto& of) { return std::string(of.param); });

std::string scene_text(double duration, int samples, double step, const std::string& rest) {
  return fmt::format(
      "question = \"Where does it hang?\"\nparameters = \"Round numbers.\"\n[time]\nduration = {0}\nsamples = {1}\n"
      "step = {2}\nwindow = {0}\ntolerance = 1e-3\nmethod = \"leapfrog\"\n[gravity]\nacceleration = [0, -9.81, 0]\n{3}",
      duration, samples, step, rest);
}

TEST_P(Jolt, SpeaksTheProtocolAndIsWhatItsReadBackSays) {
  const std::string jolt = built();
  ASSERT_FALSE(jolt.empty());
  const ProgramResult kit = call({"check", "--protocol", jolt});
  EXPECT_EQ(kit.status, 0) << kit.out;
  EXPECT_TRUE(contains(kit.out, " 0 lacking, of which 0 required, 4 refused"));
  EXPECT_TRUE(contains(kit.out, "dashpots: Jolt damps velocities only, not along springs"));
  for (const char* scene : {"spring", "projectile", "rod", "slide"}) {
    const ProgramResult compared = call({"compare", scene, "--methods", "xpbd," + jolt, "--out", scene});
    EXPECT_EQ(compared.status, 0) << compared.out;
    EXPECT_TRUE(contains(compared.out, "read back, no mismatch"));
    EXPECT_FALSE(contains(compared.out, "not attested"));
  }
  for (const auto& [scene, why] : {std::pair{"flag", "aerodynamics"}, {"chain-link", "the law bullet-link"}}) {
    const ProgramResult refused = call({"run", scene, "--method", jolt, "--out", "refused"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(contains(refused.err, why));
  }
}

TEST_P(Jolt, AChainHangsWhereOnePassInSinglePrecisionLeavesIt) {
  const std::string jolt = built();
  ASSERT_FALSE(jolt.empty());
  constexpr double g = 9.81, m = 0.1, k = 100, gamma = 5, h = 1. / 256;
  std::string chain = fmt::format("[pins]\nparticles = [0]\n[drag]\ngamma = {}\n", gamma);
  for (int i = 0; i < 4; ++i) chain += fmt::format("[[particle]]\nposition = [0, {}, 0]\nmass = {}\n", -0.5 * i, m);
  for (int i = 0; i < 3; ++i)
    chain += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = 0.5\n", i, i + 1, k);
  write("chain.toml", scene_text(6, 6, h, chain));
  for (const int n : {1, 2}) {
    const ProgramResult run =
        call({"run", "chain.toml", "--method", fmt::format("{}+n={}", jolt, n), "--out", "chain"});
    ASSERT_EQ(run.status, 0) << run.err;
    const Points end = read_npy(folder_ / "chain/trajectory.npy", 7, 7, 4).back();
    // In a sub-step d all particles fall by s = g d^2 (1 - gamma d), and one pass from the pin downwards corrects this.
    // An edge with j particles below it is left with the excess length e that satisfies k d^2 e / m = j s. The rest of
    // the pass pulls the lower end of the edge down by (j - 1) s.
    const double d = h / n, s = g * d * d * (1 - gamma * d), soft = m / (k * d * d);
    const double sag = (3 * soft + 2) * s + (2 * soft + 1) * s + soft * s;
    // each sub-step rounds coordinates three times, by 3e-8 m; this adds to s, on edges above 1, 2 and 3 particles
    const double rounding = 6 * 3 * 3e-8 * soft;
    EXPECT_NEAR(-1.5 - end(1, 3), sag, rounding) << n;
    EXPECT_LT(rounding, 0.5 * std::abs(sag - 6 * m * g / k))
        << "the closed form must differ from that of exact springs";
  }
}

TEST_P(Jolt, FreezesWhereAStepOfTheFallIsLessThanHalfAUnitInTheLastPlace) {
  const std::string jolt = built();
  ASSERT_FALSE(jolt.empty());
  struct Row {
    double height;  // m, above the frame's origin
    int power;      // the step is 2^power s
    bool frozen;
  };
  // the unit in the last place is 2^-24 m at 0.9 m and 2^-17 m at 100 m; g h^2 is 0.61, 0.15, 1.2 and 0.31 of these
  // units
  for (const Row& row : {Row{0.9, -14, false}, {0.9, -15, true}, {100, -10, false}, {100, -11, true}}) {
    write("fall.toml", scene_text(0.125, 1, std::ldexp(1, row.power),
                                  fmt::format("[[particle]]\nposition = [0, {}, 0]\nmass = 1\n", row.height)));
    const ProgramResult run = call({"run", "fall.toml", "--method", jolt + "+frame=world", "--out", "fall"});
    EXPECT_EQ(contains(run.out, "frozen"), row.frozen) << row.height << " m, 2^" << row.power << ": " << run.out;
    const ProgramResult near = call({"run", "fall.toml", "--method", jolt, "--out", "near"});
    EXPECT_FALSE(contains(near.out, "frozen")) << "the frame's origin is the particle's start";
  }
}

TEST_P(Jolt, BreaksNoRelationButForKnownCauses) {
  const std::string jolt = built();
  ASSERT_FALSE(jolt.empty());
  const ProgramResult checked = call({"check", jolt});
  EXPECT_EQ(checked.status, 0) << checked.out;
  EXPECT_TRUE(contains(checked.out, "holds            momentum"));
}

}  // namespace
}  // namespace crosscheck::testing_tools
