// Raw pixels go to ffmpeg's stdin; no image is kept. One thread and no tags: the same images give the same bytes on
// machines of any number of cores.
#include "report/render/video.h"

#include <fmt/format.h>

#include <stdexcept>

#include "mysim/errors.h"
#include "report/fed_program.h"
#include "report/render/file_in_waiting.h"

namespace crosscheck::render {
namespace {

std::vector<std::string> call(const std::filesystem::path& file, int width, int height, int rate) {
  const std::string size = fmt::format("{}x{}", width, height), frames = std::to_string(rate);
  return {"ffmpeg", "-nostdin", "-v", "error", "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", size,
          "-framerate", frames, "-i", "pipe:0",
          // colours as players expect them in a file of this kind
          "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-colorspace", "bt709", "-color_primaries", "bt709",
          "-color_trc", "bt709", "-pix_fmt", "yuv420p", "-c:v", "libx264", "-crf", "20", "-threads", "1", "-fflags",
          "+bitexact", "-flags:v", "+bitexact", "-movflags", "+faststart", "-f", "mp4", "-y", "file:" + file.string()};
}

}  // namespace

void require_encoder() {
  if (!on_path("ffmpeg"))
    throw Unsupported("clips need ffmpeg, which is not installed; apt-get install --no-install-recommends ffmpeg");
}

struct Video::Parts {
  std::filesystem::path file;
  FileInWaiting waiting;
  FedProgram ffmpeg;

  Parts(const std::filesystem::path& file_, int width, int height, int rate)
      : file(file_), waiting(file), ffmpeg(call(waiting.temporary(), width, height, rate)) {}

  void finish() {
    const ProgramResult end = ffmpeg.finish();
    if (end.status != 0)
      throw std::runtime_error(
          fmt::format("ffmpeg (exit code {}) on {}: {}", end.status, file.string(), last_lines(end.err, 1)));
  }
};

Video::Video(const std::filesystem::path& file, int width, int height, int rate) {
  require_encoder();
  parts_ = std::make_unique<Parts>(file, width, height, rate);
}

Video::~Video() = default;

void Video::add(const Image& image) {
  if (parts_->ffmpeg.feed(image.rgb.data(), image.rgb.size())) return;
  parts_->finish();
  throw std::runtime_error("ffmpeg takes no more images for " + parts_->file.string());
}

void Video::finish() {
  parts_->finish();
  parts_->waiting.finish();
}

}  // namespace crosscheck::render
