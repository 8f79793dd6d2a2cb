// Tables about balls keep the names that they had in the reports of older versions.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A particle on a slope sticks (hardly moves), slides (by Coulomb's distance), or does neither.
enum class ContactState { sticks, slides, neither };
constexpr std::string_view name_of(ContactState state) {
  return state == ContactState::sticks ? "sticks" : state == ContactState::slides ? "slides" : "neither";
}
template <>
inline constexpr std::pair range_of<ContactState>{ContactState::sticks, ContactState::neither};

struct ReboundRow {
  TABLE("sphere-rebound");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(std::string, reason, "reason", "1", "why the run failed or was refused");
  COLUMN(double, step, "step", "s", "requested time step");
  COLUMN(double, restitution, "restitution", "1", "coefficient of restitution of the ball");
  COLUMN(OptionalNumber, rebound, "rebound", "m", "height of the rebound above the contact surface");
  COLUMN(double, by_theory, "by theory", "m", "height of the rebound by theory");
};

struct LeavingRow {
  TABLE("sphere-leaving");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(std::string, reason, "reason", "1", "why the run failed or was refused");
  COLUMN(double, step, "step", "s", "requested time step");
  COLUMN(OptionalNumber, angle, "angle", "degrees", "angle from the top at which the gap first exceeds 1 mm");
  COLUMN(double, angle_by_theory, "angle by theory", "degrees", "that angle by theory");
  COLUMN(OptionalNumber, speed, "speed", "m/s", "speed at that angle");
  COLUMN(double, speed_by_theory, "speed by theory", "m/s", "that speed by theory");
};

struct ContactOrderRow {
  TABLE("sphere-order");
  COLUMN(std::string, probe, "probe", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(OptionalNumber, error, "error", "m", "largest RMS distance from the truth");
  COLUMN(OptionalNumber, order, "order", "1", "slope of the error from twice the step to this one");
  COLUMN(std::string, truth, "truth", "1", "origin of the truth");
  COLUMN(Tier, truth_tier, "truth tier", "1", "tier of the truth");
  COLUMN(double, truth_bar, "truth bar", "m", "error bar of the truth");
};

struct ConeRow {
  TABLE("sphere-cone");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(std::string, reason, "reason", "1", "why the run failed or was refused");
  COLUMN(double, step, "step", "s", "requested time step");
  COLUMN(double, angle, "angle", "degrees", "angle of the slope");
  COLUMN(double, friction, "friction", "1", "Coulomb's coefficient of friction");
  COLUMN(OptionalNumber, distance, "way", "m", "distance travelled down the slope in 0.5 s");
  COLUMN(double, distance_by_theory, "way by theory", "m", "that distance by Coulomb's law");
  COLUMN(std::optional<ContactState>, state, "answer", "1", "whether the particle stuck or slid");
  COLUMN(ContactState, state_by_theory, "answer by theory", "1", "that answer by Coulomb's law");
};

/// A particle on a sloping plane. The friction coefficients next to the limit differ from it by a thousandth.
struct PlaneConeRow : ConeRow {
  static constexpr std::string_view table = "plane-cone";
};

/// Motions on planes that have a closed form. Each is characterised by a dimensionless number.
enum class PlaneProbe { apex, period, loss, held };
constexpr std::string_view name_of(PlaneProbe probe) {
  return probe == PlaneProbe::apex     ? "height of the third apex over that of the drop"
         : probe == PlaneProbe::period ? "period between two walls over 2 L / v"
         : probe == PlaneProbe::loss   ? "energy lost at rest on a slope over that of a free slide"
                                       : "part of the steps at rest on a floor";
}
template <>
inline constexpr std::pair range_of<PlaneProbe>{PlaneProbe::apex, PlaneProbe::held};

struct PlaneProbeRow {
  TABLE("plane-probes");
  COLUMN(PlaneProbe, probe, "probe", "1", "measured quantity");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(std::string, reason, "reason", "1", "why the run failed or was refused");
  COLUMN(double, step, "step", "s", "requested time step");
  COLUMN(OptionalNumber, measured, "measured", "1", "value from the run");
  COLUMN(double, by_theory, "by theory", "1", "value from the closed form");
};

struct DrapeRow {
  TABLE("sphere-drape");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(std::string, reason, "reason", "1", "why the run failed or was refused");
  COLUMN(double, end, "end", "s", "last time reached");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(OptionalNumber, settled_after, "settled after", "s", "time after which the RMS speed stays below 1 cm/s");
  COLUMN(OptionalNumber, centre_height, "centre height", "m", "height of the centre of mass at the end");
  COLUMN(OptionalNumber, moved_aside, "centre moved aside", "m", "horizontal displacement of the centre of mass");
  COLUMN(OptionalNumber, clearance, "clearance", "m",
         "smallest distance from a sphere's contact surface at the end; negative inside");
  COLUMN(OptionalNumber, creep, "creep", "m/s", "mean sliding speed of the touching particles at the end");
  COLUMN(OptionalNumber, contact, "contact took", "J", "energy lost in contact over the run");
  COLUMN(bool, contact_inferred, "contact inferred", "1",
         "1 if the engine does not report the energy lost in contact, which is then inferred from the energy balance");
  COLUMN(OptionalNumber, asymmetry, "asymmetry", "m",
         "largest distance of a particle from its partner's mirror image at the end");
};

struct PenetrationRow {
  TABLE("sphere-penetration");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(double, radius, "radius", "m", "smallest contact radius of the scene");
  COLUMN(OptionalNumber, particles, "particles", "%",
         "largest penetration depth of a particle, relative to the radius");
  COLUMN(OptionalNumber, triangles, "triangles", "%",
         "largest penetration depth of a triangle, relative to the radius");
  COLUMN(OptionalNumber, particles_at_end, "particles at end", "%",
         "penetration depth of particles at the end, relative to the radius");
  COLUMN(OptionalNumber, triangles_at_end, "triangles at end", "%",
         "penetration depth of triangles at the end, relative to the radius");
};

struct DrapeTimeRow {
  TABLE("SCENE-drape");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(double, t, "t", "s", "time of the sample");
  COLUMN(double, centre_height, "centre height", "m", "height of the centre of mass");
  COLUMN(double, moved_aside, "centre moved aside", "m", "horizontal displacement of the centre of mass");
  COLUMN(OptionalNumber, clearance, "clearance", "m",
         "smallest distance from a sphere's contact surface; negative inside");
  COLUMN(OptionalNumber, triangles_inside, "triangles inside", "m",
         "penetration depth of the deepest point of a triangle; negative outside");
  COLUMN(OptionalNumber, creep, "creep", "m/s", "mean sliding speed of the touching particles");
  COLUMN(OptionalNumber, asymmetry, "asymmetry", "m", "largest distance of a particle from its partner's mirror image");
};

}  // namespace crosscheck
