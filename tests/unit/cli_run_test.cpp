// run on the command line where much is written: nothing half, and nothing kept in memory.
#include <fmt/format.h>
#include <sys/resource.h>

#include "tests/unit/cli.h"

namespace crosscheck::testing_tools {
namespace {

class CliRun : public Cli {};

TEST_F(CliRun, KilledLeavesNoHalfFile) {
  // two thousand million steps of a chain take minutes, and frames come all the time
  const ProgramResult result = run_program({"timeout", "-s", "KILL", "1", CROSSCHECK_PROGRAM, "run", "chain",
                                            "--duration", "19000", "--step", "1e-5", "--out", "out"},
                                           folder_);
  EXPECT_EQ(result.status, 128 + 9) << result.err;
  ASSERT_TRUE(fs::exists(folder_ / ".out.crosscheck/new")) << "it was running";
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(call({"run", "chain", "--out", "out"}).status, 0);
  EXPECT_EQ(files(), 6) << "the folder, its five files and nothing else";
}

TEST_F(CliRun, MoreFramesTakeNoMoreMemory) {
  constexpr int side = 200, many = 60;
  const auto with_samples = [&](int samples) {
    write(fmt::format("{}.toml", samples),
          fmt::format("question = \"q\"\nparameters = \"p\"\n[time]\nduration = 0.006\nsamples = {}\nstep = 1e-4\n"
                      "window = 0.006\ntolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = [{}, {}]\n"
                      "origin = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\nmass = 0.25\n[grid.stiffness]\n"
                      "structural = 20\nshear = 20\nbend = 20\n[pins]\nparticles = [0]\n",
                      samples, side, side));
    const ProgramResult result = call({"run", fmt::format("{}.toml", samples), "--out", "out"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(read(folder_ / "out/trajectory.npy").substr(0, 128).find(fmt::format("({}, ", samples + 1)),
              std::string::npos);
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return used.ru_maxrss / 1024.;  // MiB: of the largest program so far
  };
  constexpr double frame = 2. * 3 * side * side * sizeof(double) / (1 << 20);  // MiB, positions and velocities
  const double few = with_samples(2);
  // the allocator's own moods: a tenth of what the frames would take
  EXPECT_LT(with_samples(many) - few, 0.1 * many * frame);
}

}  // namespace
}  // namespace crosscheck::testing_tools
