#include "experiments/disagreements/disagreements.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "experiments/disagreements/effects.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"

namespace crosscheck {
namespace {

using namespace effects;
constexpr auto apart = Condition::Kind::apart, within = Condition::Kind::within, hangs = Condition::Kind::hangs;

/// If threads are known, the last paragraph of a section in disagreements.md begins with "Upstream: ".
void add_texts(Disagreement& row) {
  static const std::string file =
      read_file(data_folder() / "experiments/disagreements/disagreements.md", "the texts of disagreements");
  const std::string heading = fmt::format("\n# {}\n", row.name);
  const size_t at = file.find(heading);
  if (at == std::string::npos) throw std::logic_error("disagreements.md has no section " + row.name);
  std::istringstream section(file.substr(at + heading.size()));
  std::string blank, upstream;
  std::getline(section, row.what) && std::getline(section, blank) && std::getline(section, row.cause) &&
      std::getline(section, blank) && std::getline(section, upstream);
  if (upstream.starts_with("Upstream: ")) row.threads = upstream.substr(10);
}

std::vector<Disagreement> table() {
  return {
      {"pbd-friction",
       "bullet/pbd",
       "distance slid",
       "m",
       {{"Coulomb's law, mysim", "mysim/leapfrog"},
        {"Bullet, deformable", "bullet/deformable-explicit"},
        {"Bullet, position-based", "bullet/pbd"}},
       moved,
       friction_effect,
       // by Coulomb's law the distance is 0.29 m
       {{apart, 2, 0, 0.2}},
       {{within, 1, 0, 2e-3}}},
      {"pbd-stiffness",
       "bullet/pbd",
       "sag",
       "mm",
       {{"expected", "mysim/leapfrog"},
        {"1 iteration, 1/60 s", "bullet/pbd", 1. / 60},
        {"10 iterations, 1/60 s", "bullet/pbd+n=10", 1. / 60},
        {"1 iteration, 1/240 s", "bullet/pbd", 1. / 240},
        {"1 iteration, 1/1920 s", "bullet/pbd", 1. / 1920},
        {"the demos' settings, 1/60 s", "bullet/pbd+demo", 1. / 60}},
       sag,
       stiffness_effect,
       // bounds: half of the requested 5.9 mm, and a twentieth of it
       {{apart, 1, 0, 3}},
       {{within, 4, 0, 0.3}}},
      {"link-law",
       "bullet/pbd",
       "length",
       "m",
       {{"Hooke's law, mysim", "mysim/leapfrog"},
        {"Bullet, position-based", "bullet/pbd"},
        {"the link law, mysim", "mysim/leapfrog", 0, SpringLaw::bullet_link}},
       length,
       law_effect,
       // the length oscillates over a range of one metre
       {{apart, 1, 0, 0.2}},
       {{within, 2, 1, 0.05}}},
      {"implicit-freeze",
       "bullet/deformable-implicit",
       "length",
       "m",
       {{"implicit Euler, mysim", "mysim/implicit-euler"},
        {"Bullet, with projection", "bullet/deformable-implicit"},
        {"Bullet, without it", "bullet/deformable-implicit+unprojected"}},
       length,
       freeze_effect,
       // distances in the first sample, m; the run ends there
       {{apart, 2, 1, 0.01}},
       {{within, 1, 0, 1e-3}}},
      {"indefinite-hessian",
       "bullet/deformable-implicit",
       "total energy",
       "J",
       {{"implicit Euler, one Newton step, mysim", "mysim/implicit-euler+linear"},
        {"Bullet, negative part left out", "bullet/deformable-implicit"},
        {"Bullet, as shipped", "bullet/deformable-implicit+shipped"}},
       energy,
       hessian_effect,
       // the energy doubles from its initial 20 J
       {{apart, 2, 0, 20}},
       {{within, 1, 0, 1e-3}}},
      {"rest-lengths",
       "bullet",
       "length",
       "m",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet, explicit, flag left", "bullet/deformable-explicit+default-rest"},
        {"Bullet, position-based, flag left", "bullet/pbd+default-rest"},
        {"Bullet, explicit, flag cleared", "bullet/deformable-explicit"}},
       length,
       rest_effect,
       // bounds: the initial compression of 0.1 m; twice the largest difference of the two rules, which is h v at 2 m/s
       {{apart, 1, 0, 0.1}},
       {{within, 3, 0, 4e-3}}},
      {"wind-at-rest",
       "bullet/pbd",
       "speed along the wind",
       "m/s",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet's own wind", "bullet/pbd+own-wind"},
        {"Bullet, forces added to nodes", "bullet/pbd"}},
       along_wind,
       wind_effect,
       // the final speed is 2.4 m/s
       {{apart, 1, 0, 1}},
       {{within, 2, 0, 0.2}}},
      {"speed-clamp",
       "bullet/deformable-explicit",
       "distance",
       "m",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet, default margin of 0.25 m", "bullet/deformable-explicit+default-margin"},
        {"Bullet, margin of 10 m", "bullet/deformable-explicit"}},
       moved,
       clamp_effect,
       // bounds (m): a quarter of the distance of 80 m; g h t / 2 = 0.08 m, the difference between the two rules
       {{apart, 1, 0, 20}},
       {{within, 2, 0, 0.1}}},
      {"distance-field",
       "bullet/pbd",
       "height over the surface",
       "mm",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet, voxel of 0.25 m", "bullet/pbd+default-voxel"},
        {"Bullet, voxel of 0.02 m", "bullet/pbd"}},
       gap,
       field_effect,
       // bounds in mm: a^2 / 4R is 15.6 and 0.1 for the two grid sizes a
       {{apart, 1, 0, 1}},
       {{within, 2, 0, 0.1}}},
      {"contact-direction",
       "bullet/deformable-explicit",
       "direction of motion minus that of the tangent",
       "mrad",
       {{"mysim", "mysim/leapfrog"},
        {"Bullet, voxel of 5 mm", "bullet/deformable-explicit"},
        {"the same, a quarter of the step", "bullet/deformable-explicit", 1.25e-4},
        {"Bullet, voxel of 20 mm", "bullet/deformable-explicit+voxel=0.02"},
        {"Bullet, voxel of 1.25 mm", "bullet/deformable-explicit+voxel=0.00125"}},
       steeper,
       direction_effect,
       // bounds in mrad: a / 2R is 9.8 for a grid of 20 mm and 0.6 for 1.25 mm
       {{apart, 3, 0, 4}},
       {{within, 4, 0, 1.5}},
       directions},
      {"contact-hop",
       "bullet/deformable-explicit",
       "height over the surface",
       "mm",
       {{"mysim", "mysim/leapfrog"}, {"Bullet, deformable", "bullet/deformable-explicit"}},
       gap,
       hop_effect,
       // mm: (v h)^2 / 2R = 0.03 at 1.5 m/s
       {{apart, 1, 0, 0.01, 0.6}},
       {}},
      {"single-precision",
       "bullet32",
       "distance from mysim",
       "m",
       {{"mysim, double precision", "mysim/symplectic-euler"},
        {"Bullet, double precision", "bullet/deformable-explicit"},
        {"Bullet, single precision", "bullet32/deformable-explicit"}},
       nullptr,
       precision_effect,
       // bounds in m: rounding of 1.5 m to single precision; round-off of 3000 steps in double precision
       {{apart, 2, 0, 1e-7}},
       {{within, 1, 0, 1e-13}}},
      {"network-in-pieces",
       "bullet",
       "height of the lowest particle",
       "m",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet, in two pieces", "bullet32/deformable-explicit+in-pieces+timeout=0.5"},
        {"Bullet, joined by 1e-9 N/m", "bullet32/deformable-explicit+in-pieces+timeout=60", 0, SpringLaw::hooke, join}},
       lowest,
       pieces_effect,
       // without the hang, the run takes as long as that of the joined network; the second bound is twice g h t / 2
       {{hangs, 1, 2, 3}},
       {{within, 2, 0, 2e-3}}},
      {"one-stiffness",
       "bullet/deformable-explicit",
       "stretch of the second spring",
       "mm",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet, two bodies, two forces", "bullet/deformable-explicit+bodies"},
        {"Bullet, one body, one force", "bullet/deformable-explicit"}},
       second_stretch,
       one_stiffness_effect,
       // bounds (mm): a tenth of the stiffness lets the spring stretch by up to 196 mm instead of 20 mm; equal runs may
       // differ by the motion in one step, h v = 0.3 mm at the top speed of 0.31 m/s
       {{apart, 1, 0, 50}},
       {{within, 2, 0, 0.5}}},
      {"gravity-factor",
       "bullet/pbd",
       "distance fallen",
       "m",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet, position-based", "bullet/pbd+gravity-factor=0.5"},
        {"Bullet, deformable", "bullet/deformable-explicit+gravity-factor=0.5"}},
       moved,
       gravity_factor_effect,
       // the particle falls twice as far as the expected 4.9 m; g h t / 2 = 0.01 m
       {{apart, 1, 0, 4}},
       {{within, 2, 0, 0.02}}},
      {"stiffness-unused",
       "bullet/pbd",
       "sag",
       "mm",
       {{"100 N/m, mysim", "mysim/leapfrog"},
        {"1000 N/m, mysim", "mysim/leapfrog", 0, SpringLaw::hooke, ten_times_stiffer},
        {"100 N/m, position-based", "bullet/pbd+kLST=0.5+n=20"},
        {"1000 N/m, position-based", "bullet/pbd+kLST=0.5+n=20", 0, SpringLaw::hooke, ten_times_stiffer},
        {"100 N/m, deformable", "bullet/deformable-explicit"},
        {"1000 N/m, deformable", "bullet/deformable-explicit", 0, SpringLaw::hooke, ten_times_stiffer},
        {"100 N/m, deformable, kLST 0.01", "bullet/deformable-explicit+kLST=0.01"}},
       sag,
       unused_effect,
       // bounds: most of the 59 mm, and 0 (equal bit for bit); twice h v (0.3 mm at 0.3 m/s), and 0
       {{apart, 0, 1, 40}, {within, 2, 3, 0}},
       {{within, 4, 0, 0.6}, {within, 5, 1, 0.6}, {within, 6, 4, 0}}},
      {"over-relaxation",
       "bullet/pbd",
       "stretch",
       "mm",
       {{"1000 N/m, mysim", "mysim/leapfrog"},
        {"Bullet, kLST 1", "bullet/pbd+kLST=1"},
        {"Bullet, kLST 1.25", "bullet/pbd+kLST=1.25"},
        {"Bullet, kLST 1.5", "bullet/pbd+kLST=1.5"}},
       stretch,
       over_relaxation_effect,
       // the distance starts at 0.1 mm, which a stable link never exceeds
       {{apart, 3, 0, 1}},
       {{within, 2, 1, 0.1}}},
      {"small-things",
       "bullet/deformable-explicit",
       "height over the surface",
       "mm",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet, default voxel of 5 mm", "bullet/deformable-explicit"},
        {"Bullet, default margin of 0.25 m", "bullet/deformable-explicit+default-margin+voxel=0.0002"},
        {"Bullet, both scaled", "bullet/deformable-explicit+voxel=0.0002"}},
       gap,
       small_effect,
       // bounds: a hundredth of the ball; a^2 / 4R = 0.001 mm, plus the fall to the surface
       {{apart, 1, 0, 0.1}, {apart, 2, 0, 0.1}},
       {{within, 3, 0, 0.005}}},
      {"sleeping",
       "bullet/deformable-explicit",
       "stretch",
       "mm",
       {{"expected, mysim", "mysim/leapfrog"},
        {"Bullet, sleeping as by default", "bullet/deformable-explicit+default-sleep"},
        {"Bullet, sleeping switched off", "bullet/deformable-explicit"}},
       stretch,
       sleeping_effect,
       // the amplitude is 1 mm; the second bound is twice h v at 10 mm/s
       {{apart, 1, 0, 0.5}},
       {{within, 2, 0, 0.04}}},
  };
}

}  // namespace

std::vector<Disagreement> disagreements() { return with_texts(table()); }

std::vector<Disagreement> with_texts(std::vector<Disagreement> rows) {
  for (Disagreement& row : rows) add_texts(row);
  return rows;
}

}  // namespace crosscheck
