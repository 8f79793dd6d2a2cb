#include "reference/protocol/run_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mysim/base/errors.h"
#include "mysim/base/names.h"
#include "reference/protocol/scene_json.h"

namespace crosscheck {
namespace {

template <class T>
void add(Json& json, const char* key, const std::optional<T>& value) {
  if (!value) return;
  if constexpr (std::is_same_v<T, Vec3>)
    json[key] = json_of(*value);
  else
    json[key] = *value;
}

Json string_map_json(const std::map<std::string, std::string>& texts) {
  Json json = Json::object();
  for (const auto& [key, text] : texts) json[key] = text;
  return json;
}

Json readback_json(const Readback& r) {
  Json json{{"mass", r.mass},
            {"pinned", Json::array()},
            {"links", Json::array()},
            {"precision", r.precision},
            {"mapped", string_map_json(r.mapped)},
            {"settings", string_map_json(r.settings)}};
  for (char pinned : r.pinned) json["pinned"].push_back(pinned);
  for (const Readback::Link& link : r.links) {
    Json& entry = json["links"].emplace_back(Json{{"a", link.a}, {"b", link.b}, {"rest_length", link.rest}});
    add(entry, "stiffness", link.stiffness);
  }
  add(json, "may_sleep", r.may_sleep);
  add(json, "step", r.step);
  add(json, "gravity", r.gravity);
  add(json, "drag", r.drag);
  add(json, "margin", r.margin);
  if (r.spheres) {
    json["spheres"] = Json::array();
    for (const Readback::Ball& ball : *r.spheres) {
      Json& entry = json["spheres"].emplace_back(Json{{"centre", json_of(ball.centre)}});
      add(entry, "radius", ball.radius);
      add(entry, "friction", ball.friction);
      add(entry, "restitution", ball.restitution);
    }
  }
  if (r.planes) {
    json["planes"] = Json::array();
    for (const Readback::Face& face : *r.planes) {
      Json& entry = json["planes"].emplace_back(Json{{"point", json_of(face.point)}, {"normal", json_of(face.normal)}});
      add(entry, "friction", face.friction);
      add(entry, "restitution", face.restitution);
    }
  }
  if (r.later) {
    json["later"] = {{"t", r.later->t}, {"pins", json_of(r.later->pins)}, {"centres", Json::array()}};
    for (const Vec3& centre : r.later->centres) json["later"]["centres"].push_back(json_of(centre));
    for (const Vec3& point : r.later->points) json["later"]["points"].push_back(json_of(point));
  }
  if (r.start) json["start"] = {{"x", json_of(r.start->x)}, {"v", json_of(r.start->v)}};
  if (r.probe) {
    json["probe"] = {{"t", r.probe->t}};
    const std::pair<const char*, const Points*> parts[] = {{"x", &r.probe->x},
                                                           {"v", &r.probe->v},
                                                           {"springs", &r.probe->springs},
                                                           {"bending", &r.probe->bending},
                                                           {"dashpots", &r.probe->dashpots},
                                                           {"wind", &r.probe->wind}};
    for (const auto& [key, points] : parts)
      if (points->cols() > 0) json["probe"][key] = json_of(*points);
  }
  return json;
}

std::optional<double> optional_number(const JsonField& f, std::string_view key) {
  const auto found = f.find(key);
  return found ? std::optional(found->number()) : std::nullopt;
}

Readback::Places places_of(const JsonField& f) {
  Readback::Places places{f["t"].number(), points_of(f["pins"], static_cast<int>(f["pins"].size())), {}, {}};
  for (const JsonField& centre : f["centres"].elements()) places.centres.push_back(vec3_of(centre));
  if (const auto points = f.find("points"))
    for (const JsonField& point : points->elements()) places.points.push_back(vec3_of(point));
  return places;
}

ForceProbe probe_of(const JsonField& f, int n) {
  ForceProbe probe;
  if (const auto t = f.find("t")) probe.t = t->number();
  probe.x = points_of(f["x"], n);
  probe.v = points_of(f["v"], n);
  const std::pair<const char*, Points*> parts[] = {
      {"springs", &probe.springs}, {"bending", &probe.bending}, {"dashpots", &probe.dashpots}, {"wind", &probe.wind}};
  for (const auto& [key, points] : parts)
    if (const auto found = f.find(key)) *points = points_of(*found, n);
  return probe;
}

Readback readback_of(const JsonField& f) {
  Readback r;
  r.mass = f["mass"].numbers();
  const int n = static_cast<int>(r.mass.size());
  for (const JsonField& pinned : f["pinned"].elements()) r.pinned.push_back(char(pinned.whole_number(0, 1)));
  if (static_cast<int>(r.pinned.size()) != n) f["pinned"].fail("as many entries as there are masses");
  for (const JsonField& link : f["links"].elements())
    r.links.push_back({link["a"].whole_number(0, n - 1), link["b"].whole_number(0, n - 1), link["rest_length"].number(),
                       optional_number(link, "stiffness")});
  r.precision = f["precision"].text();
  if (r.precision != "double" && r.precision != "single") f["precision"].fail("double or single");
  if (const auto sleep = f.find("may_sleep")) r.may_sleep = sleep->boolean();
  r.step = optional_number(f, "step");
  if (const auto gravity = f.find("gravity")) r.gravity = vec3_of(*gravity);
  if (const auto drag = f.find("drag")) r.drag = drag->numbers();
  r.margin = optional_number(f, "margin");
  if (const auto spheres = f.find("spheres")) {
    r.spheres.emplace();
    for (const JsonField& s : spheres->elements())
      r.spheres->push_back({vec3_of(s["centre"]), optional_number(s, "radius"), optional_number(s, "friction"),
                            optional_number(s, "restitution")});
  }
  if (const auto planes = f.find("planes")) {
    r.planes.emplace();
    for (const JsonField& p : planes->elements())
      r.planes->push_back({vec3_of(p["point"]), vec3_of(p["normal"]), optional_number(p, "friction"),
                           optional_number(p, "restitution")});
  }
  if (const auto later = f.find("later")) r.later = places_of(*later);
  if (const auto start = f.find("start")) r.start = State{0, points_of((*start)["x"], n), points_of((*start)["v"], n)};
  if (const auto probe = f.find("probe")) r.probe = probe_of(*probe, n);
  for (const auto& [key, map] : {std::pair{"mapped", &r.mapped}, {"settings", &r.settings}})
    if (const auto list = f.find(key))
      for (const auto& [name, value] : list->items()) (*map)[printable(name)] = printable(value.text());
  return r;
}

Verdict verdict_of(const JsonField& f) {
  const std::string text = f.text();
  for (const Verdict verdict :
       {Verdict::ok, Verdict::energy, Verdict::nan, Verdict::stretch, Verdict::solver, Verdict::frozen})
    if (text == name_of(verdict)) return verdict;
  f.fail("ok, energy, nan, solver or frozen, or stretch");
}

}  // namespace

std::string run_json(const Outcome& out) {
  Json json{{"verdict", name_of(out.verdict)},
            {"reason", out.reason},
            {"end", out.end},
            {"step", out.step},
            {"steps", out.steps},
            {"force_evaluations", out.evaluations},
            {"coincident_springs", out.degenerate_springs},
            {"cpu_seconds", out.cpu_seconds},
            {"different_law", out.different_law}};
  if (out.adaptive) json["adaptive"] = true;
  if (!out.engine.empty()) json["engine"] = out.engine;
  if (out.readback) json["readback"] = readback_json(*out.readback);
  return dump(json, 1) + "\n";
}

void read_run_json(const std::filesystem::path& path, Outcome& out, double duration) {
  const JsonField f = JsonField::parse_file(path.string());
  constexpr double most_counted = 9007199254740992;  // 2^53: larger integers are inexact
  constexpr double most_seconds = 1e9;
  auto number = [&](const char* key, double lowest, double highest, const char* expected) -> std::optional<double> {
    const auto found = f.find(key);
    if (!found) return std::nullopt;
    const double value = found->number();
    if (!(value >= lowest && value <= highest)) found->fail(expected);
    return value;
  };
  auto count = [&](const char* key, long& value) {
    if (const auto told = number(key, 0, most_counted, "a number of them, from 0 to 2^53"))
      value = static_cast<long>(*told);
  };
  auto seconds = [&](const char* key, double lowest, double highest, double& value) {
    const std::string expected = lowest > 0 ? fmt::format("seconds above 0, at most {:g}", highest)
                                            : fmt::format("seconds from 0 to {:g}", highest);
    if (const auto told = number(key, lowest, highest, expected.c_str())) value = *told;
  };
  if (const auto verdict = f.find("verdict")) out.verdict = verdict_of(*verdict);
  if (const auto reason = f.find("reason")) out.reason = printable(reason->text());
  // i h may round to slightly more than the duration
  const double latest = duration * (1 + 1e-9), no_step = std::numeric_limits<double>::min();
  seconds("end", 0, latest, out.end);
  seconds("step", no_step, latest, out.step);
  seconds("cpu_seconds", 0, most_seconds, out.cpu_seconds);
  count("steps", out.steps);
  count("force_evaluations", out.evaluations);
  count("coincident_springs", out.degenerate_springs);
  if (const auto adaptive = f.find("adaptive")) out.adaptive = adaptive->boolean();
  if (const auto serves = f.find("serves")) out.serves = serves->boolean();
  if (const auto engine = f.find("engine")) out.engine = printable(engine->text());
  if (const auto laws = f.find("different_law")) {
    for (const JsonField& law : laws->elements()) {
      // "ingredient: how it differs", as in the certificate
      if (law.text().find(": ") == std::string::npos) law.fail("a sentence \"ingredient: how its law differs\"");
      out.different_law.push_back(printable(law.text()));
    }
  }
  if (const auto readback = f.find("readback")) {
    out.readback = readback_of(*readback);
    if (!out.readback->step && f.find("step")) out.readback->step = out.step;
  }
}

}  // namespace crosscheck
