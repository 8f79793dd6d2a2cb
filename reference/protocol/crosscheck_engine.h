// The engine protocol for programs in C++17, without dependencies: reads scene.json, writes trajectory.npy,
// velocities.npy and run.json. Copy this file; PROTOCOL.md says what everything means. SI units throughout.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace crosscheck_engine {

using Vec = std::array<double, 3>;
inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const Vec& a) { return std::sqrt(dot(a, a)); }

/// A JSON value. Look-ups throw std::runtime_error that names the key.
struct Json {
  enum class Type { null, boolean, number, string, array, object } type = Type::null;
  double value = 0;  // of numbers; 1 and 0 of true and false
  std::string text;
  std::vector<Json> list;
  std::map<std::string, Json> keys;

  bool has(const std::string& key) const { return keys.count(key) > 0; }
  const Json& operator[](const std::string& key) const {
    const auto at = keys.find(key);
    if (at == keys.end()) throw std::runtime_error("scene.json: expected the key \"" + key + "\"");
    return at->second;
  }
  double number() const {
    if (type != Type::number) throw std::runtime_error("scene.json: expected a number");
    return value;
  }
  int integer() const { return static_cast<int>(number()); }
  Vec vec() const {
    if (list.size() != 3) throw std::runtime_error("scene.json: expected three numbers");
    return {list[0].number(), list[1].number(), list[2].number()};
  }
};

/// Reads the JSON that crosscheck writes (whole standard but for surrogate pairs in \u, which become '?').
class JsonReader {
 public:
  static Json parse(const std::string& text) {
    JsonReader reader{text};
    Json json = reader.value();
    if (reader.peek() != '\0') reader.fail("its end");
    return json;
  }

 private:
  explicit JsonReader(const std::string& text) : at_(text.c_str()), begin_(at_) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("scene.json: expected " + what + " at byte " + std::to_string(at_ - begin_));
  }
  char peek() {
    while (*at_ == ' ' || *at_ == '\n' || *at_ == '\t' || *at_ == '\r') ++at_;
    return *at_;
  }
  bool take(char c) { return peek() == c && ++at_; }
  void need(char c) {
    if (!take(c)) fail(std::string("'") + c + "'");
  }
  bool word(const char* letters) {
    const std::string w = letters;
    for (size_t i = 0; i < w.size(); ++i)
      if (at_[i] != w[i]) return false;
    at_ += w.size();
    return true;
  }

  Json value() {
    Json json;
    const char c = peek();
    if (c == '{') {
      ++at_;
      json.type = Json::Type::object;
      for (bool first = true; !take('}'); first = false) {
        if (!first) need(',');
        if (peek() != '"') fail("a key");
        std::string key = string();
        need(':');
        json.keys[std::move(key)] = value();
      }
    } else if (c == '[') {
      ++at_;
      json.type = Json::Type::array;
      for (bool first = true; !take(']'); first = false) {
        if (!first) need(',');
        json.list.push_back(value());
      }
    } else if (c == '"') {
      json.type = Json::Type::string;
      json.text = string();
    } else if (word("true") || word("false")) {
      json.type = Json::Type::boolean;
      json.value = c == 't';
    } else if (!word("null")) {
      char* end = nullptr;
      json.type = Json::Type::number;
      json.value = std::strtod(at_, &end);  // the nearest double: the scene's very bits
      if (end == at_) fail("a value");
      at_ = end;
    }
    return json;
  }

  std::string string() {
    std::string out;
    for (++at_; *at_ != '"'; ++at_) {
      if (*at_ == '\0') fail("'\"'");
      if (*at_ != '\\') {
        out += *at_;
        continue;
      }
      ++at_;
      const std::string plain = "\"\\/", letters = "nrtbf", meant = "\n\r\t\b\f";
      if (plain.find(*at_) != std::string::npos) {
        out += *at_;
      } else if (const size_t i = letters.find(*at_); i != std::string::npos && *at_ != '\0') {
        out += meant[i];
      } else if (*at_ == 'u') {
        unsigned code = 0;
        for (int digit = 0; digit < 4; ++digit) {
          const char hex = *++at_;
          const bool decimal = hex >= '0' && hex <= '9', letter = (hex | 32) >= 'a' && (hex | 32) <= 'f';
          if (!decimal && !letter) fail("four hexadecimal digits");
          code = 16 * code + static_cast<unsigned>(decimal ? hex - '0' : (hex | 32) - 'a' + 10);
        }
        if (code < 0x80) {
          out += static_cast<char>(code);
        } else if (code >= 0xd800 && code < 0xe000) {
          out += '?';
        } else {
          if (code >= 0x800) out += static_cast<char>(0xe0 | code >> 12);
          out += static_cast<char>(code >= 0x800 ? 0x80 | (code >> 6 & 63) : 0xc0 | code >> 6);
          out += static_cast<char>(0x80 | (code & 63));
        }
      } else {
        fail("an escape");
      }
    }
    ++at_;
    return out;
  }

  const char *at_, *begin_;
};

