// Figures whose letters must find room.
#pragma once

#include "report/figure.h"

namespace crosscheck {

/// Draws as draw() does, but throws Crowded, with no file written, where gnuplot finds no room for the letters.
void draw_if_it_fits(const Drawing& drawing, const Provenance& provenance, const std::filesystem::path& folder);

}  // namespace crosscheck
