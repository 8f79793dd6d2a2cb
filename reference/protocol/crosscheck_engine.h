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
#include <map>
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

/// What the certificate sees: read it from your engine's own data, not from the scene.
struct Readback {
  std::vector<double> mass;
  std::vector<char> pinned;
  std::vector<Spring> links;  // in the scene's order
  Vec gravity{};
  std::string precision = "double";
};

inline std::string json_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

inline void write_run_json(const std::string& file, double cpu_seconds, long steps, long force_evaluations,
                           const Readback* readback = nullptr) {
  std::ofstream out(file);
  out << "{\"cpu_seconds\": " << json_of(cpu_seconds) << ", \"steps\": " << steps
      << ", \"force_evaluations\": " << force_evaluations;
  if (readback) {
    const char* comma = "";
    out << ",\n \"readback\": {\"precision\": \"" << readback->precision << "\", \"mass\": [";
    for (double m : readback->mass) out << std::exchange(comma, ", ") << json_of(m);
    out << "],\n  \"pinned\": [";
    comma = "";
    for (char p : readback->pinned) out << std::exchange(comma, ", ") << int(p);
    out << "],\n  \"links\": [";
    comma = "";
    for (const Spring& s : readback->links)
      out << std::exchange(comma, ", ") << "{\"a\": " << s.a << ", \"b\": " << s.b
          << ", \"rest_length\": " << json_of(s.rest_length) << ", \"stiffness\": " << json_of(s.stiffness) << "}";
    out << "],\n  \"gravity\": [" << json_of(readback->gravity[0]) << ", " << json_of(readback->gravity[1]) << ", "
        << json_of(readback->gravity[2]) << "]}";
  }
  out << "}\n";
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace crosscheck_engine