struct Motion {
  Vec amplitude;           // m
  double frequency, ramp;  // Hz, s

  Vec displacement(double t) const { return at(t)[0] * amplitude; }  // m
  Vec velocity(double t) const { return at(t)[1] * amplitude; }      // m/s

 private:
  std::array<double, 2> at(double t) const {
    const double omega = 2 * 3.14159265358979323846 * frequency, s = t < ramp ? t / ramp : 1;
    const double r = s * s * s * (10 + s * (6 * s - 15)), slope = t < ramp ? 30 * s * s * (1 - s) * (1 - s) / ramp : 0;
    return {r * std::sin(omega * t), slope * std::sin(omega * t) + r * omega * std::cos(omega * t)};
  }
};

inline Motion motion_of(const Json& json) {
  return {json["amplitude"].vec(), json["frequency"].number(), json["ramp"].number()};
}

struct Spring {
  int a, b;                       // ends
  double stiffness, rest_length;  // N/m, m
};

/// A solid half-space: particles stay at `margin` from the face through point + t velocity.
struct Plane {
  Vec point, normal, velocity;           // m, at t = 0; unit vector out of the solid; m/s
  double margin, friction, restitution;  // m, mu, e
};

/// The parts that most engines need; everything else is in `json`, by the keys of PROTOCOL.md.
struct Scene {
  Json json;
  std::string name;
  double step = 0;  // s
  int steps_per_sample = 0, samples = 0;
  std::vector<double> mass;   // kg; empty in first-order scenes
  std::vector<Vec> x, v;      // m, m/s
  std::vector<char> pinned;   // 1 where held
  std::vector<int> pins;      // which particles are held
  std::vector<Vec> pin_home;  // m, where each is at t = 0
  bool pins_move = false;
  Motion pin_motion{};
  std::string spring_law = "hooke";
  std::vector<Spring> springs;
  std::vector<Spring> constraints;  // hard distances, their lengths as rest lengths, their stiffness infinite
  std::vector<Plane> planes;
  Vec gravity{};             // m/s^2
  std::vector<double> drag;  // N s/m, for each particle; zeros where the scene has none
  std::vector<std::string> options;

  /// The scene's term of that type, or null.
  const Json* term(const std::string& type) const {
    for (const Json& t : json["terms"].list)
      if (t["type"].text == type) return &t;
    return nullptr;
  }
  /// Ends the program with "unsupported" when the scene has a term that is not in the list.
  void require_only(std::initializer_list<const char*> known) const;
  /// Writes places and speeds of the pins at time t (s).
  void place_pins(double t, std::vector<Vec>& at, std::vector<Vec>& speed) const {
    for (size_t i = 0; i < pins.size(); ++i) {
      at[pins[i]] = pins_move ? pin_home[i] + pin_motion.displacement(t) : pin_home[i];
      speed[pins[i]] = pins_move ? pin_motion.velocity(t) : Vec{};
    }
  }
};

/// Exit status 3 with one line: the engine lacks something.
[[noreturn]] inline void unsupported(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(3);
}

