// The engine protocol for C++17 programs, without dependencies: reads scene.json, writes trajectory.npy, velocities.npy
// and run.json. Copy this file into your project; PROTOCOL.md documents every key. SI units throughout. The shortest
// adapter is a World and run_program(), at the end of this file.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
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

/// A JSON value. Look-ups throw std::runtime_error with the key.
struct Json {
  enum class Type { null, boolean, number, string, array, object } type = Type::null;
  double value = 0;  // the number; 1 for true, 0 for false
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
  std::vector<double> numbers() const {
    std::vector<double> all;
    for (const Json& entry : list) all.push_back(entry.number());
    return all;
  }
  std::vector<int> integers() const {
    const std::vector<double> all = numbers();
    return {all.begin(), all.end()};
  }
};

/// Reads crosscheck's JSON: the whole standard, except that surrogate pairs in \u become '?'.
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
    const size_t n = std::strlen(letters);
    const bool found = std::strncmp(at_, letters, n) == 0;
    if (found) at_ += n;
    return found;
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
      json.value = std::strtod(at_, &end);  // the nearest double: the scene's exact bits
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
          if (!std::isxdigit(static_cast<unsigned char>(*++at_))) fail("four hexadecimal digits");
          code = 16 * code + static_cast<unsigned>(*at_ <= '9' ? *at_ - '0' : (*at_ | 32) - 'a' + 10);
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

/// Ends the program with status 3 and one line: the engine does not support the scene.
[[noreturn]] inline void unsupported(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(3);
}

constexpr double pi = 3.14159265358979323846;

/// Displacement d(t) = amplitude r(t / ramp) sin(2 pi frequency t), where r rises smoothly from 0 to 1.
struct Motion {
  Vec amplitude;           // m
  double frequency, ramp;  // Hz, s

  Vec displacement(double t) const { return at(t)[0] * amplitude; }  // m
  Vec velocity(double t) const { return at(t)[1] * amplitude; }      // m/s
  Vec acceleration(double t) const { return at(t)[2] * amplitude; }  // m/s^2

 private:
  /// Value and two time derivatives of r(t / ramp) sin(2 pi frequency t).
  std::array<double, 3> at(double t) const {
    const double omega = 2 * pi * frequency, s = t < ramp ? t / ramp : 1;
    const double r = s * s * s * (10 + s * (6 * s - 15)), slope = t < ramp ? 30 * s * s * (1 - s) * (1 - s) / ramp : 0;
    const double curvature = t < ramp ? 60 * s * (1 - s) * (1 - 2 * s) / (ramp * ramp) : 0;
    const double sine = std::sin(omega * t), cosine = omega * std::cos(omega * t);
    return {r * sine, slope * sine + r * cosine, (curvature - r * omega * omega) * sine + 2 * slope * cosine};
  }
};

inline Motion motion_of(const Json& json) {
  return {json["amplitude"].vec(), json["frequency"].number(), json["ramp"].number()};
}

/// w(t) = mean (1 + variation g1(t)) + side g2(t), where g1 and g2 are sums of the waves `along` and `across`.
struct Wind {
  struct Wave {
    double weight, omega, phase;  // dimensionless, rad/s, rad
  };
  Vec mean{}, side{};    // m/s^2
  double variation = 0;  // dimensionless
  std::vector<Wave> along, across;

  Vec at(double t) const {
    const auto sum = [t](const std::vector<Wave>& waves) {
      double value = 0;
      for (const Wave& w : waves) value += w.weight * std::sin(w.omega * t + w.phase);
      return value;
    };
    return along.empty() ? mean : (1 + variation * sum(along)) * mean + sum(across) * side;
  }
};

inline Wind wind_of(const Json& json) {
  Wind wind;
  wind.mean = json["acceleration"].vec();
  if (!json.has("gusts")) return wind;
  const Json& gusts = json["gusts"];
  wind.side = gusts["side"].vec(), wind.variation = gusts["variation"].number();
  for (auto [key, waves] : {std::pair("along", &wind.along), std::pair("across", &wind.across)})
    for (const Json& w : gusts[key].list)
      waves->push_back({w["weight"].number(), w["omega"].number(), w["phase"].number()});
  return wind;
}

