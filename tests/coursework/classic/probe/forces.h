// Raw numbers about a system of particles with velocities: what oracles.cpp makes features of. All on random states
// around the one that the system starts with. Runs twice, on the student's system and on what it answered (asker.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "../../check/calls.h"
#include "asker.h"
#include "draws.h"

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
    leave_obstacles();
  }

  bool answer(const std::string& call, Numbers& out) {
    if (!found(call, out)) return false;
    asker_.end(draws_.number(0, 1));
    return true;
  }

 private:
  bool found(const std::string& call, Numbers& out) {
    if (call == "purity") return purity(out, false);
    if (call == "kept") return purity(out, true);
    if (call == "motion") return motion(out);
    if (call == "gravity") return gravity(out);
    if (call == "drag") return drag(out);
    if (call == "springs") return springs(out);
    return false;
  }

  /// Entries in the state, entries of evalF; then for every entry f with another state stored, the same again, f with
  /// the same state stored, and what the stored one has changed by; where a base class that loses what is stored was
  /// asked for already, `from_there`: since it was stored.
  bool purity(Numbers& out, bool from_there) {
    const State stored = around(1), given = around(1);
    const Indices chosen = draws_.sample(start_.size());
    asker_.store(stored);
    const Some before = asker_.stored(chosen);
    const Some f = asker_.some(given, chosen), again = asker_.some(given, chosen);
    const Some after = asker_.stored(chosen);
    asker_.store(given);
    const Some same = asker_.some(given, chosen);
    out = {double(start_.size()), double(f.size)};
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const double since = from_there ? before.entries[i][k] : stored[chosen[i]][k];
        const double change = double(after.entries[i][k]) - since;
        out.insert(out.end(), {f.entries[i][k], again.entries[i][k], same.entries[i][k], change});
      }
    return true;
  }

  /// Count of particles, the velocity of each at the start; then three states after each other, for every particle v,
  /// x' and v'.
  bool motion(Numbers& out) {
    out = {double(n_)};
    for (std::size_t i = 0; i < n_; ++i) push(out, {start_[v(i)]});
    for (int draw = 0; draw < 3; ++draw) {
      const State given = around(1), f = derivative(given);
      for (std::size_t i = 0; i < n_; ++i) push(out, {given[v(i)], entry(f, x(i)), entry(f, v(i))});
    }
    return true;
  }

  /// Count; three states, for every particle v' at x and at its mirror image, both at rest; then 1 where evalF repeats
  /// itself.
  bool gravity(Numbers& out) {
    out = {double(n_)};
    for (int draw = 0; draw < 3; ++draw) {
      const State given = around(0);
      State mirrored = given;
      for (std::size_t i = 0; i < n_; ++i) {
        const Plain from = plus(given[x(i)], -1, far_);  // exact, and so is the next line (away())
        mirrored[x(i)] = plus(far_, -1, from);
      }
      const State f = pulls(given, velocities()), g = pulls(mirrored, velocities());
      for (std::size_t i = 0; i < n_; ++i) push(out, {f[i], g[i]});
    }
    out.push_back(repeats(around(0)));
    return true;
  }

  /// Count of those looked at; for each the velocity w that it alone gets, and its v' at 0, w and 2 w; then 1 where
  /// evalF repeats itself.
  bool drag(Numbers& out) {
    State state = around(0);
    Indices chosen = draws_.sample(n_);
    for (std::size_t& i : chosen) i = v(i);
    const State f0 = pulls(state, chosen);
    out = {double(chosen.size())};
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      // long, so that weak drag stands out from the rounding of stiff springs
      const Plain w = plus({}, 40, draws_.direction());
      Plain& moved = state[chosen[i]];
      const Plain rest = moved;
      moved = w;
      const Plain f1 = pull(state, chosen[i]);
      moved = plus(w, 1, w);
      push(out, {w, f0[i], f1, pull(state, chosen[i])});
      moved = rest;
    }
    out.push_back(repeats(state));
    return true;
  }

  bool repeats(const State& state) {
    const State f = derivative(state);
    return alike(f, again(state, f));
  }

  /// Count, where the particles start (three each), the largest entry of x' and of v' of each on three states, its
  /// speed at the start; then 1 where evalF repeats itself; the count of those that were moved and which; then for each
  /// pair where moving b changes the v' of a: b, a, three distances, and at each the pull of a towards b and what of it
  /// is across.
  bool springs(Numbers& out) {
    out = {double(n_)};
    for (std::size_t i = 0; i < n_; ++i) push(out, {home_[x(i)]});
    Numbers speed(n_), pull(n_);
    for (int draw = 0; draw < 3; ++draw) {
      const State f = derivative(around(1));
      for (std::size_t i = 0; i < n_; ++i)
        for (int k = 0; k < 3; ++k) {
          speed[i] = std::fmax(speed[i], std::fabs(entry(f, x(i))[k]));
          pull[i] = std::fmax(pull[i], std::fabs(entry(f, v(i))[k]));
        }
    }
    out.insert(out.end(), speed.begin(), speed.end());
    out.insert(out.end(), pull.begin(), pull.end());
    for (std::size_t i = 0; i < n_; ++i) out.push_back(length(start_[v(i)]));
    State state = around(0);
    const State f = derivative(state);
    const Indices chosen = draws_.sample(n_, n_ <= 144 ? n_ : std::max<std::size_t>(24, 20000 / n_));
    Numbers found;
    const bool repeats = alike(f, again(state, f)) && pairs(state, f, chosen, found);
    out.insert(out.end(), {double(repeats), double(chosen.size())});
    for (const std::size_t b : chosen) out.push_back(double(b));
    if (repeats) out.insert(out.end(), found.begin(), found.end());
    return true;
  }

  /// False where evalF did not repeat itself. Particles are moved in no foreseeable order, and as often none is: so
  /// that answers written down on another seed do not fit, although springs join the same particles there.
  bool pairs(State& state, const State& f, const Indices& chosen, Numbers& found) {
    Indices order = chosen;
    order.resize(2 * chosen.size(), n_);
    draws_.shuffle(order);
    for (const std::size_t b : order) {
      if (b == n_) {
        if (!alike(f, again(state, f))) return false;
        continue;
      }
      const Plain place = state[x(b)];
      state[x(b)] = plus(place, 0.37f * spacing_, draws_.direction());
      const State g = again(state, f);
      for (std::size_t a = 0; a < n_; ++a)
        if (a != b && !same(entry(f, v(a)), entry(g, v(a)))) pair(state, b, a, found);
      state[x(b)] = place;
    }
    return true;
  }

  /// Leaves b anywhere.
  void pair(State& state, std::size_t b, std::size_t a, Numbers& out) {
    float apart = length(plus(start_[x(b)], -1, start_[x(a)]));
    if (!(apart > 1e-6f)) apart = spacing_;
    const Plain u = draws_.direction();
    out.insert(out.end(), {double(b), double(a)});
    Numbers found;
    for (const float part : {0.6f, 1.1f, 1.9f}) {
      const float s = part * apart;
      out.push_back(s);
      state[x(b)] = plus(state[x(a)], s, u);
      const Plain ahead = pull(state, v(a));
      state[x(b)] = plus(state[x(a)], -s, u);
      // what other springs and gravity do to a is in both, and cancels
      const Plain twice = plus(ahead, -1, pull(state, v(a)));
      const float along = twice[0] * u[0] + twice[1] * u[1] + twice[2] * u[2];
      found.insert(found.end(), {along / 2.0, length(plus(twice, -along, u)) / 2.0});
    }
    out.insert(out.end(), found.begin(), found.end());
  }

  // Stored first, so that an evalF that looks at the stored state shows its forces all the same, and loses only where
  // that is asked.
  State derivative(const State& state) {
    asker_.store(state);
    return asker_.whole(state);
  }
  State again(const State& state, const State& known) {
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

  /// x' = v tells which entries are velocities; where neither way fits, the usual one holds.
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

  /// A sphere or a floor of the student's own is in the way of where the system starts, and forces then depend on the
  /// place. Where they are the same at two places far away, each as far as any obstacle that was seen, and apart from
  /// each other, all is asked at the first of them. Where they differ there too (particles drawn to a place), nothing
  /// is moved.
  void leave_obstacles() {
    Plain low = start_[x(0)], high = low;
    for (std::size_t i = 0; i < n_; ++i)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::fmin(low[k], start_[x(i)][k]);
        high[k] = std::fmax(high[k], start_[x(i)][k]);
      }
    const Plain centre = plus(low, 0.5f, plus(high, -1, low));
    // twenty times what the system spans, and twenty whatever it spans; obstacles are as large as the system
    const float size = 20 * std::fmax(length(plus(high, -1, low)), 1.0f);
    if (!(size < 1e6f)) return;
    const State given = around(1);
    const State first = pulls(away(given, centre, size, 0), velocities());
    const State second = pulls(away(given, centre, size, 1), velocities());
    int alike = 0;
    float largest = 0;
    for (const Plain& one : first) largest = std::fmax(largest, length(one));
    // positions are rounded to 1e-5 of the span out there, springs are drawn by about a tenth of their length
    for (std::size_t i = 0; i < n_; ++i) alike += length(plus(first[i], -1, second[i])) <= 1e-2f * largest;
    if (!(largest > 0) || alike < static_cast<int>(n_)) return;
    start_ = away(start_, centre, size, 0);
    far_ = corner(size, 0);
  }

  /// 1.5 times a power of two each way: what is added to it, and taken from it, is rounded alike.
  static Plain corner(float size, int which) {
    const float one = 1.5f * std::exp2(std::ceil(std::log2(size)));
    return which == 0 ? Plain{{one, one, one}} : Plain{{-one, one, one}};
  }
  State away(const State& state, const Plain& centre, float size, int which) const {
    State moved = state;
    for (std::size_t i = 0; i < n_; ++i) moved[x(i)] = plus(corner(size, which), 1, plus(state[x(i)], -1, centre));
    return moved;
  }

  /// Where in the state a particle's position and velocity are.
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

  static void push(Numbers& out, const State& vectors) {
    for (const Plain& one : vectors) out.insert(out.end(), one.at, one.at + 3);
  }

  Asker& asker_;
  Draws draws_;
  State start_;  // around which all is asked
  State home_;   // which the system starts with
  std::size_t n_;
  Plain far_;           // from there to start_, where that is elsewhere
  float spacing_ = 0;   // the least distance of two that follow each other
  bool apart_ = false;  // all positions, then all velocities
};

}  // namespace probe