inline void Scene::require_only(std::initializer_list<const char*> known) const {
  for (const Json& t : json["terms"].list) {
    bool found = false;
    for (const char* type : known) found |= t["type"].text == type;
    if (!found) unsupported("this engine has no " + t["type"].text);
  }
}

inline std::vector<Vec> vecs_of(const Json& json) {
  std::vector<Vec> list;
  for (const Json& v : json.list) list.push_back(v.vec());
  return list;
}

/// Reads the file; throws std::runtime_error when it is not what PROTOCOL.md describes.
inline Scene read_scene(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  Scene s;
  s.json = JsonReader::parse(std::string(std::istreambuf_iterator<char>(in), {}));
  if (s.json["format"].text != "crosscheck-scene" || s.json["version"].integer() != 1)
    throw std::runtime_error(file + ": expected a crosscheck-scene of version 1");
  s.name = s.json["name"].text;
  s.step = s.json["run"]["step"].number();
  s.steps_per_sample = s.json["run"]["steps_per_sample"].integer();
  s.samples = s.json["run"]["samples"].integer();
  const Json& particles = s.json["particles"];
  s.x = vecs_of(particles["x"]);
  s.pinned.assign(s.x.size(), 0);
  s.drag.assign(s.x.size(), 0);
  if (particles.has("mass")) {
    for (const Json& m : particles["mass"].list) s.mass.push_back(m.number());
    s.v = vecs_of(particles["v"]);
  }
  if (s.json.has("pins")) {
    const Json& pins = s.json["pins"];
    for (const Json& pin : pins["particles"].list) s.pins.push_back(pin.integer());
    s.pin_home = vecs_of(pins["home"]);
    for (int pin : s.pins) s.pinned[pin] = 1;
    if ((s.pins_move = pins.has("motion"))) s.pin_motion = motion_of(pins["motion"]);
  }
  if (const Json* springs = s.term("springs")) {
    s.spring_law = (*springs)["law"].text;
    for (const Json& p : (*springs)["list"].list)
      s.springs.push_back({p["a"].integer(), p["b"].integer(), p["stiffness"].number(), p["rest_length"].number()});
  }
  if (const Json* constraints = s.term("constraints"))
    for (const Json& p : (*constraints)["list"].list)
      s.constraints.push_back(
          {p["a"].integer(), p["b"].integer(), std::numeric_limits<double>::infinity(), p["length"].number()});
  if (const Json* planes = s.term("plane"))
    for (const Json& p : (*planes)["list"].list)
      s.planes.push_back({p["point"].vec(), p["normal"].vec(), p.has("velocity") ? p["velocity"].vec() : Vec{},
                          p["margin"].number(), p["friction"].number(), p["restitution"].number()});
  if (const Json* gravity = s.term("gravity")) s.gravity = (*gravity)["acceleration"].vec();
  if (const Json* drag = s.term("drag"))
    for (size_t i = 0; i < s.x.size(); ++i) s.drag[i] = (*drag)["coefficient"].list.at(i).number();
  for (const Json& option : s.json["options"].list) s.options.push_back(option.text);
  return s;
}

/// Frames x particles x 3, float64, as numpy.load reads them. For little-endian machines.
inline void write_npy(const std::string& file, const std::vector<std::vector<Vec>>& frames) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(frames.size()) + ", " +
                       std::to_string(frames.empty() ? 0 : frames[0].size()) + ", 3), }";
  header.resize((10 + header.size() + 1 + 63) / 64 * 64 - 11, ' ');
  header += '\n';
  std::ofstream out(file, std::ios::binary);
  out.write("\x93NUMPY\x01\x00", 8);
  out.put(static_cast<char>(header.size() & 255)).put(static_cast<char>(header.size() >> 8));
  out << header;
  for (const auto& frame : frames)
    out.write(reinterpret_cast<const char*>(frame.data()), static_cast<std::streamsize>(sizeof(Vec) * frame.size()));
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

// run.json: what the program says of its run. A key that is not known is left out of the file.

/// No number: the key is left out. A stiffness of `hard` is left out too, as JSON has no infinity.
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double hard = std::numeric_limits<double>::infinity();

