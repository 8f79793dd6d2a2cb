// Images one after the other as a clip that every browser and every slide program plays: H.264 in MP4, by ffmpeg.
#pragma once

#include <filesystem>
#include <memory>

#include "report/render/picture.h"

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
  /// The file is seen from then on, and not at all without.
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace crosscheck::render
