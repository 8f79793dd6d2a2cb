// Questions to a system of particles with velocities, on random states around its initial state; oracles.cpp judges the
// findings. Runs twice: on the student's system, and on its recorded answers (asker.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "../../check/calls.h"
#include "asker.h"
#include "draws.h"
#include "findings.h"

namespace probe {

class Forces {
 public:
  using Numbers = coursework::Numbers;

  Forces(Asker& asker, std::uint64_t seed)
      : asker_(asker), draws_(seed), start_(asker.start()), home_(start_), n_(start_.size() / 2) {
    if (n_ == 0) throw coursework::Unusable("no_velocity");
    find_layout();
    for (std::size_t i = 1; i < n_; ++i) {
      const float d = length(plus(start_[x(i)], -1, start_[x(i - 1)]));
      if (std::isfinite(d) && d > 1e-6f && (spacing_ == 0 || d < spacing_)) spacing_ = d;
    }
    if (spacing_ == 0) spacing_ = 1;
    if (!leave_obstacles()) find_ties();
    tied_.resize(n_);
  }

  /// Returns false if the call is not a question.
  bool answer(const std::string& call, Findings& out) {
    out.tied = tied_;
    if (call == "purity" || call == "kept")
      purity(out, call == "kept");
    else if (call == "motion")
      motion(out);
    else if (call == "gravity")
      gravity(out);
    else if (call == "drag")
      drag(out);
    else if (call == "springs")
      springs(out);
    else
      return false;
    asker_.end(draws_.number(0, 1));
    return true;
  }

 private:
  /// If `from_there`, counts changes relative to the state that was read back after storing. A base class that loses
  /// the state then loses no points here, but only in another test.
  void purity(Findings& out, bool from_there) {
    const State stored = around(1), given = around(1);
    const Indices chosen = draws_.sample(start_.size());
    asker_.store(stored);
    const Some before = asker_.stored(chosen);
    const Some f = asker_.some(given, chosen), again = asker_.some(given, chosen);
    const Some after = asker_.stored(chosen);
    asker_.store(given);
    const Some same = asker_.some(given, chosen);
    out.n = chosen.size(), out.per_entry = double(f.size) / double(start_.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Plain& since = from_there ? before.entries[i] : stored[chosen[i]];
      out.rows.push_back({f.entries[i], again.entries[i], same.entries[i], plus(after.entries[i], -1, since)});
    }
  }

  void motion(Findings& out) {
    out.n = n_;
    for (int draw = 0; draw < 3; ++draw) {
      const State given = around(1), f = derivative(given);
      for (std::size_t i = 0; i < n_; ++i)
        out.rows.push_back({given[v(i)], entry(f, x(i)), entry(f, v(i)), start_[v(i)]});
    }
  }

  void gravity(Findings& out) {
    out.n = n_;
    // mirrors at the other end of a tie, if there is one, so that the tie's pull is reflected like all others
    const Plain mirror = silent_.empty() ? far_ : home_[x(silent_.front())];
    for (int draw = 0; draw < 3; ++draw) {
      const State given = around(0);
      State mirrored = given;
      for (std::size_t i = 0; i < n_; ++i) {
        const Plain from = plus(given[x(i)], -1, mirror);  // exact if mirror is far_, like the next line (see corner())
        mirrored[x(i)] = plus(mirror, -1, from);
      }
      const State f = pulls(given, velocities()), g = pulls(mirrored, velocities());
      for (std::size_t i = 0; i < n_; ++i) out.rows.push_back({f[i], g[i]});
    }
    out.repeats = repeats(around(0));
  }

  void drag(Findings& out) {
    State state = around(0);
    Indices chosen = draws_.sample(n_);
    for (std::size_t& i : chosen) i = v(i);
    const State f0 = pulls(state, chosen);
    out.n = chosen.size();
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      // large, so that weak drag exceeds the rounding error of stiff springs
      const Plain w = plus({}, 40, draws_.direction());
      Plain& moved = state[chosen[i]];
      const Plain rest = moved;
      moved = w;
      const Plain f1 = pull(state, chosen[i]);
      moved = rest;
      // a particle's drag depends only on its own velocity, so the motion of all others must not matter
      State all = state;
      for (std::size_t k = 0; k < n_; ++k) all[v(k)] = w;
      all[chosen[i]] = plus(w, 1, w);
      out.rows.push_back({w, f0[i], f1, pull(all, chosen[i])});
    }
    out.repeats = repeats(state);
  }