/// A sphere as the engine has it.
struct Ball {
  Vec centre;                                                          // m, at the start
  double radius = unknown, friction = unknown, restitution = unknown;  // m, at which particles touch; mu; e
};

/// A plane as the engine has it: the face that particles touch.
struct Face {
  Vec point, normal;                                 // m, at the start; unit vector
  double friction = unknown, restitution = unknown;  // mu, e
};

/// Where prescribed motions have led.
struct Places {
  double t;                      // s
  std::vector<Vec> pins;         // m, in the scene's order
  std::vector<Vec> centres;      // m, of spheres
  std::vector<Vec> points = {};  // m, of planes
};

/// Forces in a state of the program's own choice. A list that stays empty is not told; zeros say that the engine has
/// no such thing.
struct Probe {
  double t = 0;                              // s
  std::vector<Vec> x, v;                     // m, m/s
  std::vector<Vec> springs, dashpots, wind;  // N: at x; at x and v; at x and t with the free particles at rest
  std::vector<Vec> bending = {};             // N, at x
};

/// What the certificate sees: read it from your engine's own data, not from the scene. All of PROTOCOL.md's table.
struct Readback {
  std::vector<double> mass;   // kg; of held particles anything
  std::vector<char> pinned;   // 1 where held
  std::vector<Spring> links;  // springs, then constraints, in the scene's order; stiffness may be `hard` or `unknown`
  std::optional<Vec> gravity = {};                // m/s^2
  std::string precision = "double";               // or "single"
  std::optional<std::vector<double>> drag = {};   // 1/s, c / m of each particle
  std::optional<std::vector<Ball>> spheres = {};  // an empty list: none
  std::optional<std::vector<Face>> planes = {};   // likewise
  double margin = unknown;                        // m
  std::optional<bool> may_sleep = {};
  double step = unknown;                        // s
  std::vector<Vec> start_x = {}, start_v = {};  // m, m/s: what the first step began from
  std::optional<Places> later = {};
  std::optional<Probe> probe = {};
  std::map<std::string, std::string> mapped = {}, settings = {};
};

struct RunReport {
  double cpu_seconds = unknown;                                      // of stepping alone
  long steps = -1, force_evaluations = -1, coincident_springs = -1;  // below zero: not counted
  double step = unknown;                                             // s, as used
  std::string verdict = {}, reason = {};  // of a run that failed by its own word: energy, stretch, nan, solver, frozen
  double end = unknown;                   // s, when it failed
  std::vector<std::string> different_law = {};  // "ingredient: how its law differs"
  std::optional<Readback> readback = {};
};

/// A state that shows a spring's law: the start, all of it stretched by a tenth or more about the origin until no
/// spring is within a hundredth of its rest length, and growing, so that dashpots pull too.
inline Probe probe_state(const Scene& scene) {
  Probe probe;
  for (int tenths = 11;; ++tenths) {
    const double factor = tenths / 10.;
    bool shows = true;
    for (const Spring& s : scene.springs) {
      const double l = factor * length(scene.x[s.a] - scene.x[s.b]);
      shows &= l == 0 || std::abs(l - s.rest_length) > 0.01 * s.rest_length;
    }
    if (!shows && tenths < 30) continue;  // hopeless beyond: some springs stay unattested
    for (const Vec& x : scene.x) {
      probe.x.push_back(factor * x);
      probe.v.push_back(0.5 * x);  // 0.5 /s
    }
    return probe;
  }
}

