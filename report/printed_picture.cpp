// One picture, two forms, and its positions as a table.
#include "report/printed_picture.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mysim/files.h"
#include "report/charts/charts.h"

namespace crosscheck {
namespace {

constexpr double inch = 2.54;  // cm

Table positions(const std::string& name, const Scene& scene, const std::vector<const Answer*>& answers,
                const Shot& shot) {
  Table table{name, {{"method", "1"}, {"t", "s"}, {"particle", "1"}, {"x", "m"}, {"y", "m"}, {"z", "m"}}, {}};
  for (const Answer* a : answers) {
    const int frame = frame_shown(scene, *a, shot);
    const Points& x = a->trajectory.x[frame];
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      table.add({a->method, a->trajectory.t[frame], static_cast<long>(i), x(0, i), x(1, i), x(2, i)});
  }
  return table;
}

}  // namespace

std::string picture_name(const Scene& scene) { return file_name_of(scene.name) + "-picture"; }

double pixels_per_inch(const FigureSize& size) {
  // a poster is seen from afar, and more pixels take minutes
  return std::min(300.0, 300 * 30 / size.width);
}

Shot shot_for_print(const Scene& scene, const FigureSize& size, bool full) {
  Shot shot = usual_shot(scene, full);
  shot.width = static_cast<int>(std::lround(pixels_per_inch(size) * size.width / inch));
  shot.text = pixels_per_inch(size) * size.font / 72;
  return shot;
}

FigureWords words_of_picture(const Scene& scene, const std::vector<const Answer*>& answers, const FigureSize& size,
                             const std::string& commit) {
  std::vector<std::string> shown, failed;
  for (const Answer* a : answers) {
    shown.push_back(a->method);
    if (a->outcome.verdict != Verdict::ok)
      failed.push_back(fmt::format("{} {} at {:.3g} s", a->method,
                                   failure_word(std::string(name_of(a->outcome.verdict))), a->outcome.end));
  }
  FigureWords words;
  words.name = picture_name(scene);
  words.title = fmt::format("{} by {}", scene.name, fmt::join(shown, ", "));
  words.finding =
      failed.empty() ? "All of them come to the end of the run." : fmt::format("{}.", fmt::join(failed, "; "));
  words.caption = fmt::format("Side by side in one camera, true sizes; {}. {}",
                              scene.triangles.empty() ? "the line is the path of the last particle"
                                                      : "coloured by the stretch of the structural springs",
                              caption_of(scene, commit));
  words.size = size;
  return words;
}

void write_printed(const Scene& scene, const std::vector<const Answer*>& answers, const Shot& shot,
                   const FigureWords& words, const Provenance& provenance, const std::filesystem::path& folder) {
  write_csv(positions(words.name, scene, answers, shot), provenance, folder);
  render::write_print(picture_of(scene, answers, shot), pixels_per_inch(words.size), folder / (words.name + ".png"),
                      folder / (words.name + ".pdf"));
}

}  // namespace crosscheck