struct Spring {
  int a, b;
  double stiffness, rest_length;  // N/m, m
};

/// Damping along the line between two particles.
struct Dashpot {
  int a, b;
  double coefficient;  // N s/m
};

/// Bending energy k/2 |c|^2 with c = sum of weight times position; the weights sum to 0.
struct Stencil {
  std::vector<int> particles;
  std::vector<double> weights;  // dimensionless
  double stiffness;             // N/m
};

/// A solid ball: particles stay at least radius + margin from its centre.
struct Sphere {
  Vec centre;                                    // m, at t = 0
  double radius, margin, friction, restitution;  // m, m, mu, e
  std::optional<Motion> motion = {};

  Vec centre_at(double t) const { return motion ? centre + motion->displacement(t) : centre; }
  double contact_radius() const { return radius + margin; }
};

/// A solid half-space: particles stay at least `margin` from the face through point + t velocity.
struct Plane {
  Vec point, normal, velocity;           // m, at t = 0; unit vector out of the solid; m/s
  double margin, friction, restitution;  // m, mu, e

  /// A point of the plane that particles touch (m).
  Vec contact_point_at(double t) const { return point + margin * normal + t * velocity; }
};

/// The parts of a scene that most engines need; everything else is in `json`, under the keys of PROTOCOL.md.
struct Scene {
  Json json;
  std::string name;
  double step = 0;  // s
  int steps_per_sample = 0, samples = 0;
  std::vector<double> mass;   // kg; empty in first-order scenes
  std::vector<Vec> x, v;      // m, m/s
  std::vector<char> pinned;   // 1 if pinned
  std::vector<int> pins;      // pinned particles
  std::vector<Vec> pin_home;  // m, positions at t = 0
  bool pins_move = false;
  Motion pin_motion{};
  std::string spring_law = "hooke";
  std::vector<Spring> springs;
  std::vector<Spring> constraints;  // hard distances: infinitely stiff, rest length is the distance
  std::vector<Dashpot> dashpots;
  std::vector<Stencil> bending;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  Vec gravity{};             // m/s^2
  std::optional<Wind> wind;  // acceleration of all particles
  std::vector<double> drag;  // N s/m, per particle; 0 without drag
  std::vector<std::string> options;

  Vec wind_at(double t) const { return wind ? wind->at(t) : Vec{}; }
  Vec pin_at(size_t pin, double t) const {  // m, position of pins[pin]
    return pins_move ? pin_home[pin] + pin_motion.displacement(t) : pin_home[pin];
  }
  const Json* term(const std::string& type) const {
    for (const Json& t : json["terms"].list)
      if (t["type"].text == type) return &t;
    return nullptr;
  }
  /// Ends the program as unsupported if the scene has a term that is not in `known`.
  void require_only(std::initializer_list<const char*> known) const {
    for (const Json& t : json["terms"].list)
      if (std::find(known.begin(), known.end(), t["type"].text) == known.end())
        unsupported("this engine has no " + t["type"].text);
  }
  /// Ends the program as unsupported, with the reason, if a sphere or plane moves.
  void require_resting_surfaces(const std::string& why) const {
    bool moving = false;
    for (const Sphere& s : spheres) moving |= s.motion.has_value();
    for (const Plane& p : planes) moving |= dot(p.velocity, p.velocity) > 0;
    if (moving) unsupported("moving spheres and planes: " + why);
  }
  void place_pins(double t, std::vector<Vec>& at, std::vector<Vec>& speed) const {
    for (size_t i = 0; i < pins.size(); ++i) {
      at[pins[i]] = pin_at(i, t);
      speed[pins[i]] = pins_move ? pin_motion.velocity(t) : Vec{};
    }
  }
};

inline std::vector<Vec> vecs_of(const Json& json) {
  std::vector<Vec> list;
  for (const Json& v : json.list) list.push_back(v.vec());
  return list;
}

