// The render of a scene as a figure in print: SCENE-picture.
#pragma once

#include <deque>

#include "report/figure.h"
#include "report/pictures.h"

namespace crosscheck {

std::string picture_name(const Scene& scene);

/// A shot of the scene for this width, 300 pixels an inch (fewer above 30 cm), with letters of this size on paper.
Shot shot_for_print(const Scene& scene, const FigureSize& size, bool full);
double pixels_per_inch(const FigureSize& size);

/// What it shows, in words.
FigureWords words_of_picture(const Scene& scene, const std::vector<const Answer*>& answers, const FigureSize& size,
                             const std::string& commit);

/// NAME.png, NAME.pdf (a page of its size, letters as letters) and NAME.csv, the positions that it shows. Throws as
/// write_png() does.
void write_printed(const Scene& scene, const std::vector<const Answer*>& answers, const Shot& shot,
                   const FigureWords& words, const Provenance& provenance, const std::filesystem::path& folder);

}  // namespace crosscheck
