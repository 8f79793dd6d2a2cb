// Frames that go to disk as they come.
#include "reference/frame_files.h"

#include <sys/resource.h>

#include <csignal>

#include "experiments/scenes.h"
#include "reference/npy.h"
#include "tests/unit/helpers.h"
#include "tests/unit/refusal.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class FramesOnDisk : public InFolder {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) list.push_back(entry.path().filename());
    std::sort(list.begin(), list.end());
    return list;
  }
};

TEST_F(FramesOnDisk, AreTheBytesOfTheTrajectoryInMemory) {
  const struct {
    std::string method;
    Scene scene;
    bool velocities;
  } cases[] = {{"leapfrog", small_cloth(), true},
               {"dopri5", small_cloth(), true},
               {"bullet/pbd", load_scene("chain"), true},
               {"rk4", load_scene("circle"), false}};
  for (const auto& [method, scene, velocities] : cases) {
    SCOPED_TRACE(scene.name + " " + method);
    std::filesystem::remove(folder_ / "velocities.npy");
    Recorder kept;
    FrameFiles files(folder_);
    ASSERT_EQ(run_method(find_method(method), scene, default_run(scene), {&kept, &files}).verdict, Verdict::ok);
    files.finish();
    EXPECT_EQ(files.times(), kept.trajectory.t);
    EXPECT_EQ(read(folder_ / "trajectory.npy"), npy_bytes(kept.trajectory.x));
    EXPECT_EQ(std::filesystem::exists(folder_ / "velocities.npy"), velocities);
    if (velocities) {
      EXPECT_EQ(read(folder_ / "velocities.npy"), npy_bytes(kept.trajectory.v));
    }
  }
}

TEST_F(FramesOnDisk, OfARunThatFailsAreAsManyAsThereWere) {
  const Scene scene = load_scene("cloth-hang");
  const crosscheck::Run run = default_run(scene);
  Recorder kept;
  FrameFiles files(folder_);
  ASSERT_EQ(run_method(find_method("explicit-euler"), scene, run, {&kept, &files}).verdict, Verdict::energy);
  files.finish();
  const int frames = kept.trajectory.frames();
  ASSERT_LT(frames, run.samples);
  ASSERT_GT(frames, 1);
  EXPECT_EQ(read_npy(folder_ / "trajectory.npy", frames, frames, scene.model.particles.size()), kept.trajectory.x);
  EXPECT_EQ(read_npy(folder_ / "velocities.npy", frames, frames, scene.model.particles.size()), kept.trajectory.v);
}

TEST_F(FramesOnDisk, LeaveWhatWasThereUntilTheyAreWhole) {
  write("trajectory.npy", "old");
  const Scene scene = small_cloth();
  {
    FrameFiles cut(folder_);
    cut.observe(scene.start, true);
    EXPECT_EQ(read(folder_ / "trajectory.npy"), "old");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "velocities.npy"));
  }
  EXPECT_EQ(names(), std::vector<std::string>{"trajectory.npy"}) << "what was cut is gone";
  EXPECT_EQ(read(folder_ / "trajectory.npy"), "old");

  FrameFiles whole(folder_);
  whole.observe(scene.start, true);
  whole.finish();
  EXPECT_EQ(names(), (std::vector<std::string>{"trajectory.npy", "velocities.npy"}));
  EXPECT_EQ(read(folder_ / "trajectory.npy"), npy_bytes({scene.start.x}));
}

TEST_F(FramesOnDisk, SayWhichFileCannotBeWritten) {
  const Scene scene = small_cloth();
  EXPECT_TRUE(contains(refusal_of([&] { FrameFiles(write("file", "") / "x").observe(scene.start, true); }),
                       "file/x/trajectory.npy: cannot be written; expected a folder with write permission"));
  // a disk that is full, as a process sees it that may write 1000 bytes and no more
  const auto write_more = [&] {
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string said = refusal_of([&] {
      FrameFiles files(folder_);
      for (int i = 0; i < 100; ++i) files.observe(scene.start, true);
      files.finish();
    });
    std::fputs(said.c_str(), stderr);
    std::_Exit(names() == std::vector<std::string>{"file"} ? 2 : 1);
  };
  EXPECT_EXIT(write_more(), testing::ExitedWithCode(2), "(velocities|trajectory).npy: cannot be written; expected");
}

TEST(NpyHeader, HasOneLengthWhateverTheNumbers) {
  for (const auto& [frames, particles] : {std::pair{0L, 0L}, {1L, 9L}, {1000001L, 10000000L}})
    EXPECT_EQ(npy_header(frames, particles).size(), 128u);
}

}  // namespace
}  // namespace crosscheck
