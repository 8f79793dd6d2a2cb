#include "tests/hunt/draft.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace crosscheck {

double to_digits(double value, int digits) {
  const std::string text = fmt::format("{:.{}g}", value, digits);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

namespace {

/// Adds 0 to remove the sign of -0.
std::string list(const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0] + 0.0, v[1] + 0.0, v[2] + 0.0); }

std::string motion_text(const Motion& m) {
  return fmt::format("amplitude = {}\nfrequency = {}\nramp = {}\n", list(m.amplitude), m.frequency, m.ramp);
}

std::string particle_text(const SceneDraft::Particle& p, bool first_order) {
  std::string text = fmt::format("\n[[particle]]\nposition = {}\n", list(p.x));
  if (first_order) return text;
  text += fmt::format("mass = {}\n", p.mass);
  if (!p.v.isZero(0) && !p.pinned) text += fmt::format("velocity = {}\n", list(p.v));
  return text;
}

std::string spring_text(const SceneDraft::Link& s) {
  std::string text = fmt::format("\n[[spring]]\nends = [{}, {}]\nstiffness = {}\n", s.a, s.b, s.k);
  if (s.rest) text += fmt::format("rest = {}\n", *s.rest);
  if (s.dashpot > 0) text += fmt::format("dashpot = {}\n", s.dashpot);
  if (s.family != Family::single) text += fmt::format("family = \"{}\"\n", name_of(s.family));
  return text;
}

std::string wind_text(const SceneDraft::Breeze& w) {
  std::string text = fmt::format("\n[wind]\nacceleration = {}\n", list(w.mean));
  if (w.gusts)
    text += fmt::format("[wind.gusts]\nvariation = {}\nside = {}\nseed = {}\n", w.gusts->variation, list(w.gusts->side),
                        w.gusts->seed);
  return text;
}

std::string sphere_text(const Sphere& s) {
  std::string text = fmt::format("\n[[sphere]]\ncentre = {}\nradius = {}\n", list(s.centre), s.radius);
  if (s.margin > 0) text += fmt::format("margin = {}\n", s.margin);
  if (s.friction > 0) text += fmt::format("friction = {}\n", s.friction);
  if (s.restitution > 0) text += fmt::format("restitution = {}\n", s.restitution);
  if (s.motion) text += "[sphere.motion]\n" + motion_text(*s.motion);
  return text;
}

}  // namespace

double SceneDraft::largest_rate() const {
  std::vector<double> pull(particles.size(), 0), damping(particles.size(), 0);
  for (const Link& s : springs)
    for (const int end : {s.a, s.b}) {
      const double mass = particles[static_cast<size_t>(end)].mass;
      pull[static_cast<size_t>(end)] += s.k / mass, damping[static_cast<size_t>(end)] += s.dashpot / mass;
    }
  const double stiffer = law == SpringLaw::bullet_link ? 1.25 : 1;
  return std::max({std::sqrt(2 * stiffer * *std::ranges::max_element(pull)), 2 * *std::ranges::max_element(damping),
                   gamma.value_or(0), std::abs(rotation.value_or(0))});
}

std::string SceneDraft::kind() const {
  std::vector<std::string_view> words;
  const auto any = [&](bool there, std::string_view word) {
    if (there) words.push_back(word);
  };
  any(rotation.has_value(), "rotation");
  any(std::ranges::any_of(particles, &Particle::pinned), pin_motion ? "moved-pins" : "pins");
  any(!springs.empty(), law == SpringLaw::hooke ? "springs" : "links");
  any(std::ranges::any_of(springs, [](const Link& s) { return s.dashpot > 0; }), "dashpots");
  any(!constraints.empty(), "constraints");
  any(gravity.has_value(), "gravity");
  any(gamma.has_value(), "drag");
  any(wind.has_value(), wind && wind->gusts ? "gusts" : "wind");
  any(!spheres.empty(), "sphere");
  return words.empty() ? "free" : fmt::format("{}", fmt::join(words, "-"));
}

std::string SceneDraft::text() const {
  std::string text = fmt::format(
      "question = \"Does a relation hold?\"\nparameters = \"Drawn at random.\"\n\n[time]\nduration = {0}\n"
      "samples = {1}\nstep = {2}\nwindow = {0}\ntolerance = 1e-3\nmethod = \"{3}\"\n",
      duration, samples, step, rotation ? "rk4" : "leapfrog");
  for (const Particle& p : particles) text += particle_text(p, rotation.has_value());
  for (const Link& s : springs) text += spring_text(s);
  for (const auto& ends : constraints) text += fmt::format("\n[[constraint]]\nends = {}\n", ends);
  if (law != SpringLaw::hooke && !springs.empty()) text += fmt::format("\n[springs]\nlaw = \"{}\"\n", name_of(law));
  std::vector<int> pins;
  for (int i = 0; i < size(); ++i)
    if (particles[i].pinned) pins.push_back(i);
  if (!pins.empty()) text += fmt::format("\n[pins]\nparticles = {}\n", pins);
  if (!pins.empty() && pin_motion) text += "[pins.motion]\n" + motion_text(*pin_motion);
  if (rotation) text += fmt::format("\n[rotation]\nrate = {}\n", *rotation);
  if (gravity) text += fmt::format("\n[gravity]\nacceleration = {}\n", list(*gravity));
  if (gamma) text += fmt::format("\n[drag]\ngamma = {}\n", *gamma);
  if (wind) text += wind_text(*wind);
  for (const Sphere& s : spheres) text += sphere_text(s);
  return text;
}

Scene SceneDraft::scene() const { return parse_scene(text(), kind()); }

}  // namespace crosscheck