  bool repeats(const State& state) {
    const State f = derivative(state);
    return alike(f, derivative(state, f));
  }

  void springs(Findings& out) {
    out.n = n_;
    Numbers speed(n_), pull(n_);
    for (int draw = 0; draw < 3; ++draw) {
      const State f = derivative(around(1));
      for (std::size_t i = 0; i < n_; ++i)
        for (int k = 0; k < 3; ++k) {
          speed[i] = std::fmax(speed[i], std::fabs(entry(f, x(i))[k]));
          pull[i] = std::fmax(pull[i], std::fabs(entry(f, v(i))[k]));
        }
    }
    for (std::size_t i = 0; i < n_; ++i) {
      out.places.push_back(home_[x(i)]);
      out.fixed.push_back(speed[i] == 0 || pull[i] == 0);
      out.still.push_back(speed[i] == 0 || length(start_[v(i)]) == 0);
    }
    State state = around(0);
    const State f = derivative(state);
    const Indices chosen = draws_.sample(n_, n_ <= 144 ? n_ : std::max<std::size_t>(24, 20000 / n_));
    out.moved.resize(n_);
    for (const std::size_t b : chosen) out.moved[b] = true;
    out.repeats = alike(f, derivative(state, f)) && pairs(state, f, chosen, out.pulls);
  }

  /// Returns false if evalF is not deterministic. Moves one particle at a time, in random order. As many evaluations,
  /// at random places in between, move no particle. Answers recorded with another seed therefore do not fit, although
  /// the springs join the same particles.
  bool pairs(State& state, const State& f, const Indices& chosen, std::vector<Pull>& found) {
    Indices order = chosen;
    order.resize(2 * chosen.size(), n_);
    draws_.shuffle(order);
    std::vector<std::pair<std::size_t, std::size_t>> affected, joined;
    for (const std::size_t b : order) {
      if (b == n_) {
        if (!alike(f, derivative(state, f))) return false;
        continue;
      }
      const Plain place = state[x(b)];
      state[x(b)] = plus(place, 0.37f * spacing_, draws_.direction());
      const State g = derivative(state, f);
      for (std::size_t a = 0; a < n_; ++a)
        if (a != b && !same(entry(f, v(a)), entry(g, v(a)))) affected.emplace_back(b, a);
      state[x(b)] = place;
    }
    // measures some pairs of each kind; the difference of the particles' indices identifies the kind
    for (const auto& [b, a] : affected) joined.emplace_back(std::max(a, b) - std::min(a, b), std::min(a, b));
    std::sort(joined.begin(), joined.end());
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    constexpr std::size_t most = 60;
    auto measured = joined;
    const float begin = draws_.number(0, 1);
    for (std::size_t i = 0; joined.size() > most && i < most; ++i)
      measured[i] = joined[static_cast<std::size_t>((float(i) + begin) * float(joined.size()) / float(most))];
    measured.resize(std::min(measured.size(), most));
    for (const auto& [b, a] : affected) {
      const Plain place = state[x(b)];
      if (std::binary_search(measured.begin(), measured.end(),
                             std::pair(std::max(a, b) - std::min(a, b), std::min(a, b))))
        found.push_back(pair(state, b, a, false));
      else
        found.push_back({b, a, false, {}, {}, {}});
      state[x(b)] = place;
    }
    for (std::size_t a = 0; a < n_; ++a) {
      Pull best{};
      float least = 0.01f;
      for (const std::size_t b : tied_[a] ? silent_ : Indices()) {
        float off = 0;
        const Pull tie = pair(state, b, a, true, &off);
        if (off < least) least = off, best = tie;
      }
      if (best.measured) found.push_back(best);
    }
    return true;
  }