/// Reads a scene file. Throws std::runtime_error if it is not as PROTOCOL.md describes.
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
    s.mass = particles["mass"].numbers();
    s.v = vecs_of(particles["v"]);
  }
  if (s.json.has("pins")) {
    const Json& pins = s.json["pins"];
    s.pins = pins["particles"].integers();
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
  if (const Json* dashpots = s.term("dashpots"))
    for (const Json& p : (*dashpots)["list"].list)
      s.dashpots.push_back({p["a"].integer(), p["b"].integer(), p["coefficient"].number()});
  if (const Json* bending = s.term("bending"))
    for (const Json& p : (*bending)["list"].list)
      s.bending.push_back({p["particles"].integers(), p["weights"].numbers(), p["stiffness"].number()});
  if (const Json* wind = s.term("wind")) s.wind = wind_of(*wind);
  if (const Json* spheres = s.term("sphere"))
    for (const Json& p : (*spheres)["list"].list)
      s.spheres.push_back({p["centre"].vec(), p["radius"].number(), p["margin"].number(), p["friction"].number(),
                           p["restitution"].number(),
                           p.has("motion") ? std::optional(motion_of(p["motion"])) : std::nullopt});
  if (const Json* planes = s.term("plane"))
    for (const Json& p : (*planes)["list"].list)
      s.planes.push_back({p["point"].vec(), p["normal"].vec(), p.has("velocity") ? p["velocity"].vec() : Vec{},
                          p["margin"].number(), p["friction"].number(), p["restitution"].number()});
  if (const Json* gravity = s.term("gravity")) s.gravity = (*gravity)["acceleration"].vec();
  if (const Json* drag = s.term("drag")) s.drag = (*drag)["coefficient"].numbers();
  for (const Json& option : s.json["options"].list) s.options.push_back(option.text);
  return s;
}

// Forces by the laws of PROTOCOL.md, for engines that accept external forces. All functions add to f (N).

/// Returns the number of springs with coincident ends, which exert no force.
inline long add_springs(const Scene& scene, const std::vector<Vec>& x, std::vector<Vec>& f) {
  long coincident = 0;
  const bool hooke = scene.spring_law == "hooke";
  for (const Spring& s : scene.springs) {
    const Vec d = x[s.a] - x[s.b];
    const double l = length(d), r = s.rest_length;
    coincident += l == 0;
    if (l == 0) continue;
    const Vec pull = s.stiffness * (hooke ? (l - r) / l : (l * l - r * r) / (l * l + r * r)) * d;
    f[s.a] = f[s.a] - pull;
    f[s.b] = f[s.b] + pull;
  }
  return coincident;
}

inline void add_dashpots(const Scene& scene, const std::vector<Vec>& x, const std::vector<Vec>& v,
                         std::vector<Vec>& f) {
  for (const Dashpot& p : scene.dashpots) {
    const Vec d = x[p.a] - x[p.b];
    const double squared = dot(d, d);
    if (squared == 0) continue;
    const Vec pull = (p.coefficient * dot(v[p.a] - v[p.b], d) / squared) * d;
    f[p.a] = f[p.a] - pull;
    f[p.b] = f[p.b] + pull;
  }
}

inline void add_bending(const Scene& scene, const std::vector<Vec>& x, std::vector<Vec>& f) {
  for (const Stencil& s : scene.bending) {
    Vec c{};
    for (size_t i = 0; i < s.particles.size(); ++i) c = c + s.weights[i] * x[s.particles[i]];
    for (size_t i = 0; i < s.particles.size(); ++i)
      f[s.particles[i]] = f[s.particles[i]] - (s.stiffness * s.weights[i]) * c;
  }
}

inline void add_wind(const Scene& scene, double t, std::vector<Vec>& f) {
  const Vec w = scene.wind_at(t);
  for (size_t i = 0; i < f.size(); ++i) f[i] = f[i] + scene.mass[i] * w;
}

/// Sets f (N) to the sum of springs, dashpots, bending and wind.
inline void set_forces(const Scene& scene, const std::vector<Vec>& x, const std::vector<Vec>& v, double t,
                       std::vector<Vec>& f) {
  f.assign(x.size(), Vec{});
  add_springs(scene, x, f);
  add_dashpots(scene, x, v, f);
  add_bending(scene, x, f);
  add_wind(scene, t, f);
}

