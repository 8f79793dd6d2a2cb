// The content of a picture, independent of its drawing: panels of bodies in one common view.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mysim/types.h"

namespace crosscheck::render {

/// A solid ball: an obstacle of the scene, drawn at its true radius.
struct Ball {
  Vec3 centre;    // m
  double radius;  // m
};

/// One body: the particles of one method at one instant.
struct Body {
  Points x;                                   // N (3 x n), m
  std::vector<std::array<int, 3>> triangles;  // surface; empty for bodies that are only particles and springs
  std::vector<std::array<int, 2>> threads;    // springs that follow the surface's grid, drawn as fine lines on it
  std::vector<std::array<int, 2>> tubes;      // springs drawn as solid tubes
  std::vector<double> tube_value;             // one per tube: coloured by the scale; empty: plain
  std::vector<int> tube_colour;               // one per tube: index into the palette; empty: plain
  std::vector<double> value;                  // one per particle: coloured by the scale; empty: plain cloth
  std::vector<int> pinned;                    // particles drawn as pins
  double tube_radius = 0;                     // m; 0: chosen from the size of the view
  bool beads = false;                         // particles drawn as balls, sized by the view
  std::vector<Vec3> trail;                    // path of one particle so far, drawn as a thin fading line
};

struct Panel {
  std::string title;     // for example "mysim/leapfrog"; may be empty; title and subtitle may have several lines
  std::string subtitle;  // for example "t = 2.5 s"
  std::vector<Body> bodies;
  std::vector<Ball> balls;
};

/// One camera for all panels, so that they are comparable. Up is +y.
struct View {
  Vec3 eye, target;             // m
  std::optional<double> floor;  // height of the shadow-catching ground, m; empty: no ground
};
inline constexpr double field_of_view = 25;  // degrees, vertical

/// Maps a value to a colour; drawn as a bar below the panels.
struct Scale {
  std::string label;  // "stretch / %"
  double high;        // in the unit of the label; the low end is 0
};

/// Names of the palette entries used by tube_colour, drawn as a legend below the panels.
using Legend = std::vector<std::string>;  // at most 7

enum class Quality { fast, still };

struct Picture {
  std::vector<std::vector<Panel>> rows;  // rows of panels, all of the same size
  View view;
  std::optional<Scale> scale;
  Legend legend;
  int width = 1280, height = 720;  // size of the whole picture, pixels
  double text = 0;                 // height of all letters, pixels; 0: chosen from the size, with larger titles
  Quality quality = Quality::still;
};

/// Pixels, rows from top to bottom, 3 bytes each, sRGB.
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  // 3 * width * height
};

/// Throws std::runtime_error with the file's name.
Image read_png(const std::filesystem::path& file);

/// The bytes of a PNG file, with its resolution if given.
std::string png_bytes(const Image& image, double pixels_per_inch = 0);

/// The bytes of a lossy WebP file, half the size of a PNG with 128 colours: for small pictures on a page.
std::string webp_bytes(const Image& image);

/// Draws the panels off screen, without text. Deterministic. Throws std::runtime_error with the cause.
Image draw(const Picture& picture);

/// Writes the picture with titles, colour bar and legend as PNG. Throws std::runtime_error with the cause (empty
/// picture, file not writable).
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Writes the picture as PNG, and as PDF for a page with this resolution, with text as text.
void write_print(const Picture& picture, double pixels_per_inch, const std::filesystem::path& png,
                 const std::filesystem::path& pdf);

/// Width / height of one panel after the room for text is subtracted: the aspect for fit_view. Depends on the size, the
/// rows, and the presence of titles, subtitles, a scale and a legend, but not on bodies or view.
double panel_aspect(const Picture& picture);

/// Distributes the panels of a picture with one row and a given letter height over as many rows as their titles need at
/// that height, wraps titles and subtitles, and chooses the picture's height.
void arrange(Picture& picture, double aspect);

/// A view with all the given points and balls in its centre, seen from this direction (from the target to the eye, of
/// any length). They fill 70 to 88 % of its width or height, depending on the room for their shadow. Ignores points
/// that are not finite. The ground is slightly below the lowest point.
View fit_view(const std::vector<Points>& points, const std::vector<Ball>& balls, const Vec3& direction, double aspect,
              bool ground = true);

}  // namespace crosscheck::render
