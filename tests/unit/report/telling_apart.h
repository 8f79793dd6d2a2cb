// Checks in gnuplot scripts that elements of a figure can be distinguished in grey and with colour blindness.
#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace crosscheck::testing_tools {

using Rgb = Eigen::Vector3d;  // linear light, 0..1

/// Converts sRGB to linear light (IEC 61966-2-1).
inline Rgb linear_light(const std::string& hex) {
  Rgb out;
  for (int i = 0; i < 3; ++i) {
    const double part = std::stoi(hex.substr(static_cast<size_t>(1 + 2 * i), 2), nullptr, 16) / 255.;
    out[i] = part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  }
  return out;
}

/// CIE L*, a*, b* under D65.
inline Eigen::Vector3d lab(const Rgb& rgb) {
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920, 0.9503041;
  const Eigen::Vector3d white(0.95047, 1, 1.08883), xyz = (to_xyz * rgb.cwiseMax(0).cwiseMin(1)).cwiseQuotient(white);
  const auto f = [](double t) { return t > 216. / 24389 ? std::cbrt(t) : t * 841 / 108 + 4. / 29; };
  return {116 * f(xyz[1]) - 16, 500 * (f(xyz[0]) - f(xyz[1])), 200 * (f(xyz[1]) - f(xyz[2]))};
}

/// Protanopia, deuteranopia and tritanopia in linear light (Machado, Oliveira, Fernandes 2009, table 1, severity 1).
inline std::vector<Eigen::Matrix3d> colour_blindness() {
  std::vector<Eigen::Matrix3d> all(3);
  all[0] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  all[1] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  all[2] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return all;
}

/// Difference in lightness (CIE L*, 0 to 100).
inline double lightness_apart(const std::string& a, const std::string& b) {
  return std::abs(lab(linear_light(a))[0] - lab(linear_light(b))[0]);
}
/// Smallest colour difference (CIE 1976) under the three kinds of colour blindness.
inline double colour_apart(const std::string& a, const std::string& b) {
  double least = 1e300;
  for (const Eigen::Matrix3d& m : colour_blindness())
    least = std::min(least, (lab(m * linear_light(a)) - lab(m * linear_light(b))).norm());
  return least;
}

// A difference of 2.3 is just noticeable between adjacent patches (Mahy et al. 1994); separate patches and marks need
// three to four times as much.
inline constexpr double least_lightness = 8, least_colour = 10;

/// Appearance of all data rows that have the same name.
struct Look {
  std::set<std::string> colours, dashes, marks, fills;
  std::string key;  // mark that identifies the method to which these crosses belong
};

/// True if both dashes have the same number of strokes per period, and their longest strokes differ by less than a
/// factor of 1.5.
inline bool alike_dashes(const std::string& a, const std::string& b) {
  const auto parts = [](std::string text) {
    std::vector<double> strokes;
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
    std::istringstream in(text);
    for (double stroke, gap; in >> stroke >> gap;) strokes.push_back(stroke);
    return strokes;
  };
  const std::vector<double> p = parts(a), q = parts(b);
  if (p.size() != q.size() || p.empty()) return p.size() == q.size();
  const double longest = *std::ranges::max_element(p), other = *std::ranges::max_element(q);
  return std::max(longest, other) < 1.5 * std::min(longest, other);
}

/// Looks by name. Omits elements in a row or panel that is labelled with their name.
inline std::map<std::string, Look> looks_of(const std::string& script) {
  std::map<std::string, Look> looks;
  std::map<std::string, std::string> signs;  // marks of labels without text, by colour
  const auto first = [](const std::string& text, const std::string& pattern) {
    std::smatch found;
    return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : std::string();
  };
  std::istringstream lines(script);
  bool plotting = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("set label ''"))
      signs[first(line, "lc rgb \"(#[0-9A-F]{6})\"")] = first(line, "point pt (\\d+)");
    if (line.starts_with("plot ")) plotting = true;
    if (!plotting || line.find(" with ") == std::string::npos) continue;
    if (line.find("&& $3 == ") != std::string::npos) continue;  // elements of a row that has a label with their name
    std::string name;
    const std::regex text("eq '([^']*)'");
    for (std::sregex_iterator i(line.begin(), line.end(), text), end; i != end; ++i) name = (*i)[1];
    if (name.empty()) name = first(line, "using (.*) with ");
    const std::string fill = first(line, "fc rgb \"(#[0-9A-F]{6})\""),
                      colour = fill.empty() ? first(line, "lc rgb \"(#[0-9A-F]{6})\"") : fill;
    if (colour == "#FFFFFF" || colour.empty()) continue;  // rings and borders
    Look& look = looks[name];
    look.colours.insert(colour);
    const std::string kind = first(line, " with (\\w+)"), dash = first(line, " dt (\\S+)"),
                      mark = first(line, " pt (\\d+)");
    if (kind.starts_with("lines") || kind == "steps") look.dashes.insert(dash.empty() ? "1" : dash);
    if (!mark.empty()) look.marks.insert(mark);
    if (kind == "boxxyerror") look.fills.insert(first(line, "fs (transparent pattern \\d+|solid)"));
    if (line.find("notitle, \\") == std::string::npos) plotting = false;
  }
  for (auto& [name, look] : looks)
    if (name.starts_with("failed: ") && look.colours.size() == 1)
      if (const auto sign = signs.find(*look.colours.begin()); sign != signs.end()) look.key = sign->second;
  return looks;
}

/// True if two looks differ in more than colour: one is a line and the other a mark or box, or dashes, marks or
/// fillings differ.
inline bool differ_in_form(const Look& a, const Look& b) {
  if (a.dashes.empty() != b.dashes.empty() || a.fills != b.fills || a.marks != b.marks || a.key != b.key) return true;
  return std::ranges::any_of(a.dashes, [&](const std::string& d) {
    return std::ranges::none_of(b.dashes, [&](const std::string& e) { return alike_dashes(d, e); });
  });
}

/// Returns one line for each pair of elements that look alike in grey or with colour blindness.
inline std::string looking_alike(const std::string& script) {
  std::string out;
  const std::map<std::string, Look> looks = looks_of(script);
  for (auto a = looks.begin(); a != looks.end(); ++a)
    for (auto b = looks.begin(); b != a; ++b) {
      // curves of the same colour share a name, such as a method's error and its crosses
      if (a->second.colours == b->second.colours || differ_in_form(a->second, b->second)) continue;
      for (const std::string& p : a->second.colours)
        for (const std::string& q : b->second.colours) {
          const double grey = lightness_apart(p, q), seen = colour_apart(p, q);
          if (grey < least_lightness || seen < least_colour)
            out += fmt::format("'{}' {} and '{}' {}: lightness {:.1f} apart, colour {:.1f}\n", a->first, p, b->first, q,
                               grey, seen);
        }
    }
  return out;
}

/// Applies looking_alike() to all figures in a folder, and counts the figures.
inline std::string looking_alike_in(const std::filesystem::path& folder, int& figures) {
  std::string out;
  figures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".gp" || entry.path().filename() == "style.gp") continue;
    std::ifstream in(entry.path());
    std::stringstream text;
    text << in.rdbuf();
    ++figures;
    if (const std::string found = looking_alike(text.str()); !found.empty())
      out += entry.path().filename().string() + "\n" + found;
  }
  return out;
}

}  // namespace crosscheck::testing_tools
