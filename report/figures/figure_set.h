// Print-ready figures: sizes in centimetres, captions for LaTeX, the catalogue, and pictures as figures.
#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <span>

#include "report/figures/charts.h"
#include "report/figures/figure.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {

/// Size for "paper" (8.5 cm, 7.5 pt, no titles) or "lecture" (24 cm, 20 pt). `width`, such as "8.5cm", "85mm" or
/// "3.3in", overrides the set's own. Throws InputError that lists the valid values.
FigureSize figure_size(const std::string& set, const std::string& width);

/// Escapes special characters for LaTeX. Greek letters and symbols become mathematics.
std::string latex(const std::string& text);

/// Returns false if the chart has no figure.
bool resize(Chart& chart, const FigureSize& size);

/// Writes the caption as text (NAME.txt) and as a LaTeX figure environment (NAME.tex).
void write_captions(const FigureInfo& figure, const std::filesystem::path& folder);

inline constexpr std::array chart_endings = {"pdf", "svg", "png", "csv", "gp", "txt", "tex"};
inline constexpr std::array picture_endings = {"pdf", "png", "csv", "txt", "tex"};

struct FigureInSet {
  FigureInfo words;
  std::string scene;
  std::span<const char* const> files;
};

/// Writes figures.json (content, provenance and size of each figure) and CITATION.cff.
void write_catalogue(const std::vector<FigureInSet>& figures, const Provenance& provenance,
                     const std::filesystem::path& folder);

// Name of a scene's picture as a printed figure: SCENE-picture.

std::string picture_name(const Scene& scene);

/// Shot for a figure of this width: its resolution is pixels_per_inch(), and its letters have the figure's font size.
Shot shot_for_print(const Scene& scene, const FigureSize& size, bool full);

FigureInfo picture_info(const Scene& scene, const std::vector<const MethodResult*>& answers, const FigureSize& size,
                        const std::string& commit);

/// Writes NAME.png, NAME.pdf (a page of the picture's size, with selectable text) and NAME.csv with the positions
/// shown. Throws as write_png() does.
void write_printed(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                   const FigureInfo& words, const Provenance& provenance, const std::filesystem::path& folder);

}  // namespace crosscheck
