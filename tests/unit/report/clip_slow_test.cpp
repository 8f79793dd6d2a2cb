// Clips: as many frames as the run has thirtieths of a second, what they show, and programs that are fed.

#include <cstring>

#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/process.h"
#include "report/pictures/clip.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class Clip : public Cli {
 protected:
  ProgramResult render(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"render", "mine.toml", "--size", "320x180"};
    words.insert(words.end(), more.begin(), more.end());
    return call(words);
  }
  /// All frames of the clip, 3 bytes a pixel.
  std::string pixels(const std::string& file) const {
    run_program({"ffmpeg", "-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24", "-y", "pixels"}, folder_);
    return read(folder_ / "pixels");
  }
};

TEST_F(Clip, HasAFrameForEachThirtiethOfTheScene) {
  NEEDS_FFMPEG;
  write("mine.toml", own_scene);  // 0.4 s
  for (const char* file : {"a.mp4", "b.mp4"}) {
    const ProgramResult result = render({"--methods", "leapfrog,rk4", "-o", file});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  const ProgramResult seen =
      run_program({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                   "stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames", "-of", "csv=p=0", "a.mp4"},
                  folder_);
  EXPECT_EQ(seen.out, "h264,320,180,yuv420p,30/1,13\n") << seen.err;
  EXPECT_TRUE(read(folder_ / "a.mp4") == read(folder_ / "b.mp4")) << "the same clip twice has the same bytes";

  const std::string all = pixels("a.mp4");
  const size_t frame = 320 * 180 * 3;
  ASSERT_EQ(all.size(), 13 * frame);
  EXPECT_NE(all.substr(0, frame), all.substr(12 * frame)) << "something moves";
  // letters stand still above the panels, in both of them
  for (const size_t half : {0u, 160u}) {
    int darkest = 255;
    for (size_t y = 0; y < 30; ++y)
      for (size_t x = half; x < half + 160; ++x)
        darkest = std::min<int>(darkest, static_cast<unsigned char>(all[3 * (y * 320 + x)]));
    EXPECT_LT(darkest, 120) << half;
  }
  EXPECT_EQ(files(), 4) << "no temporary file is left: scene, clips, pixels";
}

TEST_F(Clip, NeedsFfmpegAndSaysSo) {
  write("mine.toml", own_scene);
  const ProgramResult result = run_program({CROSSCHECK_PROGRAM, "render", "mine.toml", "-o", "a.mp4"}, folder_,
                                           {"PATH=" + folder_.string(), "ASAN_OPTIONS=detect_leaks=0"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err,
            "crosscheck: clips need ffmpeg, which is not installed; apt-get install --no-install-recommends ffmpeg\n");
  EXPECT_EQ(files(), 1);
}

TEST_F(Clip, WhatFfmpegSaysIsTold) {
  // an encoder that gives up at once: its word comes back, no file is left, and this program lives on
  write("mine.toml", own_scene);
  const auto fake = write("ffmpeg", "#!/bin/sh\necho no such codec >&2; exit 3\n");
  fs::permissions(fake, fs::perms::owner_all);
  const std::string path = "PATH=" + folder_.string() + ":" + std::getenv("PATH");
  const ProgramResult result =
      run_program({CROSSCHECK_PROGRAM, "render", "mine.toml", "--methods", "rk4", "--size", "320x180", "-o", "a.mp4"},
                  folder_, {path, "ASAN_OPTIONS=detect_leaks=0"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("ffmpeg (exit code 3) on a.mp4: no such codec"), std::string::npos) << result.err;
  EXPECT_EQ(files(), 2);
}

TEST(ClipRun, EndsWithTheSceneWhateverItsDuration) {
  Scene scene = load_scene("chain");
  for (const auto& [duration, samples] : {std::pair{3.0, 90}, {0.4, 12}, {1e-3, 1}, {12.566370614359172, 377}}) {
    scene.duration = duration;
    const auto run = clip_run(scene);
    EXPECT_EQ(run.samples, samples);
    EXPECT_EQ(run.duration, duration);
  }
}

TEST(ClipRun, FailuresAreToldWhenTheyCome) {
  const Scene scene = load_scene("chain");
  MethodResult failed{scene.name, "mysim/explicit-euler", {}, {}}, sound{scene.name, "mysim/rk4", {}, {}};
  for (int i = 0; i <= 4; ++i) {
    const double t = i / 30.0;
    sound.trajectory.t.push_back(t), sound.trajectory.x.push_back(scene.start.x);
    if (i > 2) continue;
    failed.trajectory.t.push_back(t), failed.trajectory.x.push_back(scene.start.x);
  }
  failed.trajectory.x.back().setConstant(std::nan(""));
  failed.outcome.verdict = Verdict::nan, failed.outcome.end = 0.07;
  const auto told = [&](double t) {
    Shot shot{.at = t, .in_clip = true};
    const render::Picture picture = picture_of(scene, {&failed, &sound}, shot);
    return std::pair{picture.rows[0][0].subtitle, picture.rows[0][1].subtitle};
  };
  EXPECT_EQ(told(0), std::pair(std::string("t = 0.00 s"), std::string("t = 0.00 s")));
  EXPECT_EQ(told(1 / 30.0).first, "t = 0.03 s");
  // the last that can be drawn stays
  EXPECT_EQ(told(2 / 30.0), std::pair(std::string("t = 0.03 s, blew up at 0.07 s"), std::string("t = 0.07 s")));
  EXPECT_EQ(told(4 / 30.0), std::pair(std::string("t = 0.03 s, blew up at 0.07 s"), std::string("t = 0.13 s")));
}

TEST(ClipRun, OneLookSuitsAllItsTimes) {
  const Scene scene = load_scene("pendulum");
  MethodResult answer{scene.name, "mysim/rk4", {}, {}};
  Recorder recorder;
  answer.outcome = run_method(find_method(answer.method), scene, clip_run(scene), {&recorder});
  answer.trajectory = std::move(recorder.trajectory);
  std::vector<Shot> shots;
  for (const double t : {0.0, 0.5, 1.0}) shots.push_back({.at = t, .in_clip = true});
  const CommonView common = common_view(scene, {&answer}, shots);
  for (const Shot& shot : shots) {
    const CommonView alone = common_view(scene, {&answer}, {shot});
    EXPECT_LE((alone.view.eye - alone.view.target).norm(), (common.view.eye - common.view.target).norm() * (1 + 1e-12));
    const render::Picture picture = picture_of(scene, {&answer}, shot, common);
    EXPECT_EQ(picture.view.eye, common.view.eye) << "the camera stands still";
  }
}

}  // namespace
}  // namespace crosscheck
