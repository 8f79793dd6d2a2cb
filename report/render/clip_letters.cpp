// All letters stand above and below the panels, so that whole rows of pixels are copied.
#include "report/render/clip_letters.h"

#include <algorithm>
#include <cmath>

#include "report/render/colour.h"
#include "report/render/lettered.h"
#include "report/render/lettering.h"

namespace crosscheck::render {
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
