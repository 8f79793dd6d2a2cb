#include <cstdio>

#include "report/commands/command_line.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {
namespace {

struct RenderOptions {
  std::string scene, methods, mode = "shaded", size = "1280x720", quality = "still";
  double at = -1;  // s; negative: the end
  std::filesystem::path file;
};

void read_size(const std::string& text, Shot& shot) {
  int end = 0;
  // 8192 is safely below the renderer's own limit, 16384 pixels per side
  if (std::sscanf(text.c_str(), "%dx%d%n", &shot.width, &shot.height, &end) != 2 ||
      end != static_cast<int>(text.size()) || shot.width < 64 || shot.height < 64 || shot.width > 8192 ||
      shot.height > 8192)
    throw InputError(fmt::format("--size {}: expected WIDTHxHEIGHT in pixels, each from 64 to 8192", text));
}

Shot shot_of(const RenderOptions& options, const Scene& scene) {
  Shot shot;
  shot.mode = mode_named(options.mode);
  shot.at = options.at;
  if (options.at > scene.duration)
    throw InputError(fmt::format("--at {}: expected a time from 0 to {} s", options.at, scene.duration));
  if (options.quality != "fast" && options.quality != "still")
    throw InputError(fmt::format("--quality {}: expected fast or still{}", options.quality,
                                 did_you_mean(options.quality, {"fast", "still"})));
  shot.quality = options.quality == "fast" ? render::Quality::fast : render::Quality::still;
  read_size(options.size, shot);
  return shot;
}

/// Omits methods without a result, and prints the reason.
std::vector<MethodResult> answers_of(const Scene& scene, const std::vector<Method>& methods, const Run& run,
                                     Progress& progress) {
  std::vector<MethodResult> answers;
  for (const Method& method : methods) {
    MethodResult result = recorded_result(with_progress(method, progress), scene, run);
    const bool refused = result.outcome.verdict == Verdict::unsupported;
    if (!refused && result.trajectory.frames() > 0) {
      answers.push_back(std::move(result));
      continue;
    }
    progress.done();
    fmt::print(stderr, "crosscheck: {} {} {}: {}\n", method.name, refused ? "cannot run" : "on", scene.name,
               result.outcome.reason);
  }
  return answers;
}

int render_command(const RenderOptions& options) {
  const Scene scene = load_scene(options.scene, options.methods);
  if (options.file.extension() != ".png")
    throw InputError(fmt::format("-o {}: expected a file name that ends in .png", options.file.string()));
  require_output_file(options.file);
  const Shot shot = shot_of(options, scene);

  std::vector<Method> methods;
  if (options.methods.empty())
    for (const std::string& name : pictured_methods(scene)) methods.push_back(find_method(name));
  else
    methods = find_methods(options.methods);
  const Run run = default_run(scene);
  require_resources_to_keep(methods, scene, run);
  Progress progress(static_cast<int>(methods.size()) + 1);
  const std::vector<MethodResult> answers = answers_of(scene, methods, run, progress);
  progress.done();
  if (answers.empty()) return 1;
  std::vector<const MethodResult*> shown;
  for (const MethodResult& a : answers) shown.push_back(&a);
  progress.begin("drawing " + options.file.string());
  render::write_png(picture_of(scene, shown, shot), options.file);
  progress.done();
  fmt::print("{}\n", options.file.string());
  return 0;
}

}  // namespace

void add_render(CLI::App& app, Invocation& call) {
  auto [render, options] =
      add_command(app, call, "render", "draws a picture of a scene, methods side by side", render_command);
  render.add_option("SCENE", options.scene, "a shipped scene or a TOML file")->required();
  render.add_option("--methods", options.methods, "methods to draw: A,B,...");
  render.add_option("--mode", options.mode, "shaded (default), stretch, springs, difference or strip");
  render.add_option("--at", options.at, "time, s (default: the end)")->transform(time_not_below_zero());
  render.add_option("--quality", options.quality, "fast or still (default)");
  render.add_option("--size", options.size, "WxH in pixels (default: 1280x720)");
  render.add_option("-o", options.file, "FILE.png")->required();
}

}  // namespace crosscheck
