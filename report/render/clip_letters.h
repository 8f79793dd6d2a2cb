// The letters of a clip: set once for all its frames, but for the subtitles, which are set for many frames in one go.
#pragma once

#include <string>
#include <vector>

#include "report/render/layout.h"
#include "report/render/picture.h"

namespace crosscheck::render {

class ClipLetters {
 public:
  /// For pictures of one row that differ from this one in bodies and subtitles only: the subtitles of every panel of
  /// every frame, of one line each. All are set in one size, that of the longest. Throws like write_png.
  ClipLetters(const Picture& like, std::vector<std::vector<std::string>> subtitles);

  /// Puts the letters around the panels of this frame's image. Fastest when frames come in their order.
  void set(int frame, Image& image);

 private:
  void set_subtitles(int from);

  Layout layout_;
  std::vector<std::vector<std::string>> subtitles_;
  Image letters_, bands_;  // around the panels; of the frames from first_ on
  int first_ = 0;
  int band_top_, band_height_;  // of the subtitles in the picture, pixels
};

}  // namespace crosscheck::render
