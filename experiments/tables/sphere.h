// The tables of experiment `sphere`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// The behaviour of a particle on a slope: sticks (moves by less than 1 mm), slides (Coulomb's distance), or neither.
enum class ContactState { sticks, slides, neither };
constexpr std::string_view name_of(ContactState state) {
  return state == ContactState::sticks ? "sticks" : state == ContactState::slides ? "slides" : "neither";
}
template <>
struct EnumRange<ContactState> {
  static constexpr ContactState first = ContactState::sticks, last = ContactState::neither;
};

/// A particle dropped on a ball.
struct ReboundRow {
  std::string method;
  Verdict verdict = Verdict::ok;
  std::string reason;
  double step = 0, restitution = 0;
  std::optional<double> rebound = {};
  double by_theory = 0;

  static constexpr std::string_view table = "sphere-rebound";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &ReboundRow::method, "method that was run"),
        column("verdict", "1", &ReboundRow::verdict, "how the run ended"),
        column("reason", "1", &ReboundRow::reason, "why it failed or was refused"),
        column("step", "s", &ReboundRow::step, "time step asked for"),
        column("restitution", "1", &ReboundRow::restitution, "part of its speed that the ball returns"),
        column("rebound", "m", &ReboundRow::rebound, "how high the particle rises again above the contact surface"),
        column("by theory", "m", &ReboundRow::by_theory, "the same by theory");
  };
};

/// A particle that slides off a ball without friction.
struct LeavingRow {
  std::string method;
  Verdict verdict = Verdict::ok;
  std::string reason;
  double step = 0;
  std::optional<double> angle = {};
  double angle_by_theory = 0;
  std::optional<double> speed = {};
  double speed_by_theory = 0;

  static constexpr std::string_view table = "sphere-leaving";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &LeavingRow::method, "method that was run"),
        column("verdict", "1", &LeavingRow::verdict, "how the run ended"),
        column("reason", "1", &LeavingRow::reason, "why it failed or was refused"),
        column("step", "s", &LeavingRow::step, "time step asked for"),
        column("angle", "degrees", &LeavingRow::angle, "angle from the top where the gap first passes 1 mm"),
        column("angle by theory", "degrees", &LeavingRow::angle_by_theory, "the same by theory"),
        column("speed", "m/s", &LeavingRow::speed, "speed there"),
        column("speed by theory", "m/s", &LeavingRow::speed_by_theory, "the same by theory");
  };
};

/// A scene with contact at one step, against its truth.
struct ContactOrderRow {
  std::string probe, method;
  Verdict verdict = Verdict::ok;
  double step = 0;
  std::optional<double> error = {}, order = {};
  std::string truth;
  Tier truth_tier = Tier::exact;
  double truth_bar = 0;

  static constexpr std::string_view table = "sphere-order";
  static constexpr auto columns = [](auto&& column) {
    column("probe", "1", &ContactOrderRow::probe, "scene"),
        column("method", "1", &ContactOrderRow::method, "method that was run"),
        column("verdict", "1", &ContactOrderRow::verdict, "how the run ended"),
        column("step", "s", &ContactOrderRow::step, "time step taken"),
        column("error", "m", &ContactOrderRow::error, "largest RMS distance from the truth"),
        column("order", "1", &ContactOrderRow::order, "slope of the error from twice the step to this one"),
        column("truth", "1", &ContactOrderRow::truth, "how the truth was found"),
        column("truth tier", "1", &ContactOrderRow::truth_tier, "how sure the truth is"),
        column("truth bar", "m", &ContactOrderRow::truth_bar, "error bar of the truth");
  };
};

/// A particle at rest on a slope.
struct ConeRow {
  std::string method;
  Verdict verdict = Verdict::ok;
  std::string reason;
  double step = 0, angle = 0, friction = 0;
  std::optional<double> distance = {};
  double distance_by_theory = 0;
  std::optional<ContactState> state = {};
  ContactState state_by_theory = ContactState::sticks;

  static constexpr std::string_view table = "sphere-cone";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &ConeRow::method, "method that was run"),
        column("verdict", "1", &ConeRow::verdict, "how the run ended"),
        column("reason", "1", &ConeRow::reason, "why it failed or was refused"),
        column("step", "s", &ConeRow::step, "time step asked for"),
        column("angle", "degrees", &ConeRow::angle, "of the slope"),
        column("friction", "1", &ConeRow::friction, "Coulomb's coefficient of friction"),
        column("way", "m", &ConeRow::distance, "way down the slope in 0.5 s"),
        column("way by theory", "m", &ConeRow::distance_by_theory, "the same by Coulomb's law"),
        column("answer", "1", &ConeRow::state, "whether the particle stuck or slid"),
        column("answer by theory", "1", &ConeRow::state_by_theory, "the same by Coulomb's law");
  };
};

