// Frames are drawn one after the other and go to ffmpeg's stdin at once: no image is kept.
#include "report/pictures/clip.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/process.h"
#include "mysim/base/progress.h"
#include "mysim/base/text.h"
#include "report/pictures/layout.h"
#include "report/pictures/lettering.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;

constexpr int rate = 30;  // frames for each second of the scene

/// One thread and no tags: the same images give the same bytes on machines of any number of cores. Colours as players
/// expect them in a file of this kind.
std::string ffmpeg_call(const fs::path& file, int width, int height, const fs::path& messages) {
  return fmt::format(
      "LC_ALL=C.UTF-8 TZ=UTC exec ffmpeg -nostdin -v error -f rawvideo -pixel_format rgb24 -video_size {}x{} "
      "-framerate {} -i pipe:0 -vf scale=out_color_matrix=bt709:out_range=tv -colorspace bt709 -color_primaries bt709 "
      "-color_trc bt709 -pix_fmt yuv420p -c:v libx264 -crf 20 -threads 1 -fflags +bitexact -flags:v +bitexact "
      "-movflags +faststart -f mp4 -y {} > /dev/null 2> {}",
      width, height, rate, shell_single_quote("file:" + file.string()), shell_single_quote(messages.string()));
}

/// A file that ffmpeg writes under a temporary name next to it. Without finish() there is none.
class Video {
 public:
  Video(fs::path file, int width, int height)
      : file_(std::move(file)),
        temporary_(file_.parent_path() / fmt::format(".{}.{}.tmp", file_.filename().string(), getpid())) {
    ffmpeg_ = popen(ffmpeg_call(temporary_, width, height, messages_.path / "err").c_str(), "we");
    if (!ffmpeg_) throw std::runtime_error("ffmpeg cannot be started");
    broken_pipe_ = std::signal(SIGPIPE, SIG_IGN);
  }
  ~Video() {
    close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
  }
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  void add(const render::Image& image) {
    if (std::fwrite(image.rgb.data(), 1, image.rgb.size(), ffmpeg_) == image.rgb.size()) return;
    close_well();
    throw std::runtime_error("ffmpeg takes no more images for " + file_.string());
  }
  void finish() {
    close_well();
    fs::rename(temporary_, file_);
  }

 private:
  /// Waits for the end of ffmpeg; returns its status as of wait().
  int close() {
    if (!ffmpeg_) return 0;
    const int status = pclose(std::exchange(ffmpeg_, nullptr));
    std::signal(SIGPIPE, broken_pipe_);
    return status;
  }
  void close_well() {
    if (const int status = close(); status != 0)
      throw std::runtime_error(fmt::format("ffmpeg (exit code {}) on {}: {}", WEXITSTATUS(status), file_.string(),
                                           last_lines(try_read_file(messages_.path / "err").value_or(""), 1)));
  }

  fs::path file_, temporary_;
  TemporaryFolder messages_{"video"};
  std::FILE* ffmpeg_ = nullptr;
  void (*broken_pipe_)(int) = SIG_DFL;  // handler to restore
};

}  // namespace

Run clip_run(const Scene& scene) {
  Run run = default_run(scene);
  run.samples = static_cast<int>(std::max(1.0, std::round(rate * scene.duration)));
  return run;
}

void require_clip(const Shot& shot) {
  if (shot.mode == Mode::strip)
    throw InputError("--mode strip: expected shaded, stretch, springs or difference for a clip");
  if (shot.width % 2 || shot.height % 2)
    throw InputError(fmt::format("--size {}x{}: expected even numbers of pixels for a clip", shot.width, shot.height));
  if (!on_path("ffmpeg"))
    throw Unsupported("clips need ffmpeg, which is not installed; apt-get install --no-install-recommends ffmpeg");
}

void write_clip(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                const fs::path& file) {
  require_clip(shot);
  const int last = clip_run(scene).samples;
  std::vector<Shot> shots(static_cast<size_t>(last) + 1, shot);
  for (int i = 0; i <= last; ++i) shots[i].at = scene.duration * i / last, shots[i].in_clip = true;
  const CommonView common = common_view(scene, answers, shots);
  render::OffscreenRenderer renderer;
  Video video(file, shot.width, shot.height);
  Progress progress((last + rate - 1) / rate);
  for (int i = 0; i <= last; ++i) {
    if (i % rate == 0 && i < last) progress.begin(fmt::format("second {} of the clip", i / rate + 1));
    const render::Picture picture = picture_of(scene, answers, shots[i], common);
    video.add(render::lettered(picture, render::layout_of(picture), renderer.draw(picture)));
  }
  video.finish();
  progress.done();
}

}  // namespace crosscheck