  /// Measures the pull on a at three distances from b, and leaves b displaced. If `is_tie`, moves all particles instead
  /// of b, which changes only the tie from a to b's initial position. Apart from a constant, the pull should be
  /// reversed when a is on the other side of b. `off` receives the relative deviation from this, which is large if a is
  /// tied to another position.
  Pull pair(State& state, std::size_t b, std::size_t a, bool is_tie, float* off = nullptr) {
    float apart = length(plus(start_[x(b)], -1, start_[x(a)]));
    if (!(apart > 1e-6f)) apart = spacing_;
    const Plain u = draws_.direction();
    const auto pull_at = [&](float at) {
      if (!is_tie) {
        state[x(b)] = plus(state[x(a)], at, u);
        return pull(state, v(a));
      }
      const Plain all = plus(plus(home_[x(b)], -at, u), -1, state[x(a)]);
      State moved = state;
      for (std::size_t i = 0; i < n_; ++i) moved[x(i)] = plus(state[x(i)], 1, all);
      return pull(moved, v(a));
    };
    Pull found{b, a, true, {0.6f * apart, 1.1f * apart, 1.9f * apart}, {}, {}};
    Plain first;
    float odd = 0, most = 0;
    for (int i = 0; i < 3; ++i) {
      // the contributions of other springs and gravity cancel in the difference
      const Plain ahead = pull_at(found.at[i]), behind = pull_at(-found.at[i]), twice = plus(ahead, -1, behind);
      const float along = twice[0] * u[0] + twice[1] * u[1] + twice[2] * u[2];
      found.along[i] = along / 2, found.across[i] = length(plus(twice, -along, u)) / 2;
      if (i == 0) first = plus(ahead, 1, behind);
      odd = std::fmax(odd, std::fmax(2 * found.across[i], length(plus(plus(ahead, 1, behind), -1, first))));
      most = std::fmax(most, std::fabs(along));
    }
    if (off) *off = odd / most;
    return found;
  }

  // Stores the state first. An evalF that reads the stored state instead of its argument then still returns the right
  // forces here, and loses points only in the test of this mistake.
  State derivative(const State& state, const State& known = {}) {
    asker_.store(state);
    return asker_.changed(state, known);
  }
  State pulls(const State& state, const Indices& which) {
    asker_.store(state);
    return asker_.some(state, which).entries;
  }
  Plain pull(const State& state, std::size_t which) { return pulls(state, {which}).front(); }

  bool alike(const State& f, const State& g) const {
    bool all = true;
    for (std::size_t i = 0; i < n_; ++i) all = all && same(entry(f, v(i)), entry(g, v(i)));
    return all;
  }

  /// Determines from x' = v which entries are velocities; assumes the usual layout if neither fits.
  void find_layout() {
    int fits[2] = {0, 0};
    for (int draw = 0; draw < 2; ++draw) {
      State state = start_;
      for (Plain& s : state) s = plus(s, 0.2f, draws_.direction());
      const State f = derivative(state);
      if (f.size() < 2 * n_) continue;
      for (std::size_t i = 0; i < n_; ++i) {
        fits[0] += same(f[2 * i], state[2 * i + 1]);
        fits[1] += same(f[i], state[n_ + i]);
      }
    }
    apart_ = fits[1] > fits[0];
  }

