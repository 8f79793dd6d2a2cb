#include "report/regress/failure_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/metrics.h"
#include "mysim/files.h"
#include "report/figure.h"
#include "report/findings_text.h"
#include "report/pictures.h"
#include "report/provenance.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;

const MethodStyle old_style{"#5b6670", "2", 6}, new_style{"#d55e00", "1", 7}, tolerance_style{"#009e73", "3", 1};

FigureWords words_for(const Evidence& e, const std::string& what, const std::string& title, const Provenance& lines) {
  FigureWords words;
  words.name = file_name_of(fmt::format("{} {} {}", e.question.scene.name, e.question.method.name,
                                        e.question.without.empty() ? what : e.question.without + " " + what));
  words.title = fmt::format("{}: {}", e.question.in_words(), title);
  words.caption =
      fmt::format("Scene {} ({}), commit {}.", e.question.scene.name, e.question.hash, value_of(lines, "commit"));
  words.finding = parting_in_words(e);
  return words;
}

std::optional<Figure> curves(const Evidence& e, const Provenance& lines) {
  Figure f;
  static_cast<FigureWords&>(f) = words_for(e, "curve", "how far the particles are from their start", lines);
  f.x = {"t / s"};
  f.y = {"RMS distance from the start / m"};
  if (!e.was.empty()) f.curves.push_back({"was", old_style, e.was, e.was_at_samples, !e.was_at_samples});
  if (!e.is.empty()) f.curves.push_back({"is", new_style, e.is});
  const auto finite = [](const Curve& c) {
    return std::all_of(c.points.begin(), c.points.end(), [](const auto& p) { return std::isfinite(p.second); });
  };
  if (f.curves.empty() || !std::all_of(f.curves.begin(), f.curves.end(), finite)) return std::nullopt;
  return f;
}

std::optional<Figure> difference(const Evidence& e, const Provenance& lines) {
  double least = INFINITY;
  for (const auto& [t, tolerance] : e.tolerance)
    if (tolerance > 0) least = std::min(least, tolerance);
  if (e.apart.empty() || !std::isfinite(least)) return std::nullopt;
  const double floor = least / 10;
  const auto above_floor = [floor](Series series) {
    for (auto& [t, value] : series) value = std::max(value, floor);
    return series;
  };
  Figure f;
  static_cast<FigureWords&>(f) = words_for(e, "difference", "how far is and was are apart", lines);
  f.x = {"t / s"};
  f.y = {e.was_at_samples ? "RMS distance / m" : "difference of places / m", true};
  f.curves.push_back({"difference", new_style, above_floor(e.apart), true, !e.was_at_samples});
  f.curves.push_back({"tolerance", tolerance_style, above_floor(e.tolerance)});
  f.caption += fmt::format(" Drawn no lower than {}, a tenth of the smallest tolerance.", nice_length(floor));
  if (!e.was_at_samples) f.caption += " A baseline holds places along drawn directions at these times.";
  return f;
}

/// Both shapes in one view, coloured by their distance where an eye could see it.
std::optional<PageImage> shapes(const Evidence& e, const fs::path& folder) {
  if (!e.new_answer || e.new_answer->trajectory.x.empty() || e.question.scene.model.first_order()) return std::nullopt;
  Shot shot;
  shot.quality = render::Quality::fast;
  shot.width = 1120, shot.height = 420;
  std::vector<const Answer*> shown;
  if (e.old_answer) {
    shown.push_back(&*e.old_answer);
    shot.at = std::min(e.old_answer->trajectory.t.back(), e.new_answer->trajectory.t.back());
    const Points &was = e.old_answer->trajectory.x.back(), &is = e.new_answer->trajectory.x.back();
    if (rms_distance(was, is) > 1e-4 * e.question.scene.size()) shot.mode = Mode::difference;
  }
  shown.push_back(&*e.new_answer);
  PageImage image;
  image.file = folder / (words_for(e, "shape", "", {}).name + ".png");
  render::write_png(picture_of(e.question.scene, shown, shot), image.file);
  image.alt = e.old_answer ? "the last shape as it was and as it is" : "the last shape as it is";
  image.caption = e.old_answer ? "The last shape as it was and as it is."
                               : "The last shape as it is. Of the old run no shape is kept (a baseline has that of the "
                                 "scene's own method; with --against both are drawn).";
  return image;
}

}  // namespace

std::string parting_in_words(const Evidence& e) {
  if (e.first_part) {
    const auto before = std::find_if(e.apart.rbegin(), e.apart.rend(),
                                     [&](const auto& at) { return at.first < *e.first_part * (1 - 1e-9); });
    return fmt::format("They part by more than the tolerance between {:.4g} s and {:.4g} s.",
                       before == e.apart.rend() ? 0 : before->first, *e.first_part);
  }
  return e.apart.empty() ? "There is no common time at which places could be compared."
                         : "Places stay within their tolerance; what moved is in the table.";
}

std::vector<PageImage> failure_figures(const Evidence& e, const Provenance& lines, const fs::path& out,
                                       std::vector<std::string>& problems) {
  const fs::path folder = out / "figures";
  std::vector<PageImage> images;
  for (const auto& figure : {curves(e, lines), difference(e, lines)}) {
    if (!figure) continue;
    try {
      draw(drawing_of(*figure), lines, folder);
      images.push_back({folder / (figure->name + ".svg"), figure->finding, figure->caption});
    } catch (const std::runtime_error& error) {
      problems.push_back(error.what());
    }
  }
  try {
    if (auto image = shapes(e, folder)) images.push_back(*image);
  } catch (const std::exception& error) {
    problems.push_back(fmt::format("picture of {}: {}", e.question.in_words(), error.what()));
  }
  return images;
}

}  // namespace crosscheck
