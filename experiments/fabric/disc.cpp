#include "experiments/fabric/disc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "mysim/base/random.h"

namespace crosscheck {
namespace {

double angle_of(const DrapedDisc& disc) { return 2 * std::numbers::pi / disc.spokes(); }

Bending bending_of(const DrapedDisc& disc) {
  const double d = disc.spacing(), angle = angle_of(disc), chord = 2 * std::sin(angle / 2);
  const int rim = disc.rings + 1;
  Bending bending{{}, disc.rigidity};
  for (int i = 0; i <= rim; ++i)
    for (int j = 0; j < disc.spokes(); ++j) {
      const double r = disc.radius(i), area = (i == rim ? 0.5 : 1) * r * d * angle;
      const int here = disc.particle(i, j), inside = here - disc.spokes(), outside = here + disc.spokes(),
                before = disc.particle(i, j - 1), after = disc.particle(i, j + 1);
      if (i > 0 && i < rim)
        bending.list.push_back({3, {inside, here, outside}, {1, -2, 1}, disc.rigidity * area / std::pow(d, 4)});
      // x_r / r + x_tt / r^2, multiplied by 2 (1 - cos D) r^2, so that the weights along a ring are 1, -2, 1
      const double around = chord * chord * r * r, k = disc.rigidity * area / (around * around);
      if (i > 0 && i < rim) {
        const double along = around / (2 * d * r);
        bending.list.push_back({5, {inside, before, here, after, outside}, {-along, 1, -2, 1, along}, k});
      } else if (i == rim) {
        const double along = around / (d * r);
        bending.list.push_back({4, {inside, before, here, after}, {-along, 1, -2 + along, 1}, k});
      }
      if (i < rim) {
        // (x_t / r)_r, multiplied by 2 sin(D / 2) d r with r at the midpoint
        const double middle = r + d / 2, in = middle / r, out = middle / (r + d);
        bending.list.push_back({4,
                                {here, after, outside, disc.particle(i + 1, j + 1)},
                                {in, -in, -out, out},
                                2 * disc.rigidity * middle * d * angle / std::pow(chord * d * middle, 2)});
      }
    }
  return bending;
}

Springs springs_of(const DrapedDisc& disc, const Points& flat) {
  const double p = disc.spacing(), angle = angle_of(disc), c66 = disc.shear, c11 = 3 * c66;
  Springs springs;
  const auto add = [&](int a, int b, double k, Family family) {
    springs.list.push_back({a, b, k, (flat.col(a) - flat.col(b)).norm(), family});
  };
  const int rim = disc.rings + 1;
  for (int i = 1; i <= rim; ++i)
    for (int j = 0; j < disc.spokes(); ++j) {
      const int here = disc.particle(i, j), after = disc.particle(i, j + 1);
      const double ring = disc.radius(i) * angle;
      if (i > 1)  // springs between pins have no effect
        add(here, after, (i == rim ? 0.5 : 1) * (c11 * p / ring - c66 * ring / p), Family::structural);
      if (i == rim) continue;
      const int outside = disc.particle(i + 1, j), across = disc.particle(i + 1, j + 1);
      const double q = (disc.radius(i) + p / 2) * angle;
      add(here, outside, c11 * q / p - c66 * p / q, Family::structural);
      const double k = c66 * (p * p + q * q) / (2 * p * q);
      add(here, across, k, Family::shear);
      add(after, outside, k, Family::shear);
    }
  return springs;
}

/// Lagrange weights of the values at 0, 1, 2 and 3 for interpolation at the position `at`.
std::array<double, 4> cubic(double at) {
  std::array<double, 4> weights{1, 1, 1, 1};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (i != j) weights[i] *= (at - j) / (i - j);
  return weights;
}

}  // namespace

Scene disc_scene(const DrapedDisc& disc) {
  Scene scene;
  scene.name = "draped-disc";
  scene.duration = 1, scene.samples = 1, scene.step = 1e-4, scene.window = 1, scene.tolerance = 1e-3;
  scene.method = "leapfrog";
  const int rim = disc.rings + 1, n = (rim + 1) * disc.spokes();
  State& start = scene.start;
  start.x.resize(3, n);
  start.v = Points::Zero(3, n);
  Particles& particles = scene.model.particles;
  particles.mass.resize(n);
  particles.pinned.assign(static_cast<size_t>(n), 0);
  const double angle = angle_of(disc);
  for (int i = 0; i <= rim; ++i)
    for (int j = 0; j < disc.spokes(); ++j) {
      const int here = disc.particle(i, j);
      const double r = disc.radius(i);
      start.x.col(here) << r * std::cos(j * angle), 0, r * std::sin(j * angle);
      particles.mass[here] = (i == rim ? 0.5 : 1) * disc.density * r * disc.spacing() * angle;
      if (i < 2) particles.pinned[static_cast<size_t>(here)] = 1, particles.pins.push_back(here);
      if (i == rim) continue;
      const int after = disc.particle(i, j + 1), outside = here + disc.spokes(), across = after + disc.spokes();
      scene.triangles.push_back({here, after, outside});
      scene.triangles.push_back({after, across, outside});
    }
  particles.pin_home = start.x.leftCols(2 * disc.spokes());
  scene.model.terms = {Gravity{{0, -disc.gravity, 0}}, springs_of(disc, start.x), bending_of(disc)};
  scene.hash = hash_of(scene);
  return scene;
}

Points wavy(const DrapedDisc& disc, int waves, unsigned seed) {
  std::mt19937_64 engine(seed);
  struct Wave {
    int around;
    double height, phase;
  };
  std::vector<Wave> all{{waves, 0.01, 0}};
  if (waves == 0) {
    all.clear();
    for (int around = 2; around < 10; ++around)
      all.push_back({around, 0.01 * uniform(engine), 2 * std::numbers::pi * uniform(engine)});
  }
  Points x = disc_scene(disc).start.x;
  for (int i = 2; i <= disc.rings + 1; ++i)
    for (int j = 0; j < disc.spokes(); ++j) {
      const double out = (disc.radius(i) - disc.disc) / (disc.specimen - disc.disc);
      double height = 2e-5 * (uniform(engine) - 0.5);
      for (const Wave& wave : all)
        height += wave.height * out * out * std::cos(wave.around * j * angle_of(disc) + wave.phase);
      x(1, disc.particle(i, j)) += height;
    }
  return x;
}

Points on_net(const DrapedDisc& from, const Points& x, const DrapedDisc& to) {
  const Points offset = x - disc_scene(from).start.x;
  Points y = disc_scene(to).start.x;
  for (int i = 2; i <= to.rings + 1; ++i)
    for (int j = 0; j < to.spokes(); ++j) {
      const double ring = (to.radius(i) - from.radius(0)) / from.spacing(),
                   spoke = static_cast<double>(j) * from.spokes() / to.spokes();
      const int a = std::clamp(static_cast<int>(ring) - 1, 0, from.rings - 2), b = static_cast<int>(spoke) - 1;
      const std::array<double, 4> along = cubic(ring - a), around = cubic(spoke - b);
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 4; ++l)
          y.col(to.particle(i, j)) += along[k] * around[l] * offset.col(from.particle(a + k, b + l));
    }
  return y;
}

