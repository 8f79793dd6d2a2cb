#include "mysim/strip/sheet_world.h"

#include <algorithm>
#include <cmath>

#include "mysim/strip/bands.h"
#include "mysim/strip/kernels.h"

namespace crosscheck::strip {
namespace {

/// One kick: when forces are taken (s, after the beginning of the step), and how far positions drift after it, before
/// contacts and behind them (s).
struct Kick {
  double at, out, on;
};

/// What leaves the general engine its work.
bool only_known_terms(const Model& model) {
  for (const Term& term : model.terms)
    if (!std::holds_alternative<Springs>(term) && !std::holds_alternative<Gravity>(term) &&
        !std::holds_alternative<Drag>(term) && !std::holds_alternative<Wind>(term) &&
        !std::holds_alternative<Spheres>(term))
      return false;
  return true;
}

template <class T>
class World : public SheetWorld {
 public:
  World(const Chain& chain, const Weave& weave, const Scene& scene, double h, Kernel<T> kernel, int threads,
        bool asked_of_contacts)
      : scene_(scene),
        kernel_(kernel),
        bands_(weave, threads),
        seen_(bands_.all().size()),
        spheres_(scene.model.find<Spheres>()),
        asked_of_contacts_(asked_of_contacts),
        s_(scene.start) {
    double begin = 0;
    for (size_t i = 0; i < chain.parts.size(); ++i) {
      const double part = chain.parts[i] * h, next = chain.parts[(i + 1) % chain.parts.size()] * h;
      kicks_.push_back(chain.kick_first ? Kick{begin, part, 0} : Kick{begin + part / 2, part / 2, next / 2});
      begin += part;
    }
    set_factors(chain, h);
    bands_.put(s_.x + kicks_.back().on * s_.v, s_.v);
  }

  void step(double t, double t_next) override {
    began_ = true;
    t_ = t, t_next_ = t_next;
    set_balls();
    for (Seen& seen : seen_) seen.lost.clear();
    for (size_t i = 0; i < kicks_.size(); ++i) {
      const Kick& kick = kicks_[i];
      const Vec3 fall = fall_at(t + kick.at), shift = pins_at(t + kick.at);
      const Stride<T> stride{{T(fall[0]), T(fall[1]), T(fall[2])}, T(kick.out),         T(kick.on), balls_.data(),
                             static_cast<int>(balls_.size()),      &World::touch_block, nullptr};
      bands_.sweep([&](Band& band) { sweep(band, i, stride, shift); });
    }
  }

  const State& state(double t) override {
    s_.t = t;
    if (!began_) return s_;
    bands_.get(s_.x, s_.v);
    s_.x -= kicks_.back().on * s_.v;
    scene_.model.particles.place_pins(s_);
    return s_;
  }

  void tell_contact(Observer& observer) override {
    bool any = false;
    double sum = 0;  // one after the other: the same bits, however many bands there are
    for (const Seen& seen : seen_)
      for (const double lost : seen.lost) sum += lost, any = true;
    if (any) observer.contact(sum);
  }

  long evaluations() const override { return evaluations_; }
  long coincident() const override {
    long sum = 0;
    for (const Seen& seen : seen_) sum += seen.coincident;
    return sum;
  }
  double other_seconds() const override { return bands_.other_seconds(); }

 private:
  using Band = typename Bands<T>::Band;
  /// What the thread of a band has come by.
  struct Seen {
    long coincident = 0;
    std::vector<double> lost;  // J, in contact, by each particle of its own that touched in the step
  };
  /// Whom the sweep of a band asks.
  struct Asked {
    World* world;
    Band* band;
    Seen* seen;
  };

  /// Drag, mass and length of each kick as factors of velocity, force and fall; one line of each part.
  void set_factors(const Chain& chain, double h) {
    const Particles& particles = scene_.model.particles;
    const Eigen::ArrayXd mass = particles.mass.array();
    Eigen::ArrayXd gamma = Eigen::ArrayXd::Zero(particles.size());
    if (const auto* drag = scene_.model.find<Drag>()) gamma = drag->c.array() / mass;
    const bool alike = (mass == mass[0]).all() && (gamma == gamma[0]).all();
    stride_ = alike ? 0 : lanes<T>;
    for (Band& band : bands_.all()) {
      const int first = alike ? 0 : band.first, count = alike ? 1 : band.body.size();
      const Eigen::ArrayXd m = mass.segment(first, count), c = gamma.segment(first, count);
      for (const double fraction : chain.parts) {
        const double part = fraction * h;
        const Eigen::ArrayXd half = part / 2 * c;
        // drag: at the old velocity, or averaged over old and new
        const Eigen::ArrayXd lose = chain.kick_first ? Eigen::ArrayXd(part * c) : Eigen::ArrayXd(part * c / (1 + half));
        const Eigen::ArrayXd span =
            chain.kick_first ? Eigen::ArrayXd::Constant(count, part) : Eigen::ArrayXd(part / (1 + half));
        band.factors.push_back({band.body.spread(lose), band.body.spread(span / m), band.body.spread(span)});
      }
    }
  }

