// Raw pixels go to ffmpeg's stdin; letters are copied as whole rows of pixels.
#include "report/pictures/video.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/process.h"
#include "mysim/base/text.h"
#include "report/base/atomic_file.h"
#include "report/pictures/colour.h"
#include "report/pictures/lettering.h"

namespace crosscheck::render {

// No image is kept. One thread and no tags: the same images give the same bytes on
// machines of any number of cores.

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
  AtomicFile output;
  TemporaryFolder messages{"video"};
  std::FILE* ffmpeg = nullptr;
  void (*broken_pipe)(int);  // handler to restore

  Parts(const std::filesystem::path& file_, int width, int height, int rate) : file(file_), output(file) {
    std::string command = "LC_ALL=C.UTF-8 TZ=UTC exec";
    for (const std::string& word : call(output.temporary(), width, height, rate))
      command += " " + shell_single_quote(word);
    command += " > /dev/null 2> " + shell_single_quote((messages.path / "err").string());
    ffmpeg = popen(command.c_str(), "we");
    if (!ffmpeg) throw std::runtime_error("ffmpeg cannot be started");
    broken_pipe = std::signal(SIGPIPE, SIG_IGN);
  }
  ~Parts() { close(); }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  /// Waits for the end of ffmpeg; returns its status as of wait().
  int close() {
    if (!ffmpeg) return 0;
    const int status = pclose(std::exchange(ffmpeg, nullptr));
    std::signal(SIGPIPE, broken_pipe);
    return status;
  }

  void finish() {
    if (const int status = close(); status != 0)
      throw std::runtime_error(fmt::format("ffmpeg (exit code {}) on {}: {}", WEXITSTATUS(status), file.string(),
                                           last_lines(try_read_file(messages.path / "err").value_or(""), 1)));
  }
};

Video::Video(const std::filesystem::path& file, int width, int height, int rate) {
  require_encoder();
  parts_ = std::make_unique<Parts>(file, width, height, rate);
}

Video::~Video() = default;

void Video::add(const Image& image) {
  if (std::fwrite(image.rgb.data(), 1, image.rgb.size(), parts_->ffmpeg) == image.rgb.size()) return;
  parts_->finish();
  throw std::runtime_error("ffmpeg takes no more images for " + parts_->file.string());
}

void Video::finish() {
  parts_->finish();
  parts_->output.finish();
}

namespace {

constexpr int sheet_height = 4096;  // of subtitles that are set at once, pixels

void copy_rows(const Image& from, int row, int count, Image& to, int to_row) {
  const auto width = std::ptrdiff_t(3) * to.width;
  std::copy_n(from.rgb.begin() + row * width, count * width, to.rgb.begin() + to_row * width);
}

Layout common_layout(Picture picture, const std::vector<std::vector<std::string>>& subtitles) {
  Layout common = layout_of(picture);
  for (const auto& texts : subtitles) {
    for (std::size_t c = 0; c < texts.size(); ++c) picture.rows[0][c].subtitle = texts[c];
    common.subtitle = std::min(common.subtitle, layout_of(picture).subtitle);
  }
  return common;
}

}  // namespace

ClipLetters::ClipLetters(const Picture& like, std::vector<std::vector<std::string>> subtitles)
    : layout_(common_layout(like, subtitles)), subtitles_(std::move(subtitles)) {
  band_height_ = int(std::ceil(1.5 * layout_.text));
  band_top_ = layout_.panel_top[0] - band_height_;
  Picture without = like;
  for (Panel& panel : without.rows[0]) panel.subtitle.clear();
  letters_ = blank(like.width, like.height);
  paint_bar(without, layout_, letters_);
  letters_ = lettered(without, layout_, letters_);
}

void ClipLetters::set_subtitles(int from) {
  const auto count = std::min<std::ptrdiff_t>(std::max(1, sheet_height / band_height_), std::ssize(subtitles_) - from);
  bands_ =
      drawn_letters(subtitles_script({subtitles_.begin() + from, subtitles_.begin() + from + count}, layout_,
                                     letters_.width, band_height_, layout_.subtitle_y[0] - band_top_, "picture.png"));
  first_ = from;
}

void ClipLetters::set(int frame, Image& image) {
  if (frame < first_ || first_ + bands_.height / band_height_ <= frame) set_subtitles(frame);
  const int below = layout_.panel_top[0] + layout_.panel_height;
  copy_rows(letters_, 0, layout_.panel_top[0], image, 0);
  copy_rows(letters_, below, image.height - below, image, below);
  copy_rows(bands_, (frame - first_) * band_height_, band_height_, image, band_top_);
}

}  // namespace crosscheck::render
