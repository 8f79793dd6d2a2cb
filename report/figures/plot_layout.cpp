#include "report/figures/plot_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "reference/method.h"
#include "report/base/gnuplot.h"
#include "report/figures/charts.h"
#include "report/pictures/layout.h"

namespace crosscheck {

double width_of(const std::string& text) { return letter_height * render::text_width(text, false); }

namespace {

/// "10⁻³", with full-height digits of the font.
std::string power_of_ten(int exponent) {
  static constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) out += digits[static_cast<size_t>(digit - '0')];
  return out;
}

std::string number_text(double value, bool by_power) {
  if (value == 0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  if (!by_power) {
    std::string text = fmt::format("{:.10g}", value);
    if (text.starts_with('-')) text = "−" + text.substr(1);
    return text;
  }
  const std::string digits = fmt::format("{:.4g}", value / std::pow(10, exponent));
  return digits == "1" ? power_of_ten(exponent) : digits + "·" + power_of_ten(exponent);
}

bool is_far(double value) { return value != 0 && (std::abs(value) < 0.9e-4 || std::abs(value) > 1.1e4); }

}  // namespace

std::string tick_text(double value) { return number_text(value, is_far(value)); }

std::vector<Tick> ticks_of(double low, double high, bool logarithmic, double length, bool upright) {
  // tables from other sources may contain any numbers; a range of less than 1e-12 of its values has no distinct ticks
  if (logarithmic ? !std::isfinite(std::log10(low)) || !std::isfinite(std::log10(high))
                  : !std::isfinite(high - low) || !(high - low > 1e-12 * std::max(std::abs(low), std::abs(high))))
    throw std::runtime_error(fmt::format("no axis reaches from {:g} to {:g}", low, high));
  const auto along = [&](double value) {
    return logarithmic ? length * std::log(value / low) / std::log(high / low) : length * (value - low) / (high - low);
  };
  const auto inside = [&](double value) { return along(value) > -1e-6 * length && along(value) < (1 + 1e-6) * length; };
  const auto with_texts = [&](const std::vector<double>& values) {
    bool by_power = false;
    for (const double value : values) by_power |= logarithmic ? is_far(value) : std::abs(value) > 1e5;
    if (!logarithmic && values.size() > 1) by_power |= std::abs(values[1] - values[0]) < 0.9e-4;
    std::vector<Tick> ticks;
    for (const double value : values) ticks.push_back({value, number_text(value, by_power)});
    return ticks;
  };
  const auto fits = [&](const Tick& a, const Tick& b) {
    const double room = upright ? 22 : (width_of(a.text) + width_of(b.text)) / 2 + 9;
    return std::abs(along(b.at) - along(a.at)) >= room;
  };
  const auto all_fit = [&](const std::vector<Tick>& ticks) {
    for (size_t i = 1; i < ticks.size(); ++i)
      if (!fits(ticks[i - 1], ticks[i])) return false;
    return true;
  };
  if (!logarithmic) {
    double step = std::pow(10, std::floor(std::log10(high - low)) - 2);
    for (size_t k = 0;; ++k, step *= k % 3 == 2 ? 2.5 : 2) {  // 1, 2, 5, 10
      std::vector<double> values;
      for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) values.push_back(n * step);
      if (const std::vector<Tick> ticks = with_texts(values); all_fit(ticks)) return ticks;
    }
  }
  const int first = static_cast<int>(std::floor(std::log10(low) - 1e-9)),
            last = static_cast<int>(std::ceil(std::log10(high) + 1e-9));
  const auto at = [&](const std::vector<int>& digits, int stride) {
    std::vector<double> values;
    for (int power = first; power <= last; ++power)
      for (const int digit : digits)
        if (const double value = digit * std::pow(10, power); power % stride == 0 && inside(value))
          values.push_back(value);
    return with_texts(values);
  };
  const double decades = std::log10(high / low);
  std::vector<Tick> ticks = at({1, 2, 5}, 1);
  if (!all_fit(ticks) || decades > 2.5) ticks = at({1, 3}, 1);
  if (decades > 4) ticks = at({1}, 1);
  for (int stride = 1; !all_fit(ticks); ++stride) ticks = at({1}, stride);
  if (ticks.size() < 2)  // one tick label alone shows no scale
    for (const Tick& more : at({1, 2, 3, 5}, 1))
      if (std::ranges::all_of(ticks, [&](const Tick& other) { return fits(other, more); })) ticks.push_back(more);
  if (last - first < 9)
    for (const Tick& small : at({1, 2, 3, 4, 5, 6, 7, 8, 9}, 1))
      if (std::ranges::none_of(ticks, [&](const Tick& t) { return std::abs(t.at / small.at - 1) < 1e-6; }))
        ticks.push_back({small.at, ""});
  return ticks;
}

