// Quantities of the known disagreements, in the units of the table's rows, and sentences about their measured size.
#pragma once

#include "experiments/disagreements/disagreements.h"

namespace crosscheck::effects {

double moved(const Scene& scene, const State& s);
double sag(const Scene& scene, const State& s);
double length(const Scene&, const State& s);
double along_wind(const Scene&, const State& s);
double gap(const Scene& scene, const State& s);
double steeper(const Scene& scene, const State& s);
double stretch(const Scene& scene, const State& s);
double second_stretch(const Scene& scene, const State& s);
double lowest(const Scene&, const State& s);
double energy(const Scene& scene, const State& s);

std::string friction_effect(const std::vector<Series>& all);
std::string stiffness_effect(const std::vector<Series>& all);
std::string law_effect(const std::vector<Series>& all);
std::string freeze_effect(const std::vector<Series>& all);
std::string hessian_effect(const std::vector<Series>& all);
std::string rest_effect(const std::vector<Series>& all);
std::string wind_effect(const std::vector<Series>& all);
std::string clamp_effect(const std::vector<Series>& all);
std::string field_effect(const std::vector<Series>& all);
std::string direction_effect(const std::vector<Series>& all);
std::string hop_effect(const std::vector<Series>& all);
std::string precision_effect(const std::vector<Series>& all);
std::string pieces_effect(const std::vector<Series>& all);
std::string one_stiffness_effect(const std::vector<Series>& all);
std::string gravity_factor_effect(const std::vector<Series>& all);
std::string unused_effect(const std::vector<Series>& all);
std::string over_relaxation_effect(const std::vector<Series>& all);
std::string small_effect(const std::vector<Series>& all);
std::string sleeping_effect(const std::vector<Series>& all);

TableWithSentence directions(const Disagreement& d);

void ten_times_stiffer(Scene& scene);
void join(Scene& scene);

}  // namespace crosscheck::effects