/// The final state of a cloth on a ball.
struct DrapeRow {
  std::string scene, method;
  Verdict verdict = Verdict::ok;
  std::string reason;
  double end = 0, step = 0;
  std::optional<double> settled_after = {}, centre_height = {}, moved_aside = {}, clearance = {}, creep = {},
                        contact = {};
  bool contact_inferred = false;
  std::optional<double> asymmetry = {};

  static constexpr std::string_view table = "sphere-drape";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &DrapeRow::scene, "scene"), column("method", "1", &DrapeRow::method, "method that was run"),
        column("verdict", "1", &DrapeRow::verdict, "how the run ended"),
        column("reason", "1", &DrapeRow::reason, "why it failed or was refused"),
        column("end", "s", &DrapeRow::end, "last time reached"),
        column("step", "s", &DrapeRow::step, "time step taken"),
        column("settled after", "s", &DrapeRow::settled_after,
               "when it came to rest: its RMS speed stays below 1 cm/s"),
        column("centre height", "m", &DrapeRow::centre_height, "height of the centre of mass at the end"),
        column("centre moved aside", "m", &DrapeRow::moved_aside, "how far the centre of mass moved sideways"),
        column("clearance", "m", &DrapeRow::clearance,
               "smallest distance from a sphere's contact surface at the end; negative inside"),
        column("creep", "m/s", &DrapeRow::creep, "mean sliding speed of the touching particles at the end"),
        column("contact took", "J", &DrapeRow::contact, "energy lost in contact over the run"),
        column("contact inferred", "1", &DrapeRow::contact_inferred,
               "1 where the engine does not tell what contact took: it is what the balance lacks"),
        column("asymmetry", "m", &DrapeRow::asymmetry,
               "largest distance of a particle from its partner's mirror image at the end");
  };
};

/// The penetration depth of a cloth in a ball.
struct PenetrationRow {
  std::string scene, method;
  Verdict verdict = Verdict::ok;
  double step = 0, radius = 0;
  std::optional<double> particles = {}, triangles = {}, particles_at_end = {}, triangles_at_end = {};

  static constexpr std::string_view table = "sphere-penetration";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &PenetrationRow::scene, "scene"),
        column("method", "1", &PenetrationRow::method, "method that was run"),
        column("verdict", "1", &PenetrationRow::verdict, "how the run ended"),
        column("step", "s", &PenetrationRow::step, "time step taken"),
        column("radius", "m", &PenetrationRow::radius, "smallest contact radius of the scene"),
        column("particles", "%", &PenetrationRow::particles,
               "how deep particles were inside at most, in parts of the radius"),
        column("triangles", "%", &PenetrationRow::triangles,
               "how deep triangles were inside at most, in parts of the radius"),
        column("particles at end", "%", &PenetrationRow::particles_at_end, "the same of particles at the end"),
        column("triangles at end", "%", &PenetrationRow::triangles_at_end, "the same of triangles at the end");
  };
};

/// The same cloth over time.
struct DrapeTimeRow {
  std::string method;
  double step = 0, t = 0, centre_height = 0, moved_aside = 0;
  std::optional<double> clearance = {}, triangles_inside = {}, creep = {}, asymmetry = {};

  static constexpr std::string_view table = "SCENE-drape";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &DrapeTimeRow::method, "method that was run"),
        column("step", "s", &DrapeTimeRow::step, "time step taken"),
        column("t", "s", &DrapeTimeRow::t, "time of the sample"),
        column("centre height", "m", &DrapeTimeRow::centre_height, "height of the centre of mass"),
        column("centre moved aside", "m", &DrapeTimeRow::moved_aside, "how far the centre of mass moved sideways"),
        column("clearance", "m", &DrapeTimeRow::clearance,
               "smallest distance from a sphere's contact surface; negative inside"),
        column("triangles inside", "m", &DrapeTimeRow::triangles_inside,
               "how deep the deepest point of a triangle is inside; negative outside"),
        column("creep", "m/s", &DrapeTimeRow::creep, "mean sliding speed of the touching particles"),
        column("asymmetry", "m", &DrapeTimeRow::asymmetry,
               "largest distance of a particle from its partner's mirror image");
  };
};

}  // namespace crosscheck
