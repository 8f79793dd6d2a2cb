#include "mysim/strip/sheet_world.h"

#include <cmath>

#include "mysim/strip/kernels.h"
#include "mysim/strip/sheet_body.h"

namespace crosscheck::strip {
namespace {

/// One kick: v' = keep v + push f + span fall, and how far positions drift after it.
template <class T>
struct Kick {
  double at;  // s, after the beginning of the step: when forces are taken
  double out, on;
  Lines<T> keep, push, span;
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
  World(const Chain& chain, const Weave& weave, const Scene& scene, double h, Kernel<T> kernel)
      : scene_(scene), h_(h), kernel_(kernel), body_(weave), spheres_(scene.model.find<Spheres>()), s_(scene.start) {
    const Particles& particles = scene.model.particles;
    Eigen::ArrayXd gamma = Eigen::ArrayXd::Zero(particles.size());
    if (const auto* drag = scene.model.find<Drag>()) gamma = drag->c.array() / particles.mass.array();
    const Eigen::ArrayXd mass = particles.mass.array();
    const bool alike = (mass == mass[0]).all() && (gamma == gamma[0]).all();
    double begin = 0;
    for (size_t i = 0; i < chain.parts.size(); ++i) {
      const double part = chain.parts[i] * h, next = chain.parts[(i + 1) % chain.parts.size()] * h;
      const Eigen::ArrayXd half = part / 2 * gamma;
      // drag: at the old velocity, or averaged over old and new
      const Eigen::ArrayXd keep =
          chain.kick_first ? Eigen::ArrayXd(1 - part * gamma) : Eigen::ArrayXd((1 - half) / (1 + half));
      const Eigen::ArrayXd span =
          chain.kick_first ? Eigen::ArrayXd::Constant(gamma.size(), part) : Eigen::ArrayXd(part / (1 + half));
      const auto lines = [&](const Eigen::ArrayXd& all) { return body_.spread(alike ? all.head(1) : all); };
      kicks_.push_back({chain.kick_first ? begin : begin + part / 2, chain.kick_first ? part : part / 2,
                        chain.kick_first ? 0 : next / 2, lines(keep), lines(span / mass), lines(span)});
      begin += part;
    }
    stride_ = alike ? 0 : lanes<T>;
    body_.put(s_.x + kicks_.back().on * s_.v, s_.v);
  }

  void step(double t, double t_next) override {
    began_ = true;
    t_ = t, t_next_ = t_next;
    for (Kick<T>& kick : kicks_) {
      place_pins(t + kick.at);
      Sheet<T>& sheet = body_.sheet();
      sheet.keep = kick.keep.data(), sheet.push = kick.push.data(), sheet.span = kick.span.data();
      sheet.stride = stride_;
      const Vec3 fall = fall_at(t + kick.at);
      Stride<T> stride{{T(fall[0]), T(fall[1]), T(fall[2])}, T(kick.out), T(kick.on), nullptr, 0, &touched, this};
      set_balls(stride);
      coincident_ += kernel_.sweep(sheet, stride);
      ++evaluations_;
    }
  }

  const State& state(double t) override {
    s_.t = t;
    if (!began_) return s_;
    body_.get(s_.x, s_.v);
    s_.x -= kicks_.back().on * s_.v;
    scene_.model.particles.place_pins(s_);
    return s_;
  }

  long evaluations() const override { return evaluations_; }
  long coincident() const override { return coincident_; }

 private:
  void place_pins(double t) {
    const Particles& particles = scene_.model.particles;
    if (particles.pins.empty()) return;
    const Vec3 shift = particles.move ? displacement_at(*particles.move, t) : Vec3::Zero();
    for (size_t i = 0; i < particles.pins.size(); ++i)
      body_.place(particles.pins[i], particles.pin_home.col(static_cast<int>(i)) + shift);
  }

  Vec3 fall_at(double t) const {
    Vec3 fall = Vec3::Zero();
    if (const auto* gravity = scene_.model.find<Gravity>()) fall += gravity->acceleration;
    if (const auto* wind = scene_.model.find<Wind>()) fall += wind->acceleration.at(t);
    return fall;
  }

  void set_balls(Stride<T>& stride) {
    if (!spheres_) return;
    balls_.clear();
    for (const Sphere& sphere : spheres_->list) {
      const Vec3 centre = sphere.centre_at(t_next_);
      // a little more than the radius: what is asked decides, this only asks
      const double radius = sphere.contact_radius() * (1 + 1e-6);
      balls_.push_back({{centre[0], centre[1], centre[2]}, radius * radius});
    }
    stride.balls = balls_.data(), stride.ball_count = static_cast<int>(balls_.size());
  }

  /// The contact rule, for the particles of a block.
  static void touched(void* whom, int row, int block, T* x, T* v) {
    auto& self = *static_cast<World*>(whom);
    for (int lane = 0; lane < lanes<T>; ++lane) {
      const int i = self.body_.particle(row, block, lane);
      if (i < 0 || self.scene_.model.particles.pinned[i]) continue;
      const auto at = [lane](const T* p) { return Vec3(p[lane], p[lanes<T> + lane], p[2 * lanes<T> + lane]); };
      Vec3 place = at(x), speed = at(v);
      // where it was when the step began
      const Vec3 before_step = self.body_.position(i) - self.kicks_.back().on * self.body_.velocity(i);
      if (!touch(*self.spheres_, resolve_contact, self.t_, self.t_next_, before_step, place, speed)) continue;
      for (int c = 0; c < 3; ++c)
        x[c * lanes<T> + lane] = static_cast<T>(place[c]), v[c * lanes<T> + lane] = static_cast<T>(speed[c]);
    }
  }

  const Scene& scene_;
  double h_;
  Kernel<T> kernel_;
  SheetBody<T> body_;
  const Spheres* spheres_;
  std::vector<Kick<T>> kicks_;
  std::vector<Ball> balls_;
  int stride_ = 0;
  State s_;
  bool began_ = false;
  double t_ = 0, t_next_ = 0;  // s, of the step under way
  long evaluations_ = 0, coincident_ = 0;
};

template <class T>
std::unique_ptr<SheetWorld> world_on(const Weave& weave, const Chain& chain, const Scene& scene, double h, bool fast) {
  if (!fits<T>(weave)) return nullptr;
  return std::make_unique<World<T>>(chain, weave, scene, h, kernel<T>(chosen(), fast));
}

}  // namespace

std::unique_ptr<SheetWorld> sheet_world(const Stepper& stepper, ContactRule contact, const Scene& scene, double h,
                                        Precision precision, const Observer& observer) {
  const Model& model = scene.model;
  const auto* springs = model.find<Springs>();
  if (precision == Precision::plain || !stepper.chain || !springs || !only_known_terms(model)) return nullptr;
  const Chain chain = stepper.chain();
  if (model.find<Spheres>() && (contact != ContactRule::coulomb || chain.parts.size() > 1 || observer.every_step()))
    return nullptr;
  const auto weave = weave_of(*springs, model.particles.size(), scene.start.x.cwiseAbs().maxCoeff());
  if (!weave) return nullptr;
  if (precision == Precision::single) return world_on<float>(*weave, chain, scene, h, true);
  return world_on<double>(*weave, chain, scene, h, precision == Precision::fastest);
}

}  // namespace crosscheck::strip
