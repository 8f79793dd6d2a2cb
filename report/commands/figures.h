// What a set of figures is to hold: the charts of experiments, and pictures of scenes.
#pragma once

#include "experiments/experiment.h"
#include "report/commands/commands.h"

namespace crosscheck {

struct PictureRequest {
  Scene scene;
  std::string given;  // the scene's name or file, as somebody typed it
};

struct FigureSelection {
  std::vector<const Experiment*> experiments;
  std::vector<PictureRequest> pictures;
};

/// Names are experiments, or SCENE-picture of a scene that --scene names or that comes with Crosscheck; no names are
/// all experiments, and pictures of the named scenes or of those that stand for the others. Throws InputError that
/// lists what there is.
FigureSelection select_figures(const FiguresOptions& options);

}  // namespace crosscheck