/// Options in the method's name, such as "n=4" and "springs=tendon". Each get() declares one option.
class Options {
 public:
  explicit Options(const Scene& scene) : asked_(scene.options) {}
  /// Value of an option: a whole number from 1 to a million.
  int get(const std::string& name, int otherwise) {
    const std::string text = value(name, name + "=" + std::to_string(otherwise), std::to_string(otherwise));
    const bool digits = text.size() < 8 && text.find_first_not_of("0123456789") == std::string::npos;
    const int number = digits ? std::atoi(text.c_str()) : 0;
    if (number < 1 || number > 1000000)
      unsupported("option " + name + "=" + text + ": expected a whole number from 1 to 1000000");
    return number;
  }
  /// Value of an option: one of `values`, of which the first is the default.
  std::string get(const std::string& name, std::initializer_list<const char*> values) {
    std::string list;
    for (const char* v : values) list += std::string(list.empty() ? "" : "|") + v;
    const std::string text = value(name, name + "=" + list, *values.begin());
    for (const char* v : values)
      if (text == v) return text;
    unsupported("option " + name + "=" + text + ": expected " + name + "=" + list);
  }
  /// Ends the program as unsupported if there are options that no get() has declared.
  void refuse_others() const {
    for (const std::string& option : asked_)
      unsupported("unknown option " + option + ": expected " + (expected_.empty() ? "none" : expected_));
  }

 private:
  std::string value(const std::string& name, const std::string& shown, std::string text) {
    expected_ += (expected_.empty() ? "" : ", ") + shown;
    for (size_t i = 0; i < asked_.size(); ++i)
      if (asked_[i].compare(0, name.size() + 1, name + "=") == 0) {
        text = asked_[i].substr(name.size() + 1);
        asked_.erase(asked_.begin() + static_cast<std::ptrdiff_t>(i--));
      }
    return text;
  }
  std::vector<std::string> asked_;
  std::string expected_;
};

/// Writes frames x particles x 3, float64, for numpy.load. Little-endian machines only.
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

// run.json: the program's report on its run.

/// Values that are not written to run.json: unknown ones, and infinite stiffnesses, because JSON has no infinity.
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double hard = std::numeric_limits<double>::infinity();

/// A sphere in the engine.
struct Ball {
  Vec centre;                                        // m, at the start
  double radius = unknown;                           // m, distance from the centre at which particles touch
  double friction = unknown, restitution = unknown;  // mu, e
};

/// A plane in the engine: the face that particles touch.
struct Face {
  Vec point, normal;                                 // m, at the start; unit vector
  double friction = unknown, restitution = unknown;  // mu, e
};

/// Prescribed positions at a later time.
struct Places {
  double t;                      // s
  std::vector<Vec> pins;         // m, in the scene's order
  std::vector<Vec> centres;      // m, of spheres
  std::vector<Vec> points = {};  // m, of planes
};

/// Forces at a state of the program's choice. An empty list is not reported; zeros mean that the engine has no such
/// force.
struct Probe {
  double t = 0;                              // s
  std::vector<Vec> x, v;                     // m, m/s
  std::vector<Vec> springs, dashpots, wind;  // N: at x; at x and v; at x and t with the free particles at rest
  std::vector<Vec> bending = {};             // N, at x
};

/// Input of the parity certificate, with the keys of PROTOCOL.md. Read it from the engine's own data, not from the
/// scene.
struct Readback {
  std::vector<double> mass;   // kg; arbitrary for pins
  std::vector<char> pinned;   // 1 if pinned
  std::vector<Spring> links;  // springs, then constraints, in the scene's order; stiffness may be `hard` or `unknown`
  std::optional<Vec> gravity = {};                // m/s^2
  std::string precision = "double";               // or "single"
  std::optional<std::vector<double>> drag = {};   // 1/s, c / m per particle
  std::optional<std::vector<Ball>> spheres = {};  // an empty list: the engine has none
  std::optional<std::vector<Face>> planes = {};   // an empty list: the engine has none
  double margin = unknown;                        // m
  std::optional<bool> may_sleep = {};
  double step = unknown;                        // s
  std::vector<Vec> start_x = {}, start_v = {};  // m, m/s: state before the first step
  std::optional<Places> later = {};
  std::optional<Probe> probe = {};
  std::map<std::string, std::string> mapped = {}, settings = {};
};

