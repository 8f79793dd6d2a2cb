// Frames are drawn one after the other and go to the encoder at once.
#include "report/pictures/clip.h"

#include <fmt/format.h>

#include <cmath>

#include "mysim/base/errors.h"
#include "mysim/base/process.h"
#include "mysim/base/progress.h"
#include "report/pictures/video.h"

namespace crosscheck {
namespace {

constexpr int rate = 30;  // frames for each second of the scene

}  // namespace

Run clip_run(const Scene& scene) {
  Run run = default_run(scene);
  run.samples = static_cast<int>(std::max(1.0, std::round(rate * scene.duration)));
  return run;
}

void require_clip(const Shot& shot) {
  if (shot.mode == Mode::strip)
    throw InputError("--mode strip: expected shaded, stretch, springs or difference for a clip");
  if (shot.width % 2 || shot.height % 2)
    throw InputError(fmt::format("--size {}x{}: expected even numbers of pixels for a clip", shot.width, shot.height));
  render::require_encoder();
}

void write_clip(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                const std::filesystem::path& file) {
  require_clip(shot);
  const int last = clip_run(scene).samples;
  std::vector<Shot> shots;
  for (int i = 0; i <= last; ++i) {
    shots.push_back(shot);
    shots.back().at = scene.duration * i / last;
    shots.back().in_clip = true;
  }
  const CommonView common = common_view(scene, answers, shots);
  std::vector<std::vector<std::string>> subtitles;
  for (const Shot& s : shots) {
    const render::Picture picture = picture_of(scene, answers, s, common);
    subtitles.emplace_back();
    for (const render::Panel& panel : picture.rows[0]) subtitles.back().push_back(panel.subtitle);
  }
  render::ClipLetters letters(picture_of(scene, answers, shots[0], common), std::move(subtitles));
  render::OffscreenRenderer renderer;
  render::Video video(file, shot.width, shot.height, rate);
  Progress progress((last + rate - 1) / rate);
  for (int i = 0; i <= last; ++i) {
    if (i % rate == 0 && i < last) progress.begin(fmt::format("second {} of the clip", i / rate + 1));
    render::Image image = renderer.draw(picture_of(scene, answers, shots[static_cast<size_t>(i)], common));
    letters.set(i, image);
    video.add(image);
  }
  video.finish();
  progress.done();
}

}  // namespace crosscheck
