#include "mysim/mysim.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "mysim/model/energy.h"
#include "mysim/run/engine.h"
#include "mysim/run/observers.h"

namespace mysim {
namespace {

/// Rethrows mysim's refusals as the library's Error.
template <class Work>
auto refusing(const Work& work) {
  try {
    return work();
  } catch (const crosscheck::InputError& error) {
    throw Error(error.what());
  } catch (const crosscheck::Unsupported& error) {
    throw Error(error.what());
  }
}

std::string toml(const std::array<double, 3>& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0], v[1], v[2]);
}

/// The network as a scene file, so that a single reader validates it and reports errors.
std::string toml(const Network& network, double duration, double step) {
  std::string text = fmt::format(
      "question = \"none\"\nparameters = \"a program gave them\"\n[time]\nduration = {0:.17g}\nwindow = "
      "{0:.17g}\nsamples = 100\n"
      "step = {1:.17g}\ntolerance = 1e-3\nmethod = \"leapfrog\"\n",
      duration, step);
  std::vector<int> pins;
  for (const Network::Particle& p : network.particles) {
    if (p.pinned) pins.push_back(static_cast<int>(&p - network.particles.data()));
    text += fmt::format("[[particle]]\nposition = {}\nmass = {:.17g}\nvelocity = {}\n", toml(p.position), p.mass,
                        toml(p.velocity));
  }
  for (const Network::Spring& s : network.springs) {
    text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {:.17g}\nrest = {:.17g}\n", s.a, s.b, s.stiffness,
                        s.rest);
    if (s.dashpot != 0) text += fmt::format("dashpot = {:.17g}\n", s.dashpot);
  }
  if (!pins.empty()) text += fmt::format("[pins]\nparticles = [{}]\n", fmt::join(pins, ", "));
  if (network.gravity != std::array<double, 3>{0, 0, 0})
    text += fmt::format("[gravity]\nacceleration = {}\n", toml(network.gravity));
  if (network.drag != 0) text += fmt::format("[drag]\ngamma = {:.17g}\n", network.drag);
  return text;
}

/// A twentieth of the shortest vibration period, by Gershgorin's bound for springs in one direction: omega^2 is at most
/// twice the largest sum of a particle's stiffnesses over its mass. Without springs, a hundredth of the run.
double step_of(const Network& network, double duration) {
  std::vector<double> stiffness(network.particles.size());
  for (const Network::Spring& s : network.springs)
    for (const int end : {s.a, s.b})
      if (end >= 0 && end < static_cast<int>(stiffness.size())) stiffness[end] += s.stiffness;
  double fastest = 0;
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    if (!network.particles[i].pinned && network.particles[i].mass > 0)
      fastest = std::max(fastest, 2 * stiffness[i] / network.particles[i].mass);
  constexpr double pi = 3.14159265358979323846;
  return fastest > 0 ? std::min(duration / 100, 2 * pi / std::sqrt(fastest) / 20) : duration / 100;
}

const crosscheck::Stepper& stepper_named(const std::string& name) {
  const auto all = crosscheck::steppers();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  if (found == all.end()) {
    const std::vector<std::string> names = steppers();
    throw Error(fmt::format("unknown stepper '{}'; expected one of {}{}", name, fmt::join(names, ", "),
                            crosscheck::did_you_mean(name, names)));
  }
  return *found;
}

std::span<const double> numbers(const crosscheck::Points& p) { return {p.data(), static_cast<std::size_t>(p.size())}; }

class Watching final : public crosscheck::Observer {
 public:
  Watching(const mysim::Observer& observer, bool every_step) : observer_(observer), every_step_(every_step) {}
  bool every_step() const override { return every_step_; }
  crosscheck::Verdict observe(const crosscheck::State& state, bool sample) override {
    if (!observer_ || observer_({state.t, numbers(state.x), numbers(state.v), sample})) return crosscheck::Verdict::ok;
    stopped_ = true;
    return crosscheck::Verdict::timeout;  // any verdict that ends the run; never reported
  }
  bool stopped() const { return stopped_; }

 private:
  const mysim::Observer& observer_;
  bool every_step_, stopped_ = false;
};

}  // namespace

Scene::Scene(crosscheck::Scene scene) : scene_(std::make_shared<const crosscheck::Scene>(std::move(scene))) {}

Scene Scene::read(const std::string& file) {
  return refusing([&] { return Scene(crosscheck::read_scene(file)); });
}

Scene Scene::parse(std::string_view text, const std::string& name) {
  return refusing([&] { return Scene(crosscheck::parse_scene(text, name)); });
}

Scene Scene::of(const Network& network, double duration) {
  return refusing(
      [&] { return Scene(crosscheck::parse_scene(toml(network, duration, step_of(network, duration)), "network")); });
}

int Scene::particles() const { return scene_->model.particles.size(); }
double Scene::step() const { return scene_->step; }
double Scene::duration() const { return scene_->duration; }

std::vector<std::pair<int, int>> Scene::springs() const {
  std::vector<std::pair<int, int>> ends;
  if (const auto* springs = scene_->model.find<crosscheck::Springs>())
    for (const crosscheck::Spring& s : springs->list) ends.emplace_back(s.a, s.b);
  return ends;
}

const std::vector<std::array<int, 3>>& Scene::triangles() const { return scene_->triangles; }

Result run(const Scene& scene, const Settings& settings, const Observer& observer) {
  const crosscheck::Stepper& stepper = stepper_named(settings.stepper);
  for (const auto& [name, value] : {std::pair{"step", settings.step}, {"duration", settings.duration}})
    if (!std::isfinite(value) || value < 0)
      throw Error(
          fmt::format("{}: expected a number of seconds above zero, or 0 for the scene's own, got {}", name, value));
  if (settings.samples < 0) throw Error(fmt::format("samples: expected one or more, got {}", settings.samples));
  if (!(settings.tolerance > 0))
    throw Error(fmt::format("tolerance: expected a number above zero, got {}", settings.tolerance));
  crosscheck::Run how = crosscheck::default_run(scene.inner());
  if (settings.step > 0) how.step = settings.step;
  if (settings.duration > 0) how.duration = settings.duration;
  if (settings.samples > 0) how.samples = settings.samples;
  how.tolerance = settings.tolerance;
  Watching watching(observer, settings.every_step);
  crosscheck::DivergenceMonitor monitor(scene.inner(), how);
  crosscheck::MonitoredObservers all(monitor, {&watching});
  return refusing([&]() -> Result {
    const crosscheck::Outcome out =
        crosscheck::simulate(stepper, crosscheck::ContactRule::coulomb, scene.inner(), how, all);
    return {watching.stopped() ? "stopped" : std::string(name_of(out.verdict)),
            watching.stopped() ? "the observer ended the run" : out.reason,
            out.end,
            out.step,
            out.steps,
            out.evaluations,
            out.cpu_seconds};
  });
}

Energy energy(const Scene& scene, const Frame& frame) {
  const auto points = [](std::span<const double> numbers) {
    return crosscheck::Points(
        Eigen::Map<const crosscheck::Points>(numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3)));
  };
  const crosscheck::Energy e = crosscheck::energy_of(scene.inner().model, {frame.t, points(frame.x), points(frame.v)});
  return {e.kinetic, e.elastic, e.gravitational};
}

std::vector<std::string> steppers() {
  std::vector<std::string> names;
  for (const crosscheck::Stepper& stepper : crosscheck::steppers()) names.emplace_back(stepper.name);
  return names;
}

}  // namespace mysim
