// Draws a picture, lets gnuplot set the letters, and puts the PNG in its place in one go.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "mysim/temporary_folder.h"
#include "report/render/colour.h"
#include "report/render/layout.h"
#include "report/render/lettering.h"
#include "report/run_program.h"

namespace crosscheck::render {
namespace {

namespace fs = std::filesystem;

/// A file beside the final one, opened before any drawing so that a bad place is known at once.
struct FileInWaiting {
  fs::path final_path, path;
  explicit FileInWaiting(const fs::path& file) : final_path(file) {
    path = file.parent_path() / fmt::format(".{}.{}.tmp", file.filename().string(), getpid());
    const bool nameless = file.filename().empty() || fs::is_directory(file);
    if (nameless || !std::ofstream(path, std::ios::binary)) throw std::runtime_error("cannot write " + file.string());
  }
  ~FileInWaiting() {
    std::error_code ignored;
    if (!path.empty()) fs::remove(path, ignored);
  }
  FileInWaiting(const FileInWaiting&) = delete;
  FileInWaiting& operator=(const FileInWaiting&) = delete;

  void fill_from(const fs::path& source) {
    std::error_code error;
    fs::copy_file(source, path, fs::copy_options::overwrite_existing, error);
    if (!error) fs::rename(path, final_path, error);
    if (error) throw std::runtime_error("cannot write " + final_path.string() + ": " + error.message());
    path.clear();
  }
};

/// Whether anything stands before the ground: the picture is darker somewhere by more than an eye tells apart.
bool shows_something(const Image& image) {
  constexpr int visible = 24;  // of 255; the ground of an empty picture is one colour
  const auto [darkest, brightest] = std::minmax_element(image.rgb.begin(), image.rgb.end());
  return darkest != image.rgb.end() && *brightest - *darkest > visible;
}

/// The colours of the bar, straight from the map that also colours the bodies.
void paint_bar(const Scale& scale, const Layout& layout, Image& image) {
  const int left = int(layout.bar_left), right = int(layout.bar_left + layout.bar_width);
  const int top = int(layout.bar_top), bottom = int(layout.bar_top + layout.bar_height);
  for (int x = left; x < right; ++x) {
    const Colour colour = scale_colour(scale.diverging, (float(x - left) + 0.5f) / float(right - left));
    for (int y = top; y < bottom; ++y) {
      unsigned char* pixel = &image.rgb[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
      for (int channel = 0; channel < 3; ++channel) {
        pixel[channel] = static_cast<unsigned char>(std::lround(255 * colour[channel]));
      }
    }
  }
}

void write(const fs::path& file, const void* data, std::size_t bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(static_cast<const char*>(data), std::streamsize(bytes));
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace

void write_png(const Picture& picture, const fs::path& file) {
  Studio studio;
  write_png(picture, file, studio);
}

void write_png(const Picture& picture, const fs::path& file, Studio& studio) {
  FileInWaiting waiting(file);
  const Layout layout = layout_of(picture);
  Image image = studio.draw(picture);
  if (!shows_something(image))
    throw std::runtime_error(file.stem().string() + ": nothing is to be seen in the picture");
  if (picture.scale) paint_bar(*picture.scale, layout, image);

  const TemporaryFolder folder("render");
  const std::string script = lettering_script(picture, layout, "pixels", "picture.png");
  write(folder.path / "pixels", image.rgb.data(), image.rgb.size());
  write(folder.path / "letters.gp", script.data(), script.size());

  // gnuplot's exit code alone does not tell: a warning on stderr is a failure too
  const ProgramResult result = run_program({"gnuplot", "-d", "letters.gp"}, folder.path);
  if (result.status != 0 || !result.err.empty()) {
    throw std::runtime_error(fmt::format("gnuplot (exit code {}) on {}: {}", result.status, file.string(), result.err));
  }
  waiting.fill_from(folder.path / "picture.png");
}

}  // namespace crosscheck::render
