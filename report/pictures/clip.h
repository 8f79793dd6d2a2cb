// A run as a clip (H.264 in MP4, by ffmpeg): all methods side by side in one view and one scale, in the scene's time.
#pragma once

#include <filesystem>

#include "report/pictures/scene_picture.h"

namespace crosscheck {

/// A run of the scene with a sample for every frame of a clip: 30 for each second, the start and the end among them.
/// Its step divides the time between two frames.
Run clip_run(const Scene& scene);

/// Throws InputError for mode strip and sizes of odd numbers, Unsupported that names the package without ffmpeg.
void require_clip(const Shot& shot);

/// Writes the results of clip_run() as an MP4; `shot.at` has no meaning. Failed runs stand still and say so. Shows
/// progress. Throws like require_clip(), InputError where nothing can be shown, and std::runtime_error with ffmpeg's
/// words.
void write_clip(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                const std::filesystem::path& file);

}  // namespace crosscheck