std::string tick_command(const std::string& letter, const std::vector<Tick>& ticks) {
  std::string out = fmt::format("set {}tics noenhanced (", letter);
  for (size_t i = 0; i < ticks.size(); ++i)
    out += fmt::format("{}{} {:.10g}{}", i ? ", " : "", single_quoted(ticks[i].text), ticks[i].at,
                       ticks[i].text.empty() ? " 1" : "");
  return out + ")\n";
}

std::string ink_of(const std::string& colour) {
  std::array<double, 3> rgb{};
  for (size_t i = 0; i < 3; ++i) rgb[i] = std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.;
  const auto luminance = [&] {
    constexpr std::array weight = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (size_t i = 0; i < 3; ++i)
      sum += weight[i] * (rgb[i] <= 0.04045 ? rgb[i] / 12.92 : std::pow((rgb[i] + 0.055) / 1.055, 2.4));
    return sum;
  };
  while (1.05 / (luminance() + 0.05) < 4.5)  // WCAG's minimum contrast for small letters
    for (double& part : rgb) part *= 0.96;
  return fmt::format("#{:02X}{:02X}{:02X}", std::lround(255 * rgb[0]), std::lround(255 * rgb[1]),
                     std::lround(255 * rgb[2]));
}

std::string Sheet::at(Place p) const { return fmt::format("screen {:.5f},{:.5f}", p.x / wide_, (p.y + up_) / tall_); }

std::string Sheet::text(Place p, const std::string& words, const std::string& align, const std::string& colour,
                        const std::string& more) const {
  return fmt::format("set label {} at {} {} noenhanced front textcolor rgb \"{}\"{}\n", single_quoted(words), at(p),
                     align, colour, more.empty() ? "" : " " + more);
}

std::string Sheet::mark(Place p, const std::string& colour, int marker, double size) const {
  return fmt::format("set label '' at {} front point pt {} ps {} lw 2 lc rgb \"{}\"\n", at(p), marker, size, colour);
}

std::string Sheet::line(Place from, Place to, const std::string& colour, double thick, const std::string& dash) const {
  return fmt::format("set arrow from {} to {} nohead lc rgb \"{}\" lw {} dt {}\n", at(from), at(to), colour, thick,
                     dash);
}

std::string Sheet::box(Rect r, const std::string& colour, const std::string& fill) const {
  return fmt::format("set object rectangle from {} to {} fc rgb \"{}\" fs {} border lc rgb \"{}\"\n",
                     at({r.left, r.bottom}), at({r.right, r.top}), colour, fill, colour);
}

std::string Sheet::margins(const Rect& box) const {
  return fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset bmargin at screen {:.5f}\nset tmargin at screen "
      "{:.5f}\n",
      box.left / wide_, box.right / wide_, (box.bottom + up_) / tall_, (box.top + up_) / tall_);
}