  void sweep(Band& band, size_t kick, Stride<T> stride, const Vec3& shift) {
    const Particles& particles = scene_.model.particles;
    for (size_t i = 0; i < particles.pins.size(); ++i)
      if (const int here = band.here(particles.pins[i]); here >= 0)
        band.body.place(here, particles.pin_home.col(static_cast<int>(i)) + shift);
    Sheet<T>& sheet = band.body.sheet();
    const auto& factors = band.factors[kick];
    sheet.lose = factors.lose.data(), sheet.push = factors.push.data(), sheet.span = factors.span.data();
    sheet.stride = stride_;
    Asked asked{this, &band, &seen_[band.which]};
    stride.whom = &asked;
    asked.seen->coincident += kernel_.sweep(sheet, stride);
    if (band.which == 0) ++evaluations_;
  }

  Vec3 pins_at(double t) const {
    const auto& move = scene_.model.particles.move;
    return move ? displacement_at(*move, t) : Vec3::Zero();
  }

  Vec3 fall_at(double t) const {
    Vec3 fall = Vec3::Zero();
    if (const auto* gravity = scene_.model.find<Gravity>()) fall += gravity->acceleration;
    if (const auto* wind = scene_.model.find<Wind>()) fall += wind->acceleration.at(t);
    return fall;
  }

  void set_balls() {
    if (!spheres_) return;
    balls_.clear();
    for (const Sphere& sphere : spheres_->list) {
      const Vec3 centre = sphere.centre_at(t_next_);
      // a little more than the radius: who is asked decides, this only asks
      const double radius = sphere.contact_radius() * (1 + 1e-6);
      balls_.push_back({{centre[0], centre[1], centre[2]}, radius * radius});
    }
  }

  static void touch_block(void* whom, int row, int block, T* x, T* v) {
    const Asked& asked = *static_cast<Asked*>(whom);
    for (int lane = 0; lane < lanes<T>; ++lane)
      if (const int here = asked.band->body.particle(row, block, lane); here >= 0)
        asked.world->touch_particle(*asked.band, *asked.seen, here, x + lane, v + lane);
  }

  /// The contact rule; coordinates stand a line apart.
  void touch_particle(const Band& band, Seen& seen, int here, T* x, T* v) {
    const int i = band.first + here;
    if (scene_.model.particles.pinned[i]) return;
    const auto at = [](const T* p) { return Vec3(p[0], p[lanes<T>], p[2 * lanes<T>]); };
    Vec3 place = at(x), speed = at(v);
    // where it was and how fast when the step began
    const Vec3 v_n = band.body.velocity(here), x_n = band.body.position(here) - kicks_.back().on * v_n;
    const auto lost = touch(*spheres_, resolve_contact, t_, t_next_, x_n, v_n, place, speed);
    if (!lost) return;
    if (asked_of_contacts_) seen.lost.push_back(scene_.model.particles.mass[i] * *lost);
    for (int c = 0; c < 3; ++c) x[c * lanes<T>] = static_cast<T>(place[c]), v[c * lanes<T>] = static_cast<T>(speed[c]);
  }

  const Scene& scene_;
  Kernel<T> kernel_;
  Bands<T> bands_;
  std::vector<Seen> seen_;
  const Spheres* spheres_;
  bool asked_of_contacts_;
  std::vector<Kick> kicks_;
  std::vector<Ball> balls_;
  int stride_ = 0;
  State s_;
  bool began_ = false;
  double t_ = 0, t_next_ = 0;  // s, of the step under way
  long evaluations_ = 0;
};

/// Fewer particles than this are not worth a thread of their own.
constexpr int worth_a_thread = 4096;

template <class T>
std::unique_ptr<SheetWorld> world_on(const Weave& weave, const Chain& chain, const Scene& scene, double h, bool fast,
                                     int threads, const Observer& observer) {
  if (!fits<T>(weave)) return nullptr;
  const int worth = std::clamp(scene.model.particles.size() / worth_a_thread, 1, threads);
  return std::make_unique<World<T>>(chain, weave, scene, h, kernel<T>(chosen(), fast), worth, observer.every_step());
}

}  // namespace

std::unique_ptr<SheetWorld> sheet_world(const Stepper& stepper, ContactRule contact, const Scene& scene, double h,
                                        const Execution& execution, const Observer& observer) {
  const Model& model = scene.model;
  const auto* springs = model.find<Springs>();
  if (execution.precision == Precision::plain || !stepper.chain || !springs || !only_known_terms(model)) return nullptr;
  const Chain chain = stepper.chain();
  if (model.find<Spheres>() && (contact != ContactRule::coulomb || chain.parts.size() > 1)) return nullptr;
  const auto weave = weave_of(*springs, model.particles.size());
  if (!weave) return nullptr;
  if (execution.precision == Precision::single)
    return world_on<float>(*weave, chain, scene, h, true, execution.threads, observer);
  const bool fast = execution.precision == Precision::fastest;
  return world_on<double>(*weave, chain, scene, h, fast, execution.threads, observer);
}

}  // namespace crosscheck::strip
