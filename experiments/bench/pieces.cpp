#include "experiments/bench/pieces.h"

#include <memory>

#include "experiments/bench/instructions.h"
#include "mysim/spring_kernel.h"
#include "mysim/strip/sheet_body.h"

namespace crosscheck {

Piece naive_loop(const Scene& scene) {
  struct Work {
    std::vector<Spring> springs;
    std::vector<Vec3> x, f;
  };
  auto work = std::make_shared<Work>();
  work->springs = scene.model.find<Springs>()->list;
  for (int i = 0; i < scene.start.x.cols(); ++i) work->x.push_back(scene.start.x.col(i));
  work->f.resize(work->x.size());
  return [work] {
    for (Vec3& f : work->f) f.setZero();
    for (const Spring& s : work->springs) {
      const Vec3 d = work->x[s.a] - work->x[s.b];
      const double length = d.norm();
      const Vec3 force = s.k * (s.rest - length) / length * d;
      work->f[s.a] += force;
      work->f[s.b] -= force;
    }
    // tells the compiler that somebody reads them, so that the work is not left out
    asm volatile("" : : "r"(work->f.data()) : "memory");
  };
}

Piece plain_loop(const Scene& scene) {
  struct Work {
    Springs springs;
    Particles particles;
    State state;
    Forces forces;
  };
  auto work = std::make_shared<Work>(Work{*scene.model.find<Springs>(), scene.model.particles, scene.start, {}});
  work->forces.f = Points::Zero(3, scene.start.x.cols());
  return [work] {
    work->forces.clear();
    add_force(work->springs, work->particles, work->state, work->forces);
  };
}

Piece general_kernel(const Scene& scene, strip::Isa isa) {
  const Instructions only(isa);
  struct Work {
    SpringKernel kernel;
    Points x;
    Forces forces;
  };
  auto work = std::make_shared<Work>(
      Work{SpringKernel(*scene.model.find<Springs>(), scene.model.particles.size()), scene.start.x, {}});
  work->forces.f = Points::Zero(3, scene.start.x.cols());
  return [work] {
    work->forces.clear();
    work->kernel.add_force(work->x, work->forces);
  };
}

template <class T>
std::optional<Piece> sweep(const Scene& scene, strip::Isa isa, bool fast) {
  struct Work {
    strip::SheetBody<T> body;
    strip::Lines<T> lose, push, span;
  };
  const auto weave = strip::weave_of(*scene.model.find<Springs>(), scene.model.particles.size());
  if (!weave || !strip::fits<T>(*weave)) return std::nullopt;
  auto work = std::make_shared<Work>(Work{strip::SheetBody<T>(*weave), {}, {}, {}});
  const double h = scene.step, m = scene.model.particles.mass[0];
  const auto all = [&](double value) { return work->body.spread(Eigen::ArrayXd::Constant(1, value)); };
  // strongly damped: it comes to rest, and its springs go on being computed
  work->lose = all(0.1), work->push = all(h / m), work->span = all(h);
  work->body.put(scene.start.x, scene.start.v);
  strip::Sheet<T>& sheet = work->body.sheet();
  sheet.lose = work->lose.data(), sheet.push = work->push.data(), sheet.span = work->span.data();
  const strip::Stride<T> stride{{0, 0, 0}, static_cast<T>(h / 2), static_cast<T>(h / 2), nullptr, 0, nullptr, nullptr};
  return [work, stride, kernel = strip::kernel<T>(isa, fast)] { kernel.sweep(work->body.sheet(), stride); };
}

template std::optional<Piece> sweep<double>(const Scene&, strip::Isa, bool);
template std::optional<Piece> sweep<float>(const Scene&, strip::Isa, bool);

}  // namespace crosscheck