struct RunReport {
  double cpu_seconds = unknown;                                      // stepping only
  long steps = -1, force_evaluations = -1, coincident_springs = -1;  // negative: not counted
  double step = unknown;                                             // s, as used
  std::string verdict = {}, reason = {};        // for a failed run: energy, stretch, nan, solver, frozen
  double end = unknown;                         // s, time of failure
  std::vector<std::string> different_law = {};  // "ingredient: how its law differs"
  std::optional<Readback> readback = {};
  std::string engine = {};  // name and version: "MuJoCo 2.2.2"
  bool adaptive = false;    // the engine chooses its steps
};

/// A state that shows the force laws: the initial positions, stretched about the origin by a tenth, or by more if a
/// spring would be within a hundredth of its rest length. Its velocities point outwards, so that dashpots act too, and
/// it is bent if the scene has bending.
inline Probe probe_state(const Scene& scene) {
  const double bend = scene.bending.empty() ? 0 : 0.1 / scene.json["size"].number();  // 1/m
  for (int tenths = 11;; ++tenths) {
    Probe probe;
    for (const Vec& x : scene.x) {
      const double s = x[0] + 0.7 * x[1] + 0.4 * x[2];
      probe.x.push_back(tenths / 10. * x + Vec{0, 0, bend * s * s});
      probe.v.push_back(0.5 * x);  // 0.5 /s
    }
    const bool shows = std::all_of(scene.springs.begin(), scene.springs.end(), [&](const Spring& s) {
      const double l = length(probe.x[s.a] - probe.x[s.b]);
      return l == 0 || std::abs(l - s.rest_length) > 0.01 * s.rest_length;
    });
    if (shows || tenths == 30) return probe;  // larger stretches are not tried: some springs stay unattested
  }
}

/// For each spring, the coefficient (N s/m) of the dashpots parallel to it, for engines whose springs have their own
/// damping. Of parallel springs, only the first has it. Dashpots without a parallel spring are added to `others`.
inline std::vector<double> damping_of_springs(const Scene& scene, std::vector<Dashpot>& others) {
  std::map<std::pair<int, int>, size_t> first;
  for (size_t i = 0; i < scene.springs.size(); ++i) first.emplace(std::pair{scene.springs[i].a, scene.springs[i].b}, i);
  std::vector<double> damping(scene.springs.size(), 0);
  for (const Dashpot& p : scene.dashpots)
    if (const auto at = first.find({p.a, p.b}); at != first.end())
      damping[at->second] += p.coefficient;
    else
      others.push_back(p);
  return damping;
}

/// The probe at the state `p`, for an engine whose springs, dashpots, bending and wind are computed by the functions
/// above.
inline Probe probe_of_forces(const Scene& scene, Probe p) {
  p.t = 0.3;  // s; gusts have begun
  p.springs = p.dashpots = p.bending = p.wind = std::vector<Vec>(p.x.size(), Vec{});
  add_springs(scene, p.x, p.springs);
  add_dashpots(scene, p.x, p.v, p.dashpots);
  add_bending(scene, p.x, p.bending);
  add_wind(scene, p.t, p.wind);
  return p;
}
inline Probe probe_of_forces(const Scene& scene) { return probe_of_forces(scene, probe_state(scene)); }

/// A spring that the engine solves as a constraint, from the engine's own data.
struct SoftJoint {
  double stiffness, rest_length, damping;  // N/m, m, N s/m
};

/// Fills links and probe for an engine that represents each of the scene's springs by one of `joints`, which obey
/// `law`, and applies the springs and dashpots of `forced` as forces. Without joints, all springs are forces.
inline void read_back_joints(const Scene& scene, const Scene& forced, const std::vector<SoftJoint>& joints,
                             const std::string& law, RunReport& run) {
  Readback& r = *run.readback;
  r.probe = probe_of_forces(forced, probe_state(scene));
  r.links = scene.springs;
  if (joints.empty()) return;
  Scene damped = scene;
  damped.dashpots.clear();
  for (size_t i = 0; i < joints.size(); ++i) {
    r.links[i].stiffness = joints[i].stiffness, r.links[i].rest_length = joints[i].rest_length;
    damped.dashpots.push_back({r.links[i].a, r.links[i].b, joints[i].damping});
  }
  add_dashpots(damped, r.probe->x, r.probe->v, r.probe->dashpots);
  r.probe->springs.clear();
  run.different_law.push_back("springs: " + law);
  if (!scene.dashpots.empty()) run.different_law.push_back("dashpots: implicit, in the joints of springs");
}

