// A scene and a run as JSON.
#include "reference/protocol/json_fields.h"
#include "reference/protocol/scene_json.h"

namespace crosscheck {
namespace {

Json motion_json(const Motion& motion) {
  return {{"amplitude", json_of(motion.amplitude)}, {"frequency", motion.frequency}, {"ramp", motion.ramp}};
}

Json waves_of(const Gust& gust) {
  Json list = Json::list();
  for (const Gust::Wave& wave : gust.waves)
    list.push({{"weight", wave.weight}, {"omega", wave.omega}, {"phase", wave.phase}});
  return list;
}

void add_blowing(Json& json, const char* key, const Blowing& blowing) {
  json[key] = json_of(blowing.mean);
  if (!blowing.gusts) return;
  const Blowing::Gusts& gusts = *blowing.gusts;
  json["gusts"] = {{"variation", gusts.variation},
                   {"side", json_of(gusts.side)},
                   {"seed", gusts.seed},
                   {"along", waves_of(gusts.along)},
                   {"across", waves_of(gusts.across)}};
}

void add(Json& json, const Rotation& t) { json["rate"] = t.rate; }
void add(Json& json, const Gravity& t) { json["acceleration"] = json_of(t.acceleration); }
void add(Json& json, const Springs& t) {
  json["law"] = name_of(t.law);
  Json& list = json["list"] = Json::list();
  for (const Spring& s : t.list)
    list.push({{"a", s.a}, {"b", s.b}, {"stiffness", s.k}, {"rest_length", s.rest}, {"family", name_of(s.family)}});
}
void add(Json& json, const Dashpots& t) {
  Json& list = json["list"] = Json::list();
  for (const auto& [a, b, c] : t.list) list.push({{"a", a}, {"b", b}, {"coefficient", c}});
}
void add(Json& json, const Constraints& t) {
  Json& list = json["list"] = Json::list();
  for (const auto& [a, b, length] : t.list) list.push({{"a", a}, {"b", b}, {"length", length}});
}
void add(Json& json, const Drag& t) { json["coefficient"] = std::span(t.c.data(), static_cast<size_t>(t.c.size())); }
void add(Json& json, const Wind& t) { add_blowing(json, "acceleration", t.acceleration); }
void add(Json& json, const Aerodynamics& t) {
  json["density"] = t.density;
  json["coefficient"] = t.coefficient;
  add_blowing(json, "velocity", t.velocity);
  json["triangles"] = t.triangles;
}
void add(Json& json, const Spheres& t) {
  Json& list = json["list"] = Json::list();
  for (const Sphere& s : t.list) {
    Json& entry = list.push({{"centre", json_of(s.centre)},
                             {"radius", s.radius},
                             {"margin", s.margin},
                             {"friction", s.friction},
                             {"restitution", s.restitution}});
    if (s.motion) entry["motion"] = motion_json(*s.motion);
  }
}

Json particles_json(const Particles& particles, const State& start, bool first_order) {
  Json json{{"count", particles.size()}};
  if (!first_order) json["mass"] = std::span(particles.mass.data(), static_cast<size_t>(particles.mass.size()));
  json["x"] = json_of(start.x);
  if (first_order) return json;
  json["v"] = json_of(start.v);
  json["pinned"] = Json::list();
  for (char pinned : particles.pinned) json["pinned"].push(pinned);
  return json;
}

Json pins_json(const Particles& particles, const std::vector<double>& times) {
  Json json{{"particles", particles.pins}, {"home", json_of(particles.pin_home)}};
  if (!particles.move) return json;
  json["motion"] = motion_json(*particles.move);
  json["displacement"] = Json::list();
  for (double t : times) json["displacement"].push(json_of(displacement_at(*particles.move, t)));
  return json;
}

}  // namespace

std::string scene_json(const Scene& scene, const Run& run, const std::vector<std::string>& options) {
  const Particles& particles = scene.model.particles;
  const StepPlan steps = plan(run);
  std::vector<double> times;
  for (int i = 0; i <= steps.samples; ++i) times.push_back(steps.time(i, 0));

  Json json{{"format", "crosscheck-scene"},
            {"version", 1},
            {"units", "SI: m, kg, s, N, N/m, N s/m, Hz; phases and angles in rad"},
            {"name", scene.name},
            {"hash", scene.hash},
            {"question", scene.question},
            {"first_order", scene.model.first_order()},
            {"size", scene.size()},
            {"window", scene.window},
            {"tolerance", scene.tolerance},
            {"options", options},
            {"run",
             {{"step", steps.h},
              {"steps_per_sample", steps.steps_per_sample},
              {"samples", steps.samples},
              {"duration", run.duration},
              {"tolerance", run.tolerance},
              {"times", times}}},
            {"particles", particles_json(particles, scene.start, scene.model.first_order())}};
  if (!particles.pins.empty()) json["pins"] = pins_json(particles, times);
  json["terms"] = Json::list();
  for (const Term& term : scene.model.terms) {
    Json& entry = json["terms"].push({{"type", name_of(term)}});
    std::visit([&](const auto& t) { add(entry, t); }, term);
  }
  if (!scene.triangles.empty()) json["triangles"] = scene.triangles;

  // a line for each part: long lists stay out of the way of a reader who pages through
  return json.dump_in_lines();
}

}  // namespace crosscheck
