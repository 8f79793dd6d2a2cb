// The fingerprint of a scene: FNV-1a (64 bit) over the exact bits of everything that engines see.
#include <fmt/format.h>

#include <bit>
#include <cstdint>

#include "mysim/fnv.h"
#include "mysim/scene.h"

namespace crosscheck {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) bytes_.add(static_cast<unsigned char>(word >> (8 * i)));
  }
  void add(int value) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value))); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::string_view text) {
    for (char c : text) add(static_cast<int>(c));
    add(-1);
  }
  template <class Derived>
  void add(const Eigen::DenseBase<Derived>& values) {
    add(static_cast<int>(values.size()));
    for (int j = 0; j < values.cols(); ++j)
      for (int i = 0; i < values.rows(); ++i) add(static_cast<double>(values(i, j)));
  }

  void term(const Rotation& t) { add(t.rate); }
  void term(const Gravity& t) { add(t.acceleration); }
  void term(const Springs& t) {
    for (const Spring& s : t.list) add(s.a), add(s.b), add(s.k), add(s.rest);
    if (t.law != SpringLaw::hooke) add(name_of(t.law));
  }
  void term(const Dashpots& t) {
    for (const auto& [a, b, c] : t.list) add(a), add(b), add(c);
  }
  void term(const Constraints& t) {
    for (const auto& [a, b, length] : t.list) add(a), add(b), add(length);
  }
  void term(const Drag& t) { add(t.c); }
  void term(const Wind& t) { blowing(t.acceleration); }
  void term(const Aerodynamics& t) {
    add(t.density), add(t.coefficient), blowing(t.velocity);
    for (const auto& triangle : t.triangles)
      for (int corner : triangle) add(corner);
  }
  void term(const Spheres& t) {
    for (const Sphere& s : t.list) {
      add(s.centre), add(s.radius), add(s.margin), add(s.friction), add(s.restitution);
      if (s.motion) motion(*s.motion);
    }
  }
  void motion(const Motion& m) { add(m.amplitude), add(m.frequency), add(m.ramp); }

  std::uint64_t value() const { return bytes_.value(); }

 private:
  void blowing(const Blowing& b) {
    add(b.mean);
    if (b.gusts) add(b.gusts->variation), add(b.gusts->side), add(b.gusts->seed);
  }

  Fnv1a bytes_;
};

}  // namespace

std::string hash_of(const Scene& scene) {
  Hash h;
  const Particles& p = scene.model.particles;
  h.add(p.mass);
  for (int pin : p.pins) h.add(pin);
  h.add(-1);
  if (p.move) h.motion(*p.move);
  for (const Term& term : scene.model.terms) {
    h.add(name_of(term));
    std::visit([&](const auto& t) { h.term(t); }, term);
  }
  h.add(scene.start.x);
  h.add(scene.start.v);
  return fmt::format("{:016x}", h.value());
}

}  // namespace crosscheck
