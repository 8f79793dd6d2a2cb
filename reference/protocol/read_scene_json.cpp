// JSON back into the scene and the run that it was written from.
#include <fmt/format.h>

#include "mysim/errors.h"
#include "reference/protocol/json_fields.h"
#include "reference/protocol/scene_json.h"

namespace crosscheck {
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

Blowing blowing_of(const JsonField& f, std::string_view key) {
  Blowing blowing{vec3_of(f[key]), std::nullopt};
  if (const auto g = f.find("gusts")) {
    const int seed = (*g)["seed"].whole_number(0, 2147483647);
    blowing.gusts = {(*g)["variation"].number(), vec3_of((*g)["side"]), seed, Gust(seed, 1), Gust(seed, 2)};
    read_waves((*g)["along"], blowing.gusts->along);  // what is written counts, not what the seed would give
    read_waves((*g)["across"], blowing.gusts->across);
  }
  return blowing;
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

// the table of terms: one row for each alternative of Term
struct TermReader {
  std::string_view type;
  Term (*read)(const JsonField&, const Scene&);
};
constexpr TermReader term_readers[] = {
    {Rotation::name, [](const JsonField& f, const Scene&) -> Term { return Rotation{f["rate"].number()}; }},
    {Gravity::name, [](const JsonField& f, const Scene&) -> Term { return Gravity{vec3_of(f["acceleration"])}; }},
    {Springs::name, springs_of},
    {Dashpots::name, dashpots_of},
    {Constraints::name, constraints_of},
    {Drag::name, drag_of},
    {Wind::name, [](const JsonField& f, const Scene&) -> Term { return Wind{blowing_of(f, "acceleration")}; }},
    {Aerodynamics::name, aerodynamics_of},
    {Spheres::name, spheres_of},
};
static_assert(std::size(term_readers) == std::variant_size_v<Term>);

Term term_of(const JsonField& f, const Scene& scene) {
  const std::string type = f["type"].text();
  for (const TermReader& reader : term_readers)
    if (reader.type == type) return reader.read(f, scene);
  f["type"].fail("a term of PROTOCOL.md");
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

Task read_scene_json(const std::filesystem::path& path) {
  const JsonField file = JsonField::parse_file(path.string());
  if (file["format"].text() != "crosscheck-scene") file["format"].fail("crosscheck-scene");
  file["version"].whole_number(1, 1);

  Task task{Scene{}, Run{}, file["options"].texts()};
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
  read_particles(file, file["first_order"].truth(), scene);
  for (const JsonField& term : file["terms"].elements()) scene.model.terms.push_back(term_of(term, scene));
  if (const auto triangles = file.find("triangles")) scene.triangles = triangles_of(*triangles, scene);
  scene.hash = hash_of(scene);
  return task;
}

}  // namespace crosscheck
