// A cloth stepped by the fused step, with pins and contacts, and its state in scene order.
#include "mysim/run/cloth_grid_world.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "mysim/run/contact_events.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"
#include "mysim/simd/instruction_sets.h"

namespace crosscheck::simd {
namespace {

/// `at`: time (s) within the step at which forces are evaluated. `drift_before`, `drift_after`: durations (s) for which
/// positions then drift, before and after contacts are resolved.
struct Kick {
  double at, drift_before, drift_after;
};

bool has_only_supported_terms(const Model& model) {
  for (const Term& term : model.terms)
    if (!std::holds_alternative<Springs>(term) && !std::holds_alternative<Gravity>(term) &&
        !std::holds_alternative<Drag>(term) && !std::holds_alternative<Wind>(term) &&
        !std::holds_alternative<Spheres>(term) && !std::holds_alternative<Planes>(term))
      return false;
  return true;
}

template <class T>
/// Positions are ahead of velocities by drift_after of the last kick.
class ClothGridWorld : public World {
 public:
  ClothGridWorld(const KickDriftComposition& composition, const GridTopology& topology, const Scene& scene, double h,
                 Kernel<T> kernel, int threads, ContactRule contact, bool record_contact_loss)
      : scene_(scene),
        kernel_(kernel),
        slabs_(topology, threads),
        slab_results_(slabs_.all().size()),
        surfaces_(surfaces_of(scene.model)),
        locates_events_(contact == ContactRule::events),
        record_contact_loss_(record_contact_loss),
        size_(scene.size() + scene.start.x.cwiseAbs().maxCoeff()),
        s_(scene.start) {
    double begin = 0;
    for (size_t i = 0; i < composition.fractions.size(); ++i) {
      const double part = composition.fractions[i] * h,
                   next = composition.fractions[(i + 1) % composition.fractions.size()] * h;
      kicks_.push_back(composition.kick_first ? Kick{begin, part, 0} : Kick{begin + part / 2, part / 2, next / 2});
      begin += part;
    }
    set_factors(composition, h);
    // contacts are resolved in lanes only if surfaces are fixed, nothing is pinned, and no losses of particles are
    // recorded; otherwise the callback resolves them
    in_lanes_ = std::is_same_v<T, double> && !has_moving_surface(scene.model) && !locates_events_ &&
                !record_contact_loss_ && scene.model.particles.pins.empty();
    for (const Surface& s : surfaces_) {
      const Vec3 origin = s.origin_at(0);
      if (!s.flat())
        resting_spheres_.push_back({{origin[0], origin[1], origin[2]}, s.radius(), s.friction, s.restitution});
    }
    slabs_.put(s_.x + kicks_.back().drift_after * s_.v, s_.v);
  }

  void step(double t, double t_next) override {
    begin_contacts(t, t_next);
    for (const Kick& kick : kicks_) {  // one for leapfrog and symplectic Euler, five for suzuki4
      const KickDrift<T> kick_drift = kick_drift_at(t + kick.at, kick);
      const Vec3 shift = pin_displacement_at(t + kick.at);
      slabs_.for_each([&](Slab& slab) {  // runs on the slab's thread, between exchanges of halo rows
        place_pins(slab, shift);
        fused_step(slab, kick, kick_drift);
      });
      ++evaluations_;
    }
  }

  const State& state(double t) override {
    s_.t = t;
    if (evaluations_ == 0) return s_;
    slabs_.get(s_.x, s_.v);
    s_.x -= kicks_.back().drift_after * s_.v;
    scene_.model.particles.place_pins(s_);
    return s_;
  }

  void report_contact(Observer& observer) override {
    bool any = false;
    double sum = 0;  // summed sequentially, which gives the same bits for any number of slabs
    for (const SlabResult& result : slab_results_)
      for (const double lost : result.lost) sum += lost, any = true;
    if (any) observer.contact(sum);
  }

  Work work() const override {
    long degenerate_springs = 0;
    for (const SlabResult& result : slab_results_) degenerate_springs += result.degenerate_springs;
    return {.evaluations = evaluations_,
            .degenerate_springs = degenerate_springs,
            .worker_seconds = slabs_.worker_seconds(),
            .single_precision = std::is_same_v<T, float>};
  }

 private:
  using Slab = typename Slabs<T>::Slab;
  struct SlabResult {
    long degenerate_springs = 0;
    std::vector<double> lost;  // J, energy lost by each of the slab's particles that touched a surface in the step
  };
  struct ContactContext {
    ClothGridWorld* world;
    Slab* slab;
    SlabResult* result;
  };

