// The content of a picture: panels of bodies in a common view.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mysim/types.h"

namespace crosscheck::render {

/// An obstacle, which is drawn at its true radius.
struct Ball {
  Vec3 centre;    // m
  double radius;  // m
};

/// The particles of one method at one instant.
struct Body {
  Points x;                                   // 3 x n, m
  std::vector<std::array<int, 3>> triangles;  // surface; may be empty
  std::vector<std::array<int, 2>> threads;    // springs on the surface's grid, drawn as fine lines
  std::vector<std::array<int, 2>> tubes;      // springs drawn as tubes
  std::vector<double> tube_value;             // one value per tube, for the scale; empty: plain
  std::vector<int> tube_colour;               // index in the palette for each tube; empty: plain
  std::vector<double> value;                  // one value per particle, for the scale; empty: plain cloth
  std::vector<int> pinned;                    // particles drawn as pins
  double tube_radius = 0;                     // m; 0: derived from the size of the view
  bool beads = false;                         // true: draw particles as balls, sized by the view
  std::vector<Vec3> trail;                    // path of one particle, drawn as a fading line
};

struct Panel {
  std::string title;     // such as "mysim/leapfrog"; titles and subtitles may be empty or have several lines
  std::string subtitle;  // such as "t = 2.5 s"
  std::vector<Body> bodies;
  std::vector<Ball> balls;
};

/// Camera of all panels, so that they are comparable. Up is +y.
struct View {
  Vec3 eye, target;             // m
  std::optional<double> floor;  // height of the ground, m; empty: no ground
};
inline constexpr double field_of_view = 25;  // degrees, vertical

/// Maps values to colours, and is shown as a bar below the panels.
struct Scale {
  std::string label;  // "stretch / %"
  double high;        // in the label's unit; the low end is 0
};

/// Names of the palette entries in tube_colour, shown below the panels.
using Legend = std::vector<std::string>;  // at most 7

enum class Quality { fast, still };

struct Picture {
  std::vector<std::vector<Panel>> rows;  // all panels have the same size
  View view;
  std::optional<Scale> scale;
  Legend legend;
  int width = 1280, height = 720;  // pixels
  double text = 0;                 // height of letters, pixels; 0: derived from the size, with larger titles
  Quality quality = Quality::still;
};

/// Rows of pixels from top to bottom; 3 bytes per pixel, sRGB.
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

/// Reads a PNG. Throws std::runtime_error with the file's name if that fails.
Image read_png(const std::filesystem::path& file);

/// Bytes of a PNG, which states no resolution if `pixels_per_inch` is 0.
std::string png_bytes(const Image& image, double pixels_per_inch = 0);

/// Bytes of a lossy WebP, half the size of a PNG with 128 colours; for small pictures on a page.
std::string webp_bytes(const Image& image);

/// Draws the panels off screen, without text. The result is deterministic. Throws std::runtime_error with the cause.
Image draw(const Picture& picture);

/// Writes a PNG with titles, colour bar and legend. Throws std::runtime_error with the cause (empty picture, file not
/// writable).
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Writes a PNG, and a PDF page of this resolution with selectable text.
void write_print(const Picture& picture, double pixels_per_inch, const std::filesystem::path& png,
                 const std::filesystem::path& pdf);

/// Aspect (width / height) of a panel without the space for text, as fit_view() requires it. Depends on the size, the
/// rows, and the presence of titles, subtitles, a scale and a legend, but not on bodies or view.
double panel_aspect(const Picture& picture);

/// Distributes the panels of a single row over as many rows as their titles need, wraps titles and subtitles, and
/// chooses the picture's height. The height of letters must be given.
void arrange(Picture& picture, double aspect);

/// A view in which all points and balls are centred and fill 70 to 88 % of the width or height, depending on the space
/// that their shadow needs. `direction`: from the target to the eye, of any length. Ignores points that are not finite.
/// The ground is slightly below the lowest point.
View fit_view(const std::vector<Points>& points, const std::vector<Ball>& balls, const Vec3& direction, double aspect,
              bool ground = true);

}  // namespace crosscheck::render
