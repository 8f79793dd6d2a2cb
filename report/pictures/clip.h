// A run as a clip: all methods side by side in one view and one scale, in the scene's own time.
#pragma once

#include <filesystem>

#include "report/pictures/scene_picture.h"

namespace crosscheck {

/// A run of the scene with a sample for every frame of a clip: 30 for each second, the start and the end among them.
/// Its step divides the time between two frames.
Run clip_run(const Scene& scene);

/// Writes the results of clip_run() as an MP4; `shot.at` has no meaning. Failed runs stand still and say so. Shows
/// progress. Throws InputError for mode strip, sizes of odd numbers, and where nothing can be shown; Unsupported
/// without ffmpeg.
void write_clip(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                const std::filesystem::path& file);

/// Whether a clip of this shot is possible: throws as write_clip() does, before any run.
void require_clip(const Shot& shot);

}  // namespace crosscheck