  /// Factors of each kick for velocity (drag), force and uniform acceleration, laid out per slab.
  void set_factors(const KickDriftComposition& composition, double h) {
    const Particles& particles = scene_.model.particles;
    const Eigen::ArrayXd mass = particles.mass.array();
    Eigen::ArrayXd gamma = Eigen::ArrayXd::Zero(particles.size());
    if (const auto* drag = scene_.model.find<Drag>()) gamma = drag->c.array() / mass;
    drag_rate_ = gamma;
    const bool alike = (mass == mass[0]).all() && (gamma == gamma[0]).all();
    stride_ = alike ? 0 : lanes<T>;
    for (Slab& slab : slabs_.all()) {
      const int first = alike ? 0 : slab.first, count = alike ? 1 : slab.body.size();
      const Eigen::ArrayXd m = mass.segment(first, count), c = gamma.segment(first, count);
      for (const double fraction : composition.fractions) {
        const double part = fraction * h;
        const Eigen::ArrayXd half = part / 2 * c;
        // drag acts at the old velocity, or at the mean of old and new velocity
        const Eigen::ArrayXd damping =
            composition.kick_first ? Eigen::ArrayXd(part * c) : Eigen::ArrayXd(part * c / (1 + half));
        const Eigen::ArrayXd dt =
            composition.kick_first ? Eigen::ArrayXd::Constant(count, part) : Eigen::ArrayXd(part / (1 + half));
        slab.factors.push_back({slab.body.spread(damping), slab.body.spread(dt / m), slab.body.spread(dt)});
      }
    }
  }

  KickDrift<T> kick_drift_at(double t, const Kick& kick) const {
    Vec3 uniform_acceleration = Vec3::Zero();
    if (const auto* gravity = scene_.model.find<Gravity>()) uniform_acceleration += gravity->acceleration;
    if (const auto* wind = scene_.model.find<Wind>()) uniform_acceleration += wind->acceleration.at(t);
    return {{T(uniform_acceleration[0]), T(uniform_acceleration[1]), T(uniform_acceleration[2])},
            T(kick.drift_before),
            T(kick.drift_after),
            bounding_spheres_.data(),
            static_cast<int>(bounding_spheres_.size()),
            &ClothGridWorld::contact_tile,
            nullptr,
            resting_spheres_.data(),
            bounding_planes_.data(),
            static_cast<int>(bounding_planes_.size()),
            in_lanes_};
  }

  void place_pins(Slab& slab, const Vec3& shift) {
    const Particles& particles = scene_.model.particles;
    for (size_t i = 0; i < particles.pins.size(); ++i)
      if (const int here = slab.here(particles.pins[i]); here >= 0)
        slab.body.place(here, particles.pin_home.col(static_cast<int>(i)) + shift);
  }

  void fused_step(Slab& slab, const Kick& kick, KickDrift<T> kick_drift) {
    ClothGrid<T>& grid = slab.body.grid();
    const auto& factors = slab.factors[&kick - kicks_.data()];
    grid.damping = factors.damping.data(), grid.inverse_mass_dt = factors.inverse_mass_dt.data(),
    grid.dt = factors.dt.data();
    grid.stride = stride_;
    ContactContext context{this, &slab, &slab_results_[slab.which]};
    kick_drift.user_data = &context;
    context.result->degenerate_springs += kernel_.fused_step(grid, kick_drift);
  }

  Vec3 pin_displacement_at(double t) const {
    const auto& move = scene_.model.particles.move;
    return move ? displacement_at(*move, t) : Vec3::Zero();
  }

  /// Forgets the contacts of the last step, and moves the bounding surfaces to their places at the end of this step.
  void begin_contacts(double t, double t_next) {
    t_ = t, t_next_ = t_next;
    for (SlabResult& result : slab_results_) result.lost.clear();
    bounding_spheres_.clear(), bounding_planes_.clear();
    if (surfaces_.empty()) return;
    if (locates_events_) tracks_ = surface_tracks(surfaces_, t_, t_next_);
    for (const Surface& s : surfaces_) {
      const Vec3 o = s.origin_at(t_next_), n = s.normal(Vec3::Zero());
      // slightly larger than the solid: contact_particle() decides which particles touch
      if (s.flat())
        bounding_planes_.push_back({{o[0], o[1], o[2]}, {n[0], n[1], n[2]}, 1e-6 * size_, s.friction, s.restitution});
      else
        bounding_spheres_.push_back({{o[0], o[1], o[2]}, std::pow(s.radius() * (1 + 1e-6), 2)});
    }
  }

