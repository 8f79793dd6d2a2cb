#include "experiments/bench/spring_forces.h"

#include <memory>

#include "experiments/timing/instruction_sets.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"
#include "mysim/simd/spring_graph/spring_kernel.h"

namespace crosscheck {

BenchmarkFunction naive_loop(const Scene& scene) {
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
    asm volatile("" : : "r"(work->f.data()) : "memory");
  };
}

BenchmarkFunction plain_loop(const Scene& scene) {
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

BenchmarkFunction general_kernel(const Scene& scene, simd::InstructionSet isa) {
  const ScopedInstructionSet only(isa);
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
std::optional<BenchmarkFunction> fused_step(const Scene& scene, simd::InstructionSet isa, bool fast) {
  struct Work {
    simd::ClothGridMemory<T> body;
    simd::AlignedBuffer<T> damping, inverse_mass_dt, dt;
  };
  const auto topology = simd::find_grid_topology(*scene.model.find<Springs>(), scene.model.particles.size());
  if (!topology || !simd::fits(*topology)) return std::nullopt;
  auto work = std::make_shared<Work>(Work{simd::ClothGridMemory<T>(*topology), {}, {}, {}});
  const double h = scene.step, m = scene.model.particles.mass[0];
  const auto all = [&](double value) { return work->body.spread(Eigen::ArrayXd::Constant(1, value)); };
  // strong damping, so that the cloth comes to rest; this does not affect the cost
  work->damping = all(0.1), work->inverse_mass_dt = all(h / m), work->dt = all(h);
  work->body.put(scene.start.x, scene.start.v);
  simd::ClothGrid<T>& grid = work->body.grid();
  grid.damping = work->damping.data(), grid.inverse_mass_dt = work->inverse_mass_dt.data(), grid.dt = work->dt.data();
  const simd::KickDrift<T> kick_drift{{0, 0, 0}, static_cast<T>(h / 2), static_cast<T>(h / 2), nullptr, 0, nullptr,
                                      nullptr};
  return [work, kick_drift, kernel = simd::kernel<T>(isa, fast)] { kernel.fused_step(work->body.grid(), kick_drift); };
}

template std::optional<BenchmarkFunction> fused_step<double>(const Scene&, simd::InstructionSet, bool);
template std::optional<BenchmarkFunction> fused_step<float>(const Scene&, simd::InstructionSet, bool);

}  // namespace crosscheck