  /// Forces may depend on the position near obstacles, such as a sphere or a floor at the initial state. To avoid them,
  /// compares the forces at two places that are far from each other and from the initial state, beyond all obstacles
  /// seen so far. If the forces are equal, asks all questions at the first place. If not (for example because a place
  /// attracts the particles), moves nothing.
  bool leave_obstacles() {
    Plain low = start_[x(0)], high = low;
    for (std::size_t i = 0; i < n_; ++i)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::fmin(low[k], start_[x(i)][k]);
        high[k] = std::fmax(high[k], start_[x(i)][k]);
      }
    const Plain centre = plus(low, 0.5f, plus(high, -1, low));
    // distance of the places: twenty times the extent of the system, at least 20; obstacles are as large as the system
    const float size = 20 * std::fmax(length(plus(high, -1, low)), 1.0f);
    if (!(size < 1e6f)) return false;
    const State given = around(1);
    const State first = pulls(away(given, centre, size, 0), velocities());
    const State second = pulls(away(given, centre, size, 1), velocities());
    int alike = 0;
    float largest = 0;
    for (const Plain& one : first) largest = std::fmax(largest, length(one));
    // Positions at those places are rounded to 1e-5 of the extent. This changes forces by less than 1e-2, because
    // springs are stretched by about a tenth of their length.
    for (std::size_t i = 0; i < n_; ++i) alike += length(plus(first[i], -1, second[i])) <= 1e-2f * largest;
    if (!(largest > 0) || alike < static_cast<int>(n_)) return false;
    start_ = away(start_, centre, size, 0);
    far_ = corner(size, 0);
    return true;
  }

  /// Finds particles whose forces change when all particles are moved alike. They are attached to something that is not
  /// a particle, such as a hinge in the world, or to held particles whose positions evalF does not read from the state
  /// (silent_). If more than half of the particles are affected, there is another cause, and none is regarded as tied.
  void find_ties() {
    const State given = around(0);
    State moved = given;
    const Plain d = draws_.direction();
    for (std::size_t i = 0; i < n_; ++i) moved[x(i)] = plus(given[x(i)], 0.37f * spacing_, d);
    const State here = pulls(given, velocities()), there = pulls(moved, velocities());
    float largest = 0;
    for (const Plain& one : here) largest = std::fmax(largest, length(one));
    std::vector<bool> tied;
    std::size_t count = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      // positions are rounded to 1e-6 of the displacement
      tied.push_back(length(plus(here[i], -1, there[i])) > 1e-4f * largest);
      count += tied.back();
    }
    if (count == 0 || 2 * count > n_) return;
    tied_ = tied;
    constexpr std::size_t most = 8;
    for (std::size_t i = 0; i < n_ && silent_.size() < most; ++i) {
      if (!same(here[i], {}) || !same(there[i], {})) continue;
      State one = given;
      one[x(i)] = plus(given[x(i)], 0.37f * spacing_, d);
      const State f = pulls(one, velocities());
      bool alike = true;
      for (std::size_t k = 0; k < n_; ++k) alike = alike && same(f[k], here[k]);
      if (alike) silent_.push_back(i);
    }
  }

  /// A vector whose components are 1.5 times a power of two, so that additions and subtractions round alike.
  static Plain corner(float size, int which) {
    const float one = 1.5f * std::exp2(std::ceil(std::log2(size)));
    return which == 0 ? Plain{{one, one, one}} : Plain{{-one, one, one}};
  }
  State away(const State& state, const Plain& centre, float size, int which) const {
    State moved = state;
    for (std::size_t i = 0; i < n_; ++i) moved[x(i)] = plus(corner(size, which), 1, plus(state[x(i)], -1, centre));
    return moved;
  }

  /// Indices of a particle's position and velocity in the state.
  std::size_t x(std::size_t i) const { return apart_ ? i : 2 * i; }
  std::size_t v(std::size_t i) const { return apart_ ? n_ + i : 2 * i + 1; }
  Indices velocities() const {
    Indices all;
    for (std::size_t i = 0; i < n_; ++i) all.push_back(v(i));
    return all;
  }

  State around(float speed) {
    State state = start_;
    for (std::size_t i = 0; i < n_; ++i) state[x(i)] = plus(start_[x(i)], 0.3f * spacing_, draws_.direction());
    for (std::size_t i = 0; i < n_; ++i) {
      const float size = speed * draws_.number(0.5, 1.5);
      state[v(i)] = plus({}, size, draws_.direction());
    }
    return state;
  }

  Asker& asker_;
  Draws draws_;
  State start_;  // all questions are asked around this state
  State home_;   // initial state of the system
  std::size_t n_;
  Plain far_;               // displacement from home_ to start_, if they differ
  float spacing_ = 0;       // the smallest distance of two consecutive particles
  bool apart_ = false;      // the state holds all positions, then all velocities
  std::vector<bool> tied_;  // particles attached to something that is not a particle
  Indices silent_;          // held particles that pull no other particle, if some particles are tied
};

}  // namespace probe
