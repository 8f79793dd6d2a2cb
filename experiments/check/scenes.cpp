// The smallest scenes that show relations. Their steps are 2^-10 s, which every precision holds exactly, and a tenth of
// what is stable: explicit Euler's growth of 1 + (h omega)^2 / 2 a step stays below tenfold in a second.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "experiments/check/transformations.h"

namespace crosscheck {
namespace {

constexpr double step = 0x1p-10;  // s

/// The text of a scene, particle by particle; a spring's rest length is its length at the start times a factor.
class SmallScene {
 public:
  SmallScene(double duration, int samples)
      : text_(fmt::format("question = \"Does a relation hold?\"\nparameters = \"The smallest that shows it.\"\n[time]\n"
                          "duration = {0}\nsamples = {1}\nstep = {2}\nwindow = {0}\ntolerance = 1e-3\n"
                          "method = \"leapfrog\"\n",
                          duration, samples, step)) {}
  void particle(const Vec3& x, double mass, const Vec3& v = Vec3::Zero()) {
    places_.push_back(x);
    text_ += fmt::format("[[particle]]\nposition = [{}, {}, {}]\nmass = {}\n", x[0], x[1], x[2], mass);
    if (!v.isZero(0)) text_ += fmt::format("velocity = [{}, {}, {}]\n", v[0], v[1], v[2]);
  }
  void spring(int a, int b, double k, double rest = 1, double dashpot = 0) {
    text_ += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = {}\n", a, b, k,
                         rest * (places_[a] - places_[b]).norm());
    if (dashpot > 0) text_ += fmt::format("dashpot = {}\n", dashpot);
  }
  void add(const std::string& more) { text_ += more; }
  void gravity() { add("[gravity]\nacceleration = [0, -9.81, 0]\n"); }
  Scene scene(const std::string& name) const { return parse_scene(text_, name); }

 private:
  std::string text_;
  std::vector<Vec3> places_;
};

constexpr auto first_pinned = "[pins]\nparticles = [0]\n";

/// Five particles in motion between eight springs, which start up to a twentieth too long or too short; the first is
/// held, or moves too.
SmallScene net_of(bool held) {
  SmallScene s(1, 16);
  s.particle({0, 0, 0}, 0.3, held ? Vec3(0, 0, 0) : Vec3(0.3, 0.2, -0.1));
  s.particle({0.5, 0, 0.1}, 0.2, {-0.2, 0.1, 0.4});
  s.particle({0.1, -0.5, 0}, 0.25, {0.1, -0.3, 0.2});
  s.particle({0.6, -0.45, 0.2}, 0.3, {0.4, 0.2, -0.3});
  s.particle({0.3, -0.9, -0.1}, 0.2, {-0.1, 0.2, 0.1});
  s.spring(0, 1, 40, 0.97), s.spring(0, 2, 50, 1.04), s.spring(1, 3, 60, 0.96), s.spring(2, 3, 45, 1.03);
  s.spring(1, 2, 40, 1.02), s.spring(3, 4, 50, 0.98), s.spring(2, 4, 55, 1.05), s.spring(0, 3, 40, 0.95);
  if (held) s.add(first_pinned), s.gravity();
  return s;
}

/// A tetrahedron whose springs are as long as at rest.
SmallScene tetrahedron(double stiffness, double dashpot) {
  SmallScene s(1, 16);
  s.particle({0, 0, 0}, 0.2), s.particle({0.5, 0.1, 0}, 0.3);
  s.particle({0.2, 0.5, 0.1}, 0.25), s.particle({0.2, 0.1, 0.6}, 0.4);
  for (const auto [a, b] : {std::array{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}})
    s.spring(a, b, stiffness * (1 + 0.1 * a), 1, dashpot);
  return s;
}

SmallScene hanging_chain(double gamma, double dashpot) {
  SmallScene s(8, 32);
  for (int i = 0; i < 4; ++i) s.particle({0, -0.5 * i, 0}, 0.1);
  for (int i = 0; i < 3; ++i) s.spring(i, i + 1, 20 + 10 * i, 1, dashpot);
  s.add(first_pinned), s.gravity();
  if (gamma > 0) s.add(fmt::format("[drag]\ngamma = {}\n", gamma));
  return s;
}

}  // namespace

std::vector<Scene> small_nets() { return {net_of(true).scene("small-net")}; }

std::vector<Scene> falling_nets() {
  SmallScene soft = tetrahedron(20, 0), stiff = tetrahedron(100, 0), damped = tetrahedron(50, 0.5);
  for (SmallScene* s : {&soft, &stiff, &damped}) s->gravity();
  return {soft.scene("falling-soft"), stiff.scene("falling-stiff"), damped.scene("falling-damped")};
}

std::vector<Scene> resting_nets() { return {tetrahedron(50, 0).scene("resting-net")}; }

std::vector<Scene> flying_nets() { return {net_of(false).scene("flying-net")}; }

std::vector<Scene> vibrating_nets() {
  // one spring exchanges no energy with others: what its energy swings by, it swings by in every turn
  SmallScene s(16, 512);
  s.particle({0, 0, 0}, 0.2, {0.3, 0.4, -0.1}), s.particle({0.5, 0.1, 0}, 0.3, {-0.1, -0.5, 0.2});
  s.spring(0, 1, 40, 0.9);
  return {s.scene("dumbbell")};
}

std::vector<Scene> symmetric_nets() {
  SmallScene s(1, 16);
  for (int i = 0; i < 5; ++i) s.particle({-0.5 + 0.25 * i, i == 2 ? 0 : 0.05, 0.02 * std::abs(i - 2)}, 0.2);
  for (int i = 0; i < 4; ++i) s.spring(i, i + 1, 50);
  for (int i = 0; i < 3; ++i) s.spring(i, i + 2, 40);
  s.add("[pins]\nparticles = [2]\n"), s.gravity();
  return {s.scene("hanging-strip")};
}

std::vector<Scene> pinned_nets() {
  Scene standing = small_nets()[0], moved = standing;
  standing.name = "standing-pin", moved.name = "moved-pin";
  moved.model.particles.move = Motion{{0.05, 0.02, -0.03}, 2, 0.25};
  moved.hash = hash_of(moved);
  return {standing, moved};
}

std::vector<Scene> hanging_chains_in_drag() { return {hanging_chain(5, 0).scene("chain-in-drag")}; }

std::vector<Scene> hanging_chains() {
  return {hanging_chain(5, 0).scene("chain-in-drag"), hanging_chain(0, 3).scene("chain-with-dashpots")};
}

}  // namespace crosscheck