/// Writes JSON: numbers with all digits, lists, objects without keys that have no value.
class JsonWriter {
 public:
  static std::string of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
  }
  static std::string of(long value) { return std::to_string(value); }
  static std::string of(int value) { return std::to_string(value); }
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
    return JsonWriter()("a", s.a)("b", s.b)("rest_length", s.rest_length)("stiffness", s.stiffness).object();
  }
  static std::string of(const Ball& s) {
    JsonWriter w;
    return w("centre", s.centre)("radius", s.radius)("friction", s.friction)("restitution", s.restitution).object();
  }
  static std::string of(const Face& f) {
    JsonWriter w;
    return w("point", f.point)("normal", f.normal)("friction", f.friction)("restitution", f.restitution).object();
  }
  static std::string of(const Places& p) {
    return JsonWriter()("t", p.t)("pins", p.pins)("centres", p.centres).unless_empty("points", p.points).object();
  }
  static std::string of(const Probe& p) {
    JsonWriter w;
    w("t", p.t)("x", p.x)("v", p.v).unless_empty("springs", p.springs).unless_empty("dashpots", p.dashpots);
    return w.unless_empty("bending", p.bending).unless_empty("wind", p.wind).object();
  }
  static std::string of(const std::map<std::string, std::string>& texts) {
    JsonWriter w;
    for (const auto& text : texts) w(text.first, text.second);
    return w.object();
  }
  static std::string of(const Readback& r) {
    JsonWriter w;
    w("precision", r.precision)("mass", r.mass)("pinned", r.pinned)("links", r.links)("gravity", r.gravity);
    w("drag", r.drag)("spheres", r.spheres)("margin", r.margin)("planes", r.planes)("may_sleep", r.may_sleep);
    w("step", r.step)("later", r.later)("probe", r.probe);
    if (!r.start_x.empty()) w.add_raw("start", JsonWriter()("x", r.start_x)("v", r.start_v).object());
    return w.unless_empty("mapped", r.mapped).unless_empty("settings", r.settings).object();
  }
  template <class T>
  static std::string of(const std::vector<T>& list) {
    std::string out = "[";
    for (const T& item : list) out += (out.size() > 1 ? ", " : "") + of(item);
    return out + ']';
  }

  JsonWriter& operator()(const std::string& key, double value) {
    return std::isfinite(value) ? add_raw(key, of(value)) : *this;
  }
  template <class T>
  JsonWriter& operator()(const std::string& key, const std::optional<T>& value) {
    return value ? add_raw(key, of(*value)) : *this;
  }
  template <class T>
  JsonWriter& operator()(const std::string& key, const T& value) {
    return add_raw(key, of(value));
  }
  template <class T>
  JsonWriter& unless_empty(const std::string& key, const T& value) {
    return value.empty() ? *this : add_raw(key, of(value));
  }
  JsonWriter& count(const std::string& key, long number) { return number < 0 ? *this : add_raw(key, of(number)); }
  std::string object() const { return '{' + members_ + '}'; }

 private:
  JsonWriter& add_raw(const std::string& key, const std::string& value) {
    members_ += (members_.empty() ? "" : ",\n ") + of(key) + ": " + value;
    return *this;
  }
  std::string members_;
};