Table checked(Table data) {
  const auto not_finite = [](const Cell& cell) {
    const auto* number = std::get_if<double>(&cell);
    return number && !std::isfinite(*number);
  };
  if (data.rows.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", data.name));
  for (const std::vector<Cell>& row : data.rows)
    if (std::ranges::any_of(row, not_finite))
      throw std::runtime_error(fmt::format("figure {}: a value is not finite", data.name));
  return data;
}

std::string script_head(const FigureInfo& figure) {
  return fmt::format("# {}\n# Draw again: gnuplot {}.gp\nreset\nload \"style.gp\"\n", one_line(figure.title),
                     figure.name);
}

std::string title_command(const Sheet& sheet, const FigureInfo& figure, Place middle) {
  if (!figure.size.titled) return "";
  return sheet.text(middle, shortened(figure.title, 2 * middle.x - 8), "center", "#111111",
                    "font \"DejaVu Sans:Bold,12\"");
}

namespace {

constexpr double sample_width = 26, gap = 14;

double sample_of(const KeyEntry& entry) { return entry.kind == KeyEntry::Kind::line ? sample_width : 12; }

size_t columns_of(const std::vector<KeyEntry>& entries, double wide) {
  double widest = 1;
  for (const KeyEntry& e : entries) widest = std::max(widest, sample_of(e) + 5 + width_of(e.text) + gap);
  return std::clamp<size_t>(static_cast<size_t>((wide + gap) / widest), 1, std::max<size_t>(1, entries.size()));
}

}  // namespace

double key_height(const std::vector<KeyEntry>& entries, double wide) {
  const size_t columns = columns_of(entries, wide);
  return line_of_text * static_cast<double>((entries.size() + columns - 1) / columns);
}

std::string key_commands(const Sheet& sheet, const std::vector<KeyEntry>& entries, Place top_left, double wide) {
  const size_t columns = columns_of(entries, wide), rows = (entries.size() + columns - 1) / columns;
  std::string out;
  double x = top_left.x;
  for (size_t c = 0; c * rows < entries.size(); ++c) {
    double widest = 0;
    for (size_t i = c * rows; i < std::min(entries.size(), (c + 1) * rows); ++i) {
      const KeyEntry& e = entries[i];
      const double y = top_left.y - line_of_text * (static_cast<double>(i - c * rows) + 0.5), sample = sample_of(e);
      if (e.kind == KeyEntry::Kind::box) out += sheet.box({x + 1, x + 11, y - 5, y + 5}, e.style.colour, e.fill);
      if (e.kind == KeyEntry::Kind::line) out += sheet.line({x, y}, {x + sample, y}, e.style.colour, 2, e.style.dash);
      if (e.kind != KeyEntry::Kind::box && e.style.marker > 0)
        out += sheet.mark({x + sample / 2, y}, e.style.colour, e.style.marker);
      const std::string words = shortened(e.text, wide - sample - 5);
      out += sheet.text({x + sample + 5, y}, words, "left", "#222222");
      widest = std::max(widest, sample + 5 + width_of(words));
    }
    x += widest + gap;
  }
  return out;
}

std::string shortened(const std::string& text, double room) {
  if (width_of(text) <= room) return text;
  for (const char* mark : {": ", ", ", " ("})
    if (const size_t at = text.find(mark); at != std::string::npos && at > 2)
      return shortened(text.substr(0, at), room);
  std::string cut = text;
  while (!cut.empty() && width_of(cut) + letter_height > room) {
    do cut.pop_back();
    while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xC0) == 0x80);
    if (!cut.empty() && static_cast<unsigned char>(cut.back()) >= 0xC0) cut.pop_back();
  }
  return cut + "…";
}

std::string method_named(const std::string& title) {
  if (const std::string method = method_in(title); !method.empty()) return method;
  const std::string name = title.substr(0, title.find_first_of(":, "));
  for (const std::string& full : {name, fmt::format("{}/{}", subject().name, name)})
    if (builtin_without_options(full)) return full;
  return "";
}

std::string rule_name(const std::string& method) {
  const size_t plus = method.find('+');
  std::string rule = method.substr(0, plus).substr(method.find('/') + 1);
  // Bullet's worlds are distinguished by their rule; "deformable" is implied
  if (constexpr std::string_view known = "deformable-"; rule.starts_with(known)) rule.erase(0, known.size());
  std::ranges::replace(rule, '-', ' ');
  if (const size_t at = rule.find("euler"); at != std::string::npos) rule[at] = 'E';
  if (rule == "trapezoidal") rule = "Heun";  // the rule's name in the literature
  return plus == std::string::npos ? rule : rule + ", " + method.substr(plus + 1);
}

std::string reader_name(const std::string& title, std::span<const std::string> beside) {
  const std::string method = method_named(title);
  if (method.empty()) return title;
  // omit the text after a colon, such as an order, because paper has little space
  const std::string words = title.substr(0, title.find(": "));
  // programs' names contain a colon
  const size_t end = words.find_first_of(":, ", words.starts_with(method) ? method.size() : 0);
  std::string rest = end == std::string::npos ? "" : words.substr(end);
  // after a method, keep only parentheses and text after a comma
  if (rest.starts_with(' ') && !rest.starts_with(" (")) rest.clear();
  const MethodFamily& family = family_of(method);
  if (family.role == Role::outside) {
    std::vector<std::string> methods;
    for (const std::string& other : beside) methods.push_back(method_named(other));
    return program_title(method, methods) + rest;
  }
  const std::string_view engine = family.variant_of.empty() ? family.title : family.name;
  return (family.is_subject() ? "" : fmt::format("{} ", engine)) + rule_name(method) + rest;
}

namespace {

constexpr double cell_size = 2.5;
constexpr int taken = 1 << 16;

/// Throws std::runtime_error unless the box fits on a sheet; the widest figure, 1 m, has 4000 units.
const Rect& on_a_sheet(const Rect& box) {
  constexpr double largest = 1e5;
  if (!(box.right >= box.left && box.top >= box.bottom && box.right - box.left + box.top - box.bottom < largest))
    throw std::runtime_error("its numbers leave no room for a frame");
  return box;
}

}  // namespace