/// Writes JSON: numbers with all their digits, lists, objects without the keys that have no value.
class JsonWriter {
 public:
  static std::string of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
  }
  static std::string of(long value) { return std::to_string(value); }
  static std::string of(int value) { return std::to_string(value); }
  static std::string of(char value) { return std::to_string(int(value)); }
  static std::string of(bool value) { return value ? "true" : "false"; }
  static std::string of(const Vec& v) { return '[' + of(v[0]) + ", " + of(v[1]) + ", " + of(v[2]) + ']'; }
  static std::string of(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      const bool control = static_cast<unsigned char>(c) < 32;
      out += control ? code : c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return out + '"';
  }
  static std::string of(const Spring& s) {
    JsonWriter w;
    w.add("a", s.a), w.add("b", s.b), w.add("rest_length", s.rest_length), w.add("stiffness", s.stiffness);
    return w.object();
  }
  static std::string of(const Ball& s) {
    JsonWriter w;
    w.add("centre", s.centre), w.add("radius", s.radius), w.add("friction", s.friction);
    w.add("restitution", s.restitution);
    return w.object();
  }
  static std::string of(const Face& f) {
    JsonWriter w;
    w.add("point", f.point), w.add("normal", f.normal), w.add("friction", f.friction);
    w.add("restitution", f.restitution);
    return w.object();
  }
  static std::string of(const Places& p) {
    JsonWriter w;
    w.add("t", p.t), w.add("pins", p.pins), w.add("centres", p.centres), w.add_unless_empty("points", p.points);
    return w.object();
  }
  static std::string of(const Probe& p) {
    JsonWriter w;
    w.add("t", p.t), w.add("x", p.x), w.add("v", p.v);
    w.add_unless_empty("springs", p.springs), w.add_unless_empty("dashpots", p.dashpots);
    w.add_unless_empty("bending", p.bending);
    w.add_unless_empty("wind", p.wind);
    return w.object();
  }
  static std::string of(const std::map<std::string, std::string>& texts) {
    JsonWriter w;
    for (const auto& text : texts) w.add(text.first, text.second);
    return w.object();
  }
  static std::string of(const Readback& r) {
    JsonWriter w;
    w.add("precision", r.precision), w.add("mass", r.mass), w.add("pinned", r.pinned), w.add("links", r.links);
    w.add("gravity", r.gravity), w.add("drag", r.drag), w.add("spheres", r.spheres), w.add("margin", r.margin);
    w.add("planes", r.planes);
    w.add("may_sleep", r.may_sleep), w.add("step", r.step);
    if (!r.start_x.empty()) {
      JsonWriter start;
      start.add("x", r.start_x), start.add("v", r.start_v);
      w.add_raw("start", start.object());
    }
    w.add("later", r.later), w.add("probe", r.probe);
    w.add_unless_empty("mapped", r.mapped), w.add_unless_empty("settings", r.settings);
    return w.object();
  }
  template <class T>
  static std::string of(const std::vector<T>& list) {
    std::string out = "[";
    for (const T& item : list) out += (out.size() > 1 ? ", " : "") + of(item);
    return out + ']';
  }

  void add(const std::string& key, double value) {
    if (std::isfinite(value)) add_raw(key, of(value));
  }
  template <class T>
  void add(const std::string& key, const std::optional<T>& value) {
    if (value) add_raw(key, of(*value));
  }
  template <class T>
  void add(const std::string& key, const T& value) {
    add_raw(key, of(value));
  }
  template <class T>
  void add_unless_empty(const std::string& key, const T& value) {
    if (!value.empty()) add_raw(key, of(value));
  }
  void add_count(const std::string& key, long count) {
    if (count >= 0) add_raw(key, of(count));
  }
  std::string object() const { return '{' + members_ + '}'; }

 private:
  void add_raw(const std::string& key, const std::string& value) {
    members_ += (members_.empty() ? "" : ",\n ") + of(key) + ": " + value;
  }
  std::string members_;
};

inline void write_run_json(const std::string& file, const RunReport& run) {
  JsonWriter w;
  w.add("cpu_seconds", run.cpu_seconds);
  w.add_count("steps", run.steps), w.add_count("force_evaluations", run.force_evaluations);
  w.add_count("coincident_springs", run.coincident_springs);
  w.add("step", run.step), w.add("end", run.end);
  w.add_unless_empty("verdict", run.verdict), w.add_unless_empty("reason", run.reason);
  w.add_unless_empty("different_law", run.different_law);
  w.add("readback", run.readback);
  std::ofstream out(file);
  out << w.object() << '\n';
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace crosscheck_engine