double drape_coefficient(const DrapedDisc& disc, const Points& x) {
  // scans the specimen in rows; in each row, unites the intervals covered by triangles
  constexpr int rows = 2000;
  const double top = x.row(2).cwiseAbs().maxCoeff(), height = 2 * top / rows;
  std::vector<std::vector<std::pair<double, double>>> covered(rows);
  const auto cover = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto [low, high] = std::minmax({a.z(), b.z(), c.z()});
    const int first = std::max(0, static_cast<int>(std::ceil((low + top) / height - 0.5))),
              last = std::min(rows - 1, static_cast<int>(std::floor((high + top) / height - 0.5)));
    for (int row = first; row <= last; ++row) {
      const double z = (row + 0.5) * height - top;
      double from = INFINITY, to = -INFINITY;
      for (const auto& [p, q] : {std::pair{&a, &b}, {&b, &c}, {&c, &a}})
        if ((p->z() <= z) != (q->z() <= z)) {
          const double at = p->x() + (z - p->z()) / (q->z() - p->z()) * (q->x() - p->x());
          from = std::min(from, at), to = std::max(to, at);
        }
      if (from < to) covered[static_cast<size_t>(row)].emplace_back(from, to);
    }
  };
  const int rim = disc.rings + 1, n = disc.spokes();
  for (int j = 0; j < n; ++j) {
    cover(Vec3::Zero(), x.col(disc.particle(0, j)), x.col(disc.particle(0, j + 1)));
    for (int i = 0; i < rim; ++i) {
      const Vec3 here = x.col(disc.particle(i, j)), after = x.col(disc.particle(i, j + 1)),
                 outside = x.col(disc.particle(i + 1, j)), across = x.col(disc.particle(i + 1, j + 1));
      cover(here, after, outside), cover(after, across, outside);
    }
  }
  double area = 0;
  for (auto& row : covered) {
    std::sort(row.begin(), row.end());
    double end = -INFINITY;
    for (const auto& [from, to] : row)
      if (to > end) area += (to - std::max(from, end)) * height, end = to;
  }
  const double sector = n * std::sin(angle_of(disc)) / 2, inner = sector * disc.disc * disc.disc,
               outer = sector * disc.specimen * disc.specimen;
  return 100 * (area - inner) / (outer - inner);
}

int nodes_of(const DrapedDisc& disc, const Points& x) {
  // folds are wider than a twelfth of the rim, so each point is compared with those within a fiftieth of the rim on
  // either side
  const int n = disc.spokes(), near = std::max(1, n / 50);
  const auto distance = [&](int j) {
    const Vec3 at = x.col(disc.particle(disc.rings + 1, j));
    return std::hypot(at.x(), at.z());
  };
  int nodes = 0;
  for (int j = 0; j < n; ++j) {
    bool is_highest = true;
    for (int k = 1; k <= near; ++k) is_highest &= distance(j) > distance(j - k) && distance(j) >= distance(j + k);
    nodes += is_highest;
  }
  return nodes;
}

}  // namespace crosscheck
