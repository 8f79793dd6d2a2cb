// Delta debugging of scenes: A. Zeller and R. Hildebrandt, Simplifying and isolating failure-inducing input, IEEE
// Trans. Software Eng. 28, 2002. First removes parts in halves, quarters and so on, then shortens times, then reduces
// the digits of numbers, all together and one by one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mysim/base/errors.h"
#include "tests/hunt/hunt.h"

namespace crosscheck {
namespace {

using LeaveOut = std::function<void(SceneDraft&, const std::vector<char>& gone)>;

void leave_out_particles(SceneDraft& draft, const std::vector<char>& gone) {
  std::vector<int> number(gone.size(), -1);
  std::vector<SceneDraft::Particle> left;
  for (size_t i = 0; i < gone.size(); ++i)
    if (!gone[i]) number[i] = static_cast<int>(left.size()), left.push_back(draft.particles[i]);
  draft.particles = std::move(left);
  std::erase_if(draft.springs, [&](const SceneDraft::Link& s) { return number[s.a] < 0 || number[s.b] < 0; });
  for (auto& s : draft.springs) s.a = number[s.a], s.b = number[s.b];
  std::erase_if(draft.constraints, [&](const auto& c) { return number[c[0]] < 0 || number[c[1]] < 0; });
  for (auto& c : draft.constraints) c = {number[c[0]], number[c[1]]};
}

template <class List>
void leave_out(List& list, const std::vector<char>& gone) {
  size_t i = 0;
  std::erase_if(list, [&](const auto&) { return gone[i++] != 0; });
}

/// Every number of the draft that can lose digits, in the order of its file.
std::vector<double*> numbers_of(SceneDraft& d) {
  std::vector<double*> all;
  const auto add = [&](double& value) { all.push_back(&value); };
  const auto add_vector = [&](Vec3& v) {
    for (double& part : v) add(part);
  };
  const auto add_motion = [&](std::optional<Motion>& m) {
    if (m) add_vector(m->amplitude), add(m->frequency), add(m->ramp);
  };
  for (auto& p : d.particles) add_vector(p.x), add(p.mass), add_vector(p.v);
  for (auto& s : d.springs) {
    add(s.k), add(s.dashpot);
    if (s.rest) add(*s.rest);
  }
  add_motion(d.pin_motion);
  if (d.rotation) add(*d.rotation);
  if (d.gravity) add_vector(*d.gravity);
  if (d.gamma) add(*d.gamma);
  if (d.wind) {
    add_vector(d.wind->mean);
    if (d.wind->gusts) add(d.wind->gusts->variation), add_vector(d.wind->gusts->side);
  }
  for (Sphere& s : d.spheres) {
    add_vector(s.centre), add(s.radius), add(s.margin), add(s.friction), add(s.restitution);
    add_motion(s.motion);
  }
  return all;
}

/// True if `value` has fewer digits; 0 and 1 are the simplest.
bool simpler(double value, double than) {
  const auto rank = [](double v) {
    if (v == 0) return 0;
    if (v == 1) return 1;
    for (int digits = 1; digits < 17; ++digits)
      if (to_digits(v, digits) == v) return digits + 1;
    return 18;
  };
  return rank(value) < rank(than);
}

class Shrinker {
 public:
  Shrinker(const SceneDraft& draft, const StillShows& shows, int most_trials)
      : best_{draft, 0},
        shows_(shows),
        most_trials_(most_trials),
        coarseness_(std::max(draft.step * draft.largest_rate(), 0.1)) {}

  Shrunk run() {
    for (bool changed = true; changed && !spent();) {
      changed = without_ingredients();
      changed |= without_parts(best_.draft.particles.size(), leave_out_particles);
      changed |= without_parts(best_.draft.springs.size(),
                               [](SceneDraft& d, const auto& gone) { leave_out(d.springs, gone); });
      changed |= without_parts(best_.draft.constraints.size(),
                               [](SceneDraft& d, const auto& gone) { leave_out(d.constraints, gone); });
      changed |= shorter();
      changed |= rounder();
    }
    return std::move(best_);
  }

 private:
  bool spent() const { return best_.trials >= most_trials_; }

