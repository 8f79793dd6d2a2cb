// The user's font settings affect results only through the choice of the font files for DejaVu Sans.
#include "report/pictures/lettering.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "mysim/base/names.h"
#include "mysim/base/text.h"
#include "report/pictures/colour.h"

namespace crosscheck::render {
namespace {

struct Release {
  void operator()(cairo_t* c) const { cairo_destroy(c); }
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  void operator()(cairo_pattern_t* p) const { cairo_pattern_destroy(p); }
  void operator()(cairo_font_options_t* o) const { cairo_font_options_destroy(o); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("Cairo: {}", cairo_status_to_string(status)));
}

Owned<cairo_surface_t> surface_of(const Image& image) {
  Owned<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
  check(cairo_surface_status(surface.get()));
  auto* to = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(surface.get()));
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    *to++ = std::uint32_t(image.rgb[i] << 16 | image.rgb[i + 1] << 8 | image.rgb[i + 2]);
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

/// Draws text, boxes and lines at positions in pixels from the top left.
class Page {
 public:
  explicit Page(cairo_surface_t* surface)
      : cairo_(cairo_create(surface)), letters_stay_(cairo_surface_get_type(surface) == CAIRO_SURFACE_TYPE_PDF) {
    const Owned<cairo_font_options_t> options(cairo_font_options_create());
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(cairo_.get(), options.get());
  }

  /// Width in units of the font size.
  double width(const std::string& text, bool bold) {
    cairo_text_extents_t extents;
    set_font(bold, 100);
    cairo_text_extents(cairo_.get(), printable(text).c_str(), &extents);
    return extents.x_advance / 100;
  }
  /// The centre of the first line is at height y. Lines begin at x if `before` is 0, and are centred at x if
  /// `before` is 0.5. `size` is in pixels.
  void label(double x, double y, double before, const std::string& text, double size, bool bold, unsigned colour) {
    for (const std::string& line : split(text, '\n')) {
      const double start = x - before * size * width(line, bold);
      set_font(bold, size), set_ink(colour);
      cairo_move_to(cairo_.get(), start, y + 0.35 * size);
      if (letters_stay_)
        cairo_show_text(cairo_.get(), printable(line).c_str());
      else  // draw outlines, because glyph positions would be rounded to pixels
        cairo_text_path(cairo_.get(), printable(line).c_str()), cairo_fill(cairo_.get());
      y += line_height * size;
    }
  }
  void box(double left, double top, double width, double height, unsigned colour) {
    set_ink(colour);
    cairo_rectangle(cairo_.get(), left, top, width, height);
    cairo_fill(cairo_.get());
  }
  void stroke(double x0, double y0, double x1, double y1, unsigned colour) {
    set_ink(colour);
    cairo_set_line_width(cairo_.get(), 0.8);
    cairo_move_to(cairo_.get(), x0, y0), cairo_line_to(cairo_.get(), x1, y1);
    cairo_stroke(cairo_.get());
  }
  void gradient(double left, double top, double width, double height) {
    const Owned<cairo_pattern_t> colours(cairo_pattern_create_linear(left, 0, left + width, 0));
    for (int i = 0; i <= 24; ++i) {  // four pieces per interval of the colour scale
      const Colour c = scale_colour(float(i) / 24);
      cairo_pattern_add_color_stop_rgb(colours.get(), i / 24.0, c.x(), c.y(), c.z());
    }
    cairo_set_source(cairo_.get(), colours.get());
    cairo_rectangle(cairo_.get(), left, top, width, height);
    cairo_fill(cairo_.get());
  }
  cairo_t* cairo() const { return cairo_.get(); }

 private:
  void set_font(bool bold, double size) {
    cairo_select_font_face(cairo_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_.get(), size);
  }
  void set_ink(unsigned colour) {
    const Colour c = from_hex(colour);
    cairo_set_source_rgb(cairo_.get(), c.x(), c.y(), c.z());
  }

