// Figures fit to print: sizes in centimetres, captions for LaTeX, the catalogue, and renders as figures.
#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <span>

#include "report/figures/charts.h"
#include "report/figures/figure.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {

/// "paper" (8.5 cm, 7.5 pt, no titles) or "lecture" (24 cm, 20 pt); `width` as "8.5cm", "85mm" or "3.3in", or empty:
/// the set's own. Throws InputError that says what was expected.
FigureSize figure_size(const std::string& set, const std::string& width);

/// Text for LaTeX: its special characters escaped, Greek letters and signs in mathematics.
std::string latex(const std::string& text);

/// Gives the chart's figure a size; false where it has none.
bool resize(Chart& chart, const FigureSize& size);

/// NAME.txt and NAME.tex next to the files of a figure: caption as text, and a figure environment.
void write_captions(const FigureInfo& figure, const std::filesystem::path& folder);

inline constexpr std::array chart_endings = {"pdf", "svg", "png", "csv", "gp", "txt", "tex"};
inline constexpr std::array picture_endings = {"pdf", "png", "csv", "txt", "tex"};

struct FigureInSet {
  FigureInfo words;
  std::string scene;                   // that it is of, or empty
  std::span<const char* const> files;  // the endings of its files
};

/// figures.json: what each figure shows, on what it rests and how large it is; CITATION.cff: how to cite their program.
void write_catalogue(const std::vector<FigureInSet>& figures, const Provenance& provenance,
                     const std::filesystem::path& folder);

// The render of a scene as a figure in print: SCENE-picture.

std::string picture_name(const Scene& scene);

/// A shot of the scene for this width, 300 pixels an inch (fewer above 30 cm), with letters of this size on paper.
Shot shot_for_print(const Scene& scene, const FigureSize& size, bool full);

/// The picture's caption.
FigureInfo picture_info(const Scene& scene, const std::vector<const MethodResult*>& answers, const FigureSize& size,
                        const std::string& commit);

/// NAME.png, NAME.pdf (a page of its size, letters as letters) and NAME.csv, the positions that it shows. Throws as
/// write_png() does.
void write_printed(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                   const FigureInfo& words, const Provenance& provenance, const std::filesystem::path& folder);

}  // namespace crosscheck