  /// Accepts the candidate if it still shows the property. Skips candidates that were tried before or are not valid
  /// scenes, and those with a coarser step relative to their fastest rate, which would only show the effect of the
  /// step.
  bool take(SceneDraft candidate) {
    if (spent() || candidate.particles.empty() || candidate.step * candidate.largest_rate() > coarseness_) return false;
    const std::string text = candidate.text();
    if (text == best_.draft.text() || !asked_.insert(text).second) return false;
    try {
      const Scene scene = parse_scene(text, candidate.kind());
      ++best_.trials;
      if (!shows_(scene)) return false;
    } catch (const InputError&) {
      return false;
    }
    best_.draft = std::move(candidate);
    return true;
  }
  template <class Change>
  bool take_changed(Change change) {
    SceneDraft candidate = best_.draft;
    change(candidate);
    return take(std::move(candidate));
  }

  bool without_ingredients() {
    bool changed = false;
    const auto attempt = [&](auto change) { changed |= take_changed(change); };
    attempt([](SceneDraft& d) { d.springs.clear(); });
    attempt([](SceneDraft& d) { d.constraints.clear(); });
    attempt([](SceneDraft& d) { d.spheres.clear(); });
    attempt([](SceneDraft& d) { d.gravity.reset(); });
    attempt([](SceneDraft& d) { d.wind.reset(); });
    attempt([](SceneDraft& d) {
      if (d.wind) d.wind->gusts.reset();
    });
    attempt([](SceneDraft& d) { d.gamma.reset(); });
    attempt([](SceneDraft& d) {
      for (auto& s : d.springs) s.dashpot = 0;
    });
    attempt([](SceneDraft& d) { d.law = SpringLaw::hooke; });
    attempt([](SceneDraft& d) { d.pin_motion.reset(); });
    attempt([](SceneDraft& d) {
      for (auto& p : d.particles) p.pinned = false;
    });
    attempt([](SceneDraft& d) {
      for (auto& p : d.particles) p.v.setZero();
    });
    attempt([](SceneDraft& d) {
      for (auto& s : d.springs) s.rest.reset();
    });
    attempt([](SceneDraft& d) {
      for (auto& s : d.springs) s.family = Family::single;
    });
    for (size_t i = 0; i < best_.draft.particles.size(); ++i)
      if (best_.draft.particles[i].pinned) attempt([&](SceneDraft& d) { d.particles[i].pinned = false; });
    return changed;
  }

  /// Removes groups of consecutive parts: first half of all parts, then smaller groups, down to single parts.
  bool without_parts(size_t count, const LeaveOut& out) {
    bool changed = false;
    for (size_t run = (count + 1) / 2; run > 0; run = run == 1 ? 0 : (run + 1) / 2)
      for (size_t from = 0; from < count && !spent();) {
        std::vector<char> gone(count, 0);
        std::fill_n(gone.begin() + static_cast<long>(from), std::min(run, count - from), 1);
        if (take_changed([&](SceneDraft& d) { out(d, gone); }))
          count -= std::min(run, count - from), changed = true;
        else
          from += run;
      }
    return changed;
  }

  bool shorter() {
    bool changed = false;
    while (take_changed([](SceneDraft& d) {
      if (d.samples < 2) return;
      d.duration *= static_cast<double>(d.samples / 2) / d.samples, d.samples /= 2;
    }))
      changed = true;
    while (take_changed([](SceneDraft& d) {
      if (d.samples >= 2) d.samples /= 2;
    }))
      changed = true;
    return changed;
  }

  bool rounder() {
    bool changed = false;
    for (const int digits : {1, 2, 3})
      changed |= take_changed([&](SceneDraft& d) {
        for (double* number : numbers_of(d)) *number = to_digits(*number, digits);
      });
    for (size_t i = 0; i < numbers_of(best_.draft).size() && !spent(); ++i) {
      const double value = *numbers_of(best_.draft)[i];
      for (const double other : {0.0, 1.0, to_digits(value, 1), to_digits(value, 2), to_digits(value, 3)})
        if (simpler(other, value) && take_changed([&](SceneDraft& d) { *numbers_of(d)[i] = other; })) {
          changed = true;
          break;
        }
    }
    return changed;
  }

  Shrunk best_;
  const StillShows& shows_;
  int most_trials_;
  double coarseness_;  // step times the fastest rate
  std::set<std::string> asked_;
};

}  // namespace

Shrunk shrink(const SceneDraft& draft, const StillShows& shows, int most_trials) {
  return Shrinker(draft, shows, most_trials).run();
}

}  // namespace crosscheck
