#include "reference/protocol/scene_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mysim/base/errors.h"

namespace crosscheck {

Vec3 vec3_of(const JsonField& field) {
  const std::vector<double> parts = field.numbers();
  if (parts.size() != 3) field.fail("three numbers");
  return {parts[0], parts[1], parts[2]};
}

Points points_of(const JsonField& field, int count) {
  return Eigen::Map<const Points>(field.triples(static_cast<size_t>(count)).data(), 3, count);
}

Json json_of(const Vec3& v) { return std::span(v.data(), 3); }

Json json_of(const Points& p) {
  Json list = Json::array();
  for (const auto& column : p.colwise()) list.push_back(std::span(column.data(), 3));
  return list;
}

namespace {

Json motion_json(const Motion& motion) {
  return {{"amplitude", json_of(motion.amplitude)}, {"frequency", motion.frequency}, {"ramp", motion.ramp}};
}

Json waves_of(const Gust& gust) {
  Json list = Json::array();
  for (const Gust::Wave& wave : gust.waves)
    list.push_back({{"weight", wave.weight}, {"omega", wave.omega}, {"phase", wave.phase}});
  return list;
}

void add_blowing(Json& json, const char* key, const WindSignal& wind_signal) {
  json[key] = json_of(wind_signal.mean);
  if (!wind_signal.gusts) return;
  const WindSignal::Gusts& gusts = *wind_signal.gusts;
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
  Json& list = json["list"] = Json::array();
  for (const Spring& s : t.list)
    list.push_back(
        {{"a", s.a}, {"b", s.b}, {"stiffness", s.k}, {"rest_length", s.rest}, {"family", name_of(s.family)}});
}
void add(Json& json, const Bending& t) {
  json["rigidity"] = t.rigidity;
  Json& list = json["list"] = Json::array();
  for (const Bending::Stencil& s : t.list) {
    const auto size = static_cast<size_t>(s.size);
    list.push_back({{"particles", std::vector(s.particle.begin(), s.particle.begin() + s.size)},
                    {"weights", std::span(s.weight.data(), size)},
                    {"stiffness", s.k}});
  }
}
void add(Json& json, const Dashpots& t) {
  Json& list = json["list"] = Json::array();
  for (const auto& [a, b, c] : t.list) list.push_back({{"a", a}, {"b", b}, {"coefficient", c}});
}
void add(Json& json, const Constraints& t) {
  Json& list = json["list"] = Json::array();
  for (const auto& [a, b, length] : t.list) list.push_back({{"a", a}, {"b", b}, {"length", length}});
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
  Json& list = json["list"] = Json::array();
  for (const Sphere& s : t.list) {
    Json& entry = list.emplace_back(Json{{"centre", json_of(s.centre)},
                                         {"radius", s.radius},
                                         {"margin", s.margin},
                                         {"friction", s.friction},
                                         {"restitution", s.restitution}});
    if (s.motion) entry["motion"] = motion_json(*s.motion);
  }
}

void add(Json& json, const Planes& t) {
  Json& list = json["list"] = Json::array();
  for (const Plane& p : t.list) {
    Json& entry = list.emplace_back(Json{{"point", json_of(p.point)},
                                         {"normal", json_of(p.normal)},
                                         {"margin", p.margin},
                                         {"friction", p.friction},
                                         {"restitution", p.restitution}});
    if (p.velocity) entry["velocity"] = json_of(*p.velocity);
  }
}

Json particles_json(const Particles& particles, const State& start, bool first_order) {
  Json json{{"count", particles.size()}};
  if (!first_order) json["mass"] = std::span(particles.mass.data(), static_cast<size_t>(particles.mass.size()));
  json["x"] = json_of(start.x);
  if (first_order) return json;
  json["v"] = json_of(start.v);
  json["pinned"] = Json::array();
  for (char pinned : particles.pinned) json["pinned"].push_back(pinned);
  return json;
}

Json pins_json(const Particles& particles, const std::vector<double>& times) {
  Json json{{"particles", particles.pins}, {"home", json_of(particles.pin_home)}};
  if (!particles.move) return json;
  json["motion"] = motion_json(*particles.move);
  json["displacement"] = Json::array();
  for (double t : times) json["displacement"].push_back(json_of(displacement_at(*particles.move, t)));
  return json;
}

}  // namespace

std::string scene_json(const Scene& scene, const Run& run, const std::vector<std::string>& options) {
  const Particles& particles = scene.model.particles;
  const TimeGrid steps = time_grid(run);
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
  json["terms"] = Json::array();
  for (const Term& term : scene.model.terms) {
    Json& entry = json["terms"].emplace_back(Json{{"type", name_of(term)}});
    std::visit([&](const auto& t) { add(entry, t); }, term);
  }
  if (!scene.triangles.empty()) json["triangles"] = scene.triangles;

  // one line per key, which keeps long lists out of the way
  return dump_in_lines(json);
}

namespace {

Motion motion_of(const JsonField& f) {
  return {vec3_of(f["amplitude"]), f["frequency"].number_from(0), f["ramp"].number_from(0)};
}

void read_waves(const JsonField& f, Gust& gust) {
  const auto list = f.elements();
  if (list.size() != gust.waves.size()) f.fail(fmt::format("{} waves", gust.waves.size()));
  for (size_t i = 0; i < list.size(); ++i)
    gust.waves[i] = {list[i]["weight"].number(), list[i]["omega"].number(), list[i]["phase"].number()};
}

WindSignal blowing_of(const JsonField& f, std::string_view key) {
  WindSignal wind_signal{vec3_of(f[key]), std::nullopt};
  if (const auto g = f.find("gusts")) {
    const int seed = (*g)["seed"].whole_number(0, 2147483647);
    wind_signal.gusts = {(*g)["variation"].number(), vec3_of((*g)["side"]), seed, Gust(seed, 1), Gust(seed, 2)};
    read_waves((*g)["along"], wind_signal.gusts->along);  // uses the waves in the file, not those of the seed
    read_waves((*g)["across"], wind_signal.gusts->across);
  }
  return wind_signal;
}

/// Index of one end of a pair.
int end_of(const JsonField& pair, std::string_view key, const Scene& scene) {
  return pair[key].whole_number(0, scene.model.particles.size() - 1);
}

Family family_of(const JsonField& f) {
  const std::string text = f.text();
  for (const Family family : {Family::single, Family::structural, Family::shear, Family::bend})
    if (text == name_of(family)) return family;
  f.fail("single, structural, shear or bend");
}

std::vector<std::array<int, 3>> triangles_of(const JsonField& f, const Scene& scene) {
  std::vector<std::array<int, 3>> list;
  for (const JsonField& triangle : f.elements()) {
    const std::vector<int> corners = triangle.indices(scene.model.particles.size());
    if (corners.size() != 3) triangle.fail("three particles");
    list.push_back({corners[0], corners[1], corners[2]});
  }
  return list;
}

Term springs_of(const JsonField& f, const Scene& scene) {
  Springs springs;
  const std::string law = f["law"].text();
  if (law == name_of(SpringLaw::bullet_link))
    springs.law = SpringLaw::bullet_link;
  else if (law != name_of(SpringLaw::hooke))
    f["law"].fail(fmt::format("{} or {}", name_of(SpringLaw::hooke), name_of(SpringLaw::bullet_link)));
  for (const JsonField& s : f["list"].elements())
    springs.list.push_back({end_of(s, "a", scene), end_of(s, "b", scene), s["stiffness"].number_from(0),
                            s["rest_length"].number_from(0), family_of(s["family"])});
  return springs;
}

Term bending_of(const JsonField& f, const Scene& scene) {
  Bending bending{{}, f["rigidity"].number_from(0)};
  for (const JsonField& s : f["list"].elements()) {
    const std::vector<int> particles = s["particles"].indices(scene.model.particles.size());
    const std::vector<double> weights = s["weights"].numbers();
    if (particles.size() < 2 || particles.size() > Bending::most)
      s["particles"].fail(fmt::format("two to {} particles", Bending::most));
    if (weights.size() != particles.size()) s["weights"].fail("a weight for each of the particles");
    Bending::Stencil stencil{static_cast<int>(particles.size()), {}, {}, s["stiffness"].number_from(0)};
    std::copy(particles.begin(), particles.end(), stencil.particle.begin());
    std::copy(weights.begin(), weights.end(), stencil.weight.begin());
    bending.list.push_back(stencil);
  }
  return bending;
}

Term dashpots_of(const JsonField& f, const Scene& scene) {
  Dashpots dashpots;
  for (const JsonField& d : f["list"].elements())
    dashpots.list.push_back({end_of(d, "a", scene), end_of(d, "b", scene), d["coefficient"].number_from(0)});
  return dashpots;
}

Term constraints_of(const JsonField& f, const Scene& scene) {
  Constraints constraints;
  for (const JsonField& c : f["list"].elements())
    constraints.list.push_back({end_of(c, "a", scene), end_of(c, "b", scene), c["length"].number_from(0)});
  return constraints;
}

Term drag_of(const JsonField& f, const Scene& scene) {
  const std::vector<double> c = f["coefficient"].numbers();
  if (static_cast<int>(c.size()) != scene.model.particles.size())
    f["coefficient"].fail(fmt::format("{} numbers, one per particle", scene.model.particles.size()));
  return Drag{Eigen::Map<const Eigen::VectorXd>(c.data(), static_cast<long>(c.size()))};
}

Term aerodynamics_of(const JsonField& f, const Scene& scene) {
  return Aerodynamics{f["density"].number(), f["coefficient"].number(), blowing_of(f, "velocity"),
                      triangles_of(f["triangles"], scene)};
}

Term spheres_of(const JsonField& f, const Scene&) {
  Spheres spheres;
  for (const JsonField& s : f["list"].elements()) {
    spheres.list.push_back({vec3_of(s["centre"]), s["radius"].number_from(0), s["margin"].number_from(0),
                            s["friction"].number_from(0), s["restitution"].number_from(0), std::nullopt});
    if (const auto motion = s.find("motion")) spheres.list.back().motion = motion_of(*motion);
  }
  return spheres;
}

Term planes_of(const JsonField& f, const Scene&) {
  Planes planes;
  for (const JsonField& p : f["list"].elements()) {
    planes.list.push_back({vec3_of(p["point"]), vec3_of(p["normal"]), p["margin"].number_from(0),
                           p["friction"].number_from(0), p["restitution"].number_from(0), std::nullopt});
    if (std::abs(planes.list.back().normal.norm() - 1) > 1e-12) p["normal"].fail("a unit vector");
    if (const auto velocity = p.find("velocity")) planes.list.back().velocity = vec3_of(*velocity);
  }
  return planes;
}

// one row per alternative of Term
struct TermReader {
  std::string_view type;
  Term (*read)(const JsonField&, const Scene&);
};
constexpr TermReader term_readers[] = {
    {Rotation::name, [](const JsonField& f, const Scene&) -> Term { return Rotation{f["rate"].number()}; }},
    {Gravity::name, [](const JsonField& f, const Scene&) -> Term { return Gravity{vec3_of(f["acceleration"])}; }},
    {Springs::name, springs_of},
    {Bending::name, bending_of},
    {Dashpots::name, dashpots_of},
    {Constraints::name, constraints_of},
    {Drag::name, drag_of},
    {Wind::name, [](const JsonField& f, const Scene&) -> Term { return Wind{blowing_of(f, "acceleration")}; }},
    {Aerodynamics::name, aerodynamics_of},
    {Spheres::name, spheres_of},
    {Planes::name, planes_of},
};
static_assert(std::size(term_readers) == std::variant_size_v<Term>);

Term term_of(const JsonField& f, const Scene& scene) {
  const std::string type = f["type"].text();
  for (const TermReader& reader : term_readers)
    if (reader.type == type) return reader.read(f, scene);
  throw Unsupported(fmt::format("unknown term {}", type));
}

void read_particles(const JsonField& file, bool first_order, Scene& scene) {
  const JsonField f = file["particles"];
  const int n = f["count"].whole_number(1, 100000000);
  Particles& particles = scene.model.particles;
  scene.start.x = points_of(f["x"], n);
  scene.start.v = first_order ? Points(3, 0) : points_of(f["v"], n);
  particles.mass = Eigen::VectorXd::Ones(n);
  if (!first_order) {
    const std::vector<double> mass = f["mass"].numbers();
    if (static_cast<int>(mass.size()) != n) f["mass"].fail(fmt::format("{} numbers", n));
    particles.mass = Eigen::Map<const Eigen::VectorXd>(mass.data(), n);
  }
  particles.pinned.assign(n, 0);
  if (const auto pins = file.find("pins")) {
    particles.pins = (*pins)["particles"].indices(n);
    particles.pin_home = points_of((*pins)["home"], static_cast<int>(particles.pins.size()));
    for (int pin : particles.pins) particles.pinned[pin] = 1;
    if (const auto motion = pins->find("motion")) particles.move = motion_of(*motion);
  }
}

}  // namespace

EngineTask read_scene_json(const std::filesystem::path& path) {
  const JsonField file = JsonField::parse_file(path.string());
  if (file["format"].text() != "crosscheck-scene") file["format"].fail("crosscheck-scene");
  file["version"].whole_number(1, 1);

  EngineTask task{Scene{}, Run{}, file["options"].texts()};
  const JsonField run = file["run"];
  task.run = {run["step"].number(), run["duration"].number(), run["samples"].whole_number(1, 1000000),
              run["tolerance"].number()};
  if (!(task.run.step > 0) || !(task.run.duration > 0)) run.fail("a step and a duration above zero");

  Scene& scene = task.scene;
  scene.name = file["name"].text();
  scene.question = file["question"].text();
  scene.duration = task.run.duration;
  scene.samples = task.run.samples;
  scene.step = task.run.step;
  scene.window = file["window"].number();
  scene.tolerance = file["tolerance"].number();
  read_particles(file, file["first_order"].boolean(), scene);
  for (const JsonField& term : file["terms"].elements()) scene.model.terms.push_back(term_of(term, scene));
  if (const auto triangles = file.find("triangles")) scene.triangles = triangles_of(*triangles, scene);
  scene.hash = hash_of(scene);
  return task;
}

}  // namespace crosscheck
