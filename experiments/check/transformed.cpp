// Relations between the runs of a scene and of a transformed scene.
#include <fmt/format.h>

#include "experiments/check/compare.h"
#include "experiments/check/transformations.h"

namespace crosscheck {
namespace {

RelationResult beside_placed(Subject& subject, const Scene& scene, const Placement& placement, const char* what) {
  const Scene other = placed(scene, placement);
  const Trajectory& here = subject.run(scene).path;
  const Trajectory& there = subject.run(other).path;
  const double lengths = std::max(lengths_in(scene, here), lengths_in(other, there));
  // uses the noise with residuals, because the residual of an implicit equation depends on the coordinates
  return farthest(what, with_positions(here, [&](const Points& x) { return placement.of(x); }), there,
                  subject.noise_with_unsolved(scene, lengths).x, lengths);
}

/// Bound for runs that differ in the order of summation or iteration: adds the error of each run's iterations.
std::vector<double> bound_of_order(Subject& subject, const Scene& scene, const Scene& other) {
  std::vector<double> bound = subject.noise(scene).x;
  for (const Scene* one : {&scene, &other})
    if (const auto error = subject.iteration_error(*one)) bound = sum_of(std::move(bound), *error);
  return bound;
}

}  // namespace

RelationResult turned_start(Subject& subject, const Scene& scene, unsigned seed) {
  return beside_placed(subject, scene, {seeded_turn(seed), Vec3::Zero()},
                       "distance between the rotated run and the run from the rotated start");
}

RelationResult shifted_start(Subject& subject, const Scene& scene, unsigned seed) {
  const Vec3 shift = scene.size() * seeded_turn(seed).col(0);
  return beside_placed(subject, scene, {Eigen::Matrix3d::Identity(), shift},
                       "distance between the shifted run and the run from the shifted start");
}

RelationResult order_of_particles(Subject& subject, const Scene& scene, unsigned seed) {
  const std::vector<int> order = seeded_order(scene.model.particles.size(), seed);
  const Trajectory& here = subject.run(scene).path;
  const Scene other = renumbered(scene, order);
  const Trajectory there = with_positions(subject.run(other).path, [&](const Points& x) {
    Points back(3, x.cols());
    for (int i = 0; i < x.cols(); ++i) back.col(order[i]) = x.col(i);
    return back;
  });
  return farthest("distance from the run with particles in another order", here, there,
                  bound_of_order(subject, scene, other), lengths_in(scene, here));
}

RelationResult order_of_springs(Subject& subject, const Scene& scene, unsigned seed) {
  const Trajectory& here = subject.run(scene).path;
  const Scene other = springs_reordered(scene, seed);
  return farthest("distance from the run with springs in another order", here, subject.run(other).path,
                  bound_of_order(subject, scene, other), lengths_in(scene, here));
}

RelationResult scaled_scene(Subject& subject, const Scene& scene, unsigned) {
  const Trajectory& here = subject.run(scene).path;
  const auto noise = subject.noise(scene).x;
  // the factors are powers of two, so that rounding errors are scaled exactly
  struct Case {
    const char* what;
    Scaling scaling;
  };
  std::optional<RelationResult> worst;
  for (const auto& [what, scaling] : {Case{"lengths / 128", {0x1p-7, 1, 1}}, Case{"masses / 1024", {1, 0x1p-10, 1}},
                                      Case{"times / 4", {1, 1, 0x1p-2}}}) {
    const Trajectory there = with_positions(subject.run(scaled(scene, scaling)).path,
                                            [&](const Points& x) { return Points(x / scaling.length); });
    RelationResult found = farthest(fmt::format("distance from the run with {}, scaled back", what), here, there, noise,
                                    lengths_in(scene, here));
    worst = worst ? worse(*worst, std::move(found)) : std::move(found);
  }
  return *worst;
}

RelationResult mirror_symmetry(Subject& subject, const Scene& scene, unsigned) {
  const Mirror mirror = *mirror_of(scene);
  const Trajectory& here = subject.run(scene).path;
  const Trajectory there = with_positions(here, [&](const Points& x) {
    const Points reflected = mirror.reflection.of(x);
    Points image(3, x.cols());
    for (int i = 0; i < x.cols(); ++i) image.col(mirror.image[i]) = reflected.col(i);
    return image;
  });
  return farthest("distance from the mirror image", here, there, bound_of_order(subject, scene, scene),
                  lengths_in(scene, here));
}

}  // namespace crosscheck
