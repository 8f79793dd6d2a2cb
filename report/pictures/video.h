// A clip that every browser plays (H.264 in MP4, by ffmpeg), and its letters, set once for all frames.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "report/pictures/layout.h"
#include "report/pictures/picture.h"

namespace crosscheck::render {

/// Throws Unsupported that names the package where ffmpeg is absent.
void require_encoder();

class Video {
 public:
  /// Of even numbers of pixels, so many images a second. Throws like require_encoder(), and std::runtime_error where
  /// the file cannot be written.
  Video(const std::filesystem::path& file, int width, int height, int rate);
  ~Video();
  /// Throws std::runtime_error with ffmpeg's words, like finish().
  void add(const Image& image);
  /// Ends the file and gives it its name; without this call there is no file.
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The letters of a clip: set once for all its frames, but for the subtitles, which are set for many frames in one go.

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