  Owned<cairo_t> cairo_;
  bool letters_stay_;
};

constexpr unsigned title_ink = 0x111111, ink = 0x333333, subtitle_ink = 0x666666, edge = 0x777777;

void add_titles(Page& page, const Picture& picture, const Layout& layout) {
  for (std::size_t r = 0; r < picture.rows.size(); ++r) {
    const auto& row = picture.rows[r];
    for (std::size_t c = 0; c < row.size(); ++c) {
      const double left = layout.left + double(c) * layout.panel_width, middle = left + 0.5 * layout.panel_width;
      const double above = line_height * layout.title * double(std::ranges::count(row[c].title, '\n'));
      const bool heads_row = is_strip(row) && c == 0;
      page.label(heads_row ? left + 0.8 * layout.text : middle, layout.title_y[r] - above, heads_row ? 0 : 0.5,
                 row[c].title, layout.title, true, title_ink);
      page.label(middle, layout.subtitle_y[r], 0.5, row[c].subtitle, layout.subtitle, false, subtitle_ink);
    }
  }
}

void add_legend(Page& page, const Picture& picture, const Layout& layout) {
  const double font = layout.legend, y = layout.legend_y;
  double x = 0.5 * (picture.width - layout.legend_width * font) + 0.6 * font;
  for (std::size_t i = 0; i < picture.legend.size(); ++i) {
    page.box(x, y - 0.28 * font, 1.5 * font, 0.56 * font, palette_hex(int(i)));
    page.label(x + 2.0 * font, y, 0, picture.legend[i], font, false, ink);
    x += legend_entry_width(picture.legend[i]) * font;
  }
}

/// Distance between ticks: 1, 2 or 5 times a power of ten, so that there are about five intervals.
double tick_step(double span) {
  const double rough = span / 5, power = std::pow(10, std::floor(std::log10(rough)));
  const double ratio = rough / power;
  return power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
}

void add_bar(Page& page, const Scale& scale, const Layout& layout) {
  const double font = layout.text, top = layout.bar_top, bottom = top + layout.bar_height;
  const double left = layout.bar_left, right = left + layout.bar_width;
  page.gradient(left, top, layout.bar_width, layout.bar_height);
  for (const double y : {top, bottom}) page.stroke(left, y, right, y, edge);
  for (const double x : {left, right}) page.stroke(x, top, x, bottom, edge);
  page.label((left + right) / 2, bottom + 2.25 * font, 0.5, scale.label, font, false, title_ink);

  if (!(scale.high > 0) || !std::isfinite(scale.high)) return;
  const double step = tick_step(scale.high);
  for (int i = 0; i * step <= scale.high * (1 + 1e-6); ++i) {
    const double x = left + layout.bar_width * std::min(i * step / scale.high, 1.0);
    page.stroke(x, bottom, x, bottom + 0.3 * font, edge);
    page.label(x, bottom + 0.95 * font, 0.5, fmt::format("{:.6g}", i * step), 0.92 * font, false, ink);
  }
}

void add_letters(Page& page, const Picture& picture, const Layout& layout) {
  add_titles(page, picture, layout);
  add_legend(page, picture, layout);
  if (picture.scale) add_bar(page, *picture.scale, layout);
  check(cairo_status(page.cairo()));
}

}  // namespace

double text_width(const std::string& text, bool bold) {
  const Owned<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  return Page(surface.get()).width(text, bold);
}

Image lettered(const Picture& picture, const Layout& layout, const Image& image) {
  const Owned<cairo_surface_t> surface = surface_of(image);
  Page page(surface.get());
  add_letters(page, picture, layout);
  cairo_surface_flush(surface.get());
  Image out{image.width, image.height, {}};
  out.rgb.reserve(image.rgb.size());
  const auto* from = reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface.get()));
  for (int i = 0; i < image.width * image.height; ++i)
    for (const unsigned shift : {16u, 8u, 0u}) out.rgb.push_back(static_cast<unsigned char>(from[i] >> shift));
  return out;
}

std::string pdf_page(const Picture& picture, const Layout& layout, const Image& image, double pixels_per_inch) {
  std::string bytes;
  const auto append = [](void* to, const unsigned char* data, unsigned size) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), size);
    return CAIRO_STATUS_SUCCESS;
  };
  const double points = 72 / pixels_per_inch;  // size of a pixel
  const Owned<cairo_surface_t> surface(
      cairo_pdf_surface_create_for_stream(append, &bytes, points * image.width, points * image.height));
  // a fixed date, because two runs must write the same bytes
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
  {
    Page page(surface.get());
    cairo_scale(page.cairo(), points, points);
    const Owned<cairo_surface_t> pixels = surface_of(image);
    cairo_set_source_surface(page.cairo(), pixels.get(), 0, 0);
    cairo_paint(page.cairo());
    add_letters(page, picture, layout);
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace crosscheck::render