  static void contact_tile(void* user_data, int row, int tile, T* x, T* v) {
    const ContactContext& context = *static_cast<ContactContext*>(user_data);
    for (int lane = 0; lane < lanes<T>; ++lane)
      if (const int here = context.slab->body.particle(row, tile, lane); here >= 0)
        context.world->contact_particle(*context.slab, *context.result, here, x + lane, v + lane);
  }

  /// Resolves the contacts of one particle, whose coordinates are one cache line apart.
  void contact_particle(const Slab& slab, SlabResult& result, int here, T* x, T* v) {
    const int i = slab.first + here;
    if (scene_.model.particles.pinned[i]) return;
    const auto at = [](const T* p) { return Vec3(p[0], p[lanes<T>], p[2 * lanes<T>]); };
    Vec3 place = at(x), speed = at(v);
    // state at the beginning of the step
    const Vec3 v_n = slab.body.velocity(here), x_n = slab.body.position(here) - kicks_.back().drift_after * v_n;
    // a particle that ends its step outside may count as free: contact would change its velocity by at most O(h)
    const auto lost = locates_events_ ? resolve_events(tracks_, t_next_ - t_, drag_rate_[i], x_n, v_n, place, speed)
                                      : resolve_surfaces(surfaces_, resolve_contact, t_, t_next_, x_n, v_n, place,
                                                         speed, record_contact_loss_);
    if (!lost) return;
    if (record_contact_loss_) result.lost.push_back(scene_.model.particles.mass[i] * *lost);
    for (int c = 0; c < 3; ++c) x[c * lanes<T>] = static_cast<T>(place[c]), v[c * lanes<T>] = static_cast<T>(speed[c]);
  }

  const Scene& scene_;
  Kernel<T> kernel_;
  Slabs<T> slabs_;
  std::vector<SlabResult> slab_results_;
  std::vector<Surface> surfaces_;
  bool locates_events_, record_contact_loss_;
  double size_;                       // m, scene size plus largest initial coordinate
  std::vector<SurfaceTrack> tracks_;  // for the current step, if events are located
  Eigen::ArrayXd drag_rate_;          // n, 1/s
  std::vector<Kick> kicks_;
  std::vector<BoundingSphere> bounding_spheres_;
  std::vector<BoundingPlane> bounding_planes_;
  std::vector<RestingSphere> resting_spheres_;
  bool in_lanes_;  // the fused step resolves contacts
  int stride_ = 0;
  State s_;
  double t_ = 0, t_next_ = 0;  // s, of the current step
  long evaluations_ = 0;
};

/// A thread needs at least this number of particles.
constexpr int particles_per_thread = 4096;

template <class T>
std::unique_ptr<World> make_world(const GridTopology& topology, const KickDriftComposition& composition,
                                  const Scene& scene, double h, bool fast, int threads, ContactRule contact,
                                  const Observer& observer) {
  if (!fits(topology)) return nullptr;
  const int useful_threads = std::clamp(scene.model.particles.size() / particles_per_thread, 1, threads);
  return std::make_unique<ClothGridWorld<T>>(composition, topology, scene, h, kernel<T>(active_instruction_set(), fast),
                                             useful_threads, contact, observer.every_step());
}

}  // namespace

std::unique_ptr<World> make_cloth_grid_world(const Stepper& stepper, ContactRule contact, const Scene& scene, double h,
                                             const Execution& execution, const Observer& observer) {
  const Model& model = scene.model;
  const auto* springs = model.find<Springs>();
  if (execution.path == ExecutionPath::general || !stepper.composition || !springs || !has_only_supported_terms(model))
    return nullptr;
  const KickDriftComposition composition = stepper.composition();
  if (has_contact(model) && (contact == ContactRule::sticky || composition.fractions.size() > 1)) return nullptr;
  const auto topology = find_grid_topology(*springs, model.particles.size());
  if (!topology) return nullptr;
#ifndef __wasm__  // the WebAssembly module has no single precision
  if (execution.path == ExecutionPath::single_precision)
    return make_world<float>(*topology, composition, scene, h, true, execution.threads, contact, observer);
#endif
  const bool fast = execution.path == ExecutionPath::fastest;
  return make_world<double>(*topology, composition, scene, h, fast, execution.threads, contact, observer);
}

}  // namespace crosscheck::simd