Board::Board(const Rect& box)
    : box_(on_a_sheet(box)),
      across_(static_cast<size_t>((box.right - box.left) / cell_size) + 1),
      down_(static_cast<size_t>((box.top - box.bottom) / cell_size) + 1),
      cells_(across_ * down_, 0) {}

int Board::column(double x) const {
  return std::clamp(static_cast<int>((x - box_.left) / cell_size), 0, static_cast<int>(across_) - 1);
}
int Board::row(double y) const {
  return std::clamp(static_cast<int>((y - box_.bottom) / cell_size), 0, static_cast<int>(down_) - 1);
}

void Board::add_line(Place from, Place to, bool yields) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (!std::isfinite(length)) return;
  const int pieces = static_cast<int>(std::min(4000., 1 + length / cell_size));
  for (int i = 0; i <= pieces; ++i) {
    const double part = static_cast<double>(i) / pieces, x = from.x + part * (to.x - from.x),
                 y = from.y + part * (to.y - from.y);
    if (x < box_.left || x > box_.right || y < box_.bottom || y > box_.top) continue;
    int& it = cell(x, y);
    if (yields)
      it += it < taken ? 1 : 0;
    else
      it = taken;
  }
}

void Board::add_mark(Place at) { add({at.x - 4, at.x + 4, at.y - 4, at.y + 4}); }

void Board::add(const Rect& r) {
  if (!r.meets(box_)) return;
  for (double x = std::max(r.left, box_.left); x < std::min(r.right, box_.right) + cell_size; x += cell_size)
    for (double y = std::max(r.bottom, box_.bottom); y < std::min(r.top, box_.top) + cell_size; y += cell_size)
      cell(x, y) = taken;
}

std::optional<double> Board::cost(const Rect& text) const {
  if (text.left < box_.left || text.right > box_.right || text.bottom < box_.bottom || text.top > box_.top)
    return std::nullopt;
  double sum = 0;
  for (int r = row(text.bottom); r <= row(text.top); ++r)
    for (int c = column(text.left); c <= column(text.right); ++c) {
      const int it = cells_[static_cast<size_t>(r) * across_ + static_cast<size_t>(c)];
      if (it >= taken) return std::nullopt;
      sum += it > 0;
    }
  return sum;
}

NamedLines::NamedLines(const FigureInfo& figure, const std::string& label, const std::vector<std::string>& titles,
                       double lines, const std::vector<KeyEntry>& key, double right)
    : wide(figure.size.units()), entries(key), words(label) {
  double widest = 0;
  for (const std::string& title : titles)
    widest = std::max(widest, width_of(names.emplace_back(reader_name(title, titles))));
  box = {std::min(0.46 * wide, 12 + widest), wide - right, 36, 36 + 4 + line_of_names * lines};
  below = key_height(entries, wide - 16) + 4;
  tall = below + box.top + (figure.size.titled ? 24 : 6);
}

std::string NamedLines::commands(const FigureInfo& figure, const std::vector<Tick>& ticks) const {
  const Sheet sheet(wide, tall, below);
  const double half = width_of(words) / 2;
  return sheet.margins(box) + "unset key\nunset ytics\nset border 1\n" + tick_command("x", ticks) +
         "set grid xtics noytics\n" +
         sheet.text(
             {std::clamp((box.left + box.right) / 2, std::min(half + 4, wide / 2), std::max(wide - half - 4, wide / 2)),
              box.bottom - 27},
             shortened(words, wide - 8), "center", "#111111") +
         key_commands(sheet, entries, {8, -2}, wide - 16) + title_command(sheet, figure, {wide / 2, box.top + 11});
}

std::string NamedLines::name(double place, size_t index) const {
  return Sheet(wide, tall, below)
      .text({box.left - 6, y_of(place)}, shortened(names[index], box.left - 10), "right", "#222222");
}

std::string NamedLines::heading(double place, const std::string& text) const {
  return Sheet(wide, tall, below)
      .text({6, y_of(place)}, shortened(text, wide - 12), "left", "#111111", "font \"DejaVu Sans:Bold,12\"");
}

std::string NamedLines::y_range(double lines) const {
  return fmt::format("set yrange [{:.4f}:{:.4f}]\n", lines + 0.5 + 2 / line_of_names, 0.5 - 2 / line_of_names);
}

std::string joined_plot(const std::vector<std::string>& parts) {
  std::string out = "plot ";
  for (size_t i = 0; i < parts.size(); ++i) out += (i ? ", \\\n     " : "") + parts[i];
  return out + "\n";
}

}  // namespace crosscheck