inline void write_run_json(const std::string& file, const RunReport& run) {
  JsonWriter w;
  w.unless_empty("engine", run.engine)("cpu_seconds", run.cpu_seconds).count("steps", run.steps);
  w.count("force_evaluations", run.force_evaluations).count("coincident_springs", run.coincident_springs);
  w("step", run.step)("end", run.end).unless_empty("verdict", run.verdict).unless_empty("reason", run.reason);
  if (run.adaptive) w("adaptive", true);
  w.unless_empty("different_law", run.different_law)("readback", run.readback);
  std::ofstream out(file);
  out << w.object() << '\n';
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

/// An engine with one scene. The constructor may refuse the scene (`unsupported`, Scene::require_only, Options).
struct World {
  virtual ~World() = default;
  /// Advances from t to t + scene.step (s), including prescribed motions. An exception ends the run.
  virtual void step(double t) = 0;
  /// Copies positions (m) and velocities (m/s) in the scene's order; both vectors already have the right size.
  virtual void read(std::vector<Vec>& x, std::vector<Vec>& v) = 0;
  /// Completes the report: `engine`, counts, differing laws, and a read-back of the engine's own data with at least
  /// `mass`, `pinned` and `links`. Already filled in: times, steps and, from the values that read() returned, `start`
  /// and the pins of `later`.
  virtual void report(RunReport& report) = 0;
};

/// Steps the world through the scene's samples, until a state is not finite or step() throws. Only step() is timed.
inline RunReport run_world(const Scene& scene, World& world, std::vector<std::vector<Vec>>& frames,
                           std::vector<std::vector<Vec>>& speeds) {
  std::vector<Vec> x(scene.x.size()), v(scene.x.size());
  const auto sample = [&] {
    world.read(x, v);
    frames.push_back(x), speeds.push_back(v);
    bool finite = true;
    for (size_t i = 0; i < x.size(); ++i) finite &= std::isfinite(dot(x[i], x[i]) + dot(v[i], v[i]));
    return finite;
  };
  sample();
  RunReport report;
  Readback& r = report.readback.emplace();
  r.start_x = x, r.start_v = v, r.step = scene.step;
  std::clock_t cpu = 0;
  report.steps = 0;
  while (report.verdict.empty() && frames.size() <= static_cast<size_t>(scene.samples)) {
    const std::clock_t begin = std::clock();
    try {
      for (int i = 0; i < scene.steps_per_sample; ++i, ++report.steps)
        world.step(static_cast<double>(report.steps) * scene.step);
    } catch (const std::exception& error) {
      report.verdict = "solver", report.reason = error.what();
    }
    cpu += std::clock() - begin;
    report.end = static_cast<double>(report.steps) * scene.step;
    if (report.verdict.empty() && !sample()) report.verdict = "nan", report.reason = "a state is not finite";
  }
  report.cpu_seconds = static_cast<double>(cpu) / CLOCKS_PER_SEC;
  if (report.verdict.empty()) {
    const int some = (382 * scene.samples + 999) / 1000;  // an inner sample, at which moved pins are unlikely to be at
                                                          // their initial positions
    r.later = Places{some * scene.steps_per_sample * scene.step, {}, {}};
    for (const int pin : scene.pins) r.later->pins.push_back(frames[static_cast<size_t>(some)][pin]);
    report.end = unknown;
  }
  world.report(report);
  if (report.readback && report.readback->mass.empty()) report.readback.reset();
  if (report.readback && !report.adaptive && !std::isfinite(report.step)) report.step = report.readback->step;
  return report;
}

/// An adapter's main function: reads the task, runs the world that `make` builds, writes the three files. Exit status:
/// 3 if the scene is refused, 1 after any other error.
inline int run_program(int argc, char** argv, std::unique_ptr<World> (*make)(const Scene&)) {
  try {
    if (argc != 3) throw std::runtime_error(std::string("usage: ") + argv[0] + " scene.json OUTDIR");
    const Scene scene = read_scene(argv[1]);
    const std::unique_ptr<World> world = make(scene);
    std::vector<std::vector<Vec>> frames, speeds;
    const RunReport report = run_world(scene, *world, frames, speeds);
    write_npy(std::string(argv[2]) + "/trajectory.npy", frames);
    write_npy(std::string(argv[2]) + "/velocities.npy", speeds);
    write_run_json(std::string(argv[2]) + "/run.json", report);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
  return 0;
}
template <class Engine>  // a World constructed from a Scene
int run_program(int argc, char** argv) {
  return run_program(argc, argv, [](const Scene& s) -> std::unique_ptr<World> { return std::make_unique<Engine>(s); });
}

}  // namespace crosscheck_engine
