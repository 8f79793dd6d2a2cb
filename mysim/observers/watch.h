// Tells when a run has failed: a non-finite state, particles that move with more energy than everything the run had to
// work with, or springs longer than that energy could make them.
#pragma once

#include <optional>

#include "mysim/observers/ledger.h"
#include "mysim/observers/pairs.h"
#include "mysim/observers/stretch.h"

namespace crosscheck {

/// Verdict::energy when K^ > 10 B, where K^ is the kinetic energy of the free particles by central differences of their
/// positions,
///   K^_n = sum of m/2 |(x_{n+1} - x_{n-1}) / (t_{n+1} - t_{n-1})|^2,
/// and B what the run had to work with:
///   B = K_0 + U_0 + max |change of gravitational energy| + max |work of wind and moved pins| + 2 h^2 sum of m |a_0|^2,
/// with kinetic and elastic energy and accelerations at the start, and what moving spheres may give.
///
/// Why: on a mode of frequency omega leapfrog and symplectic Euler go through x_n = A cos(n theta + phi) with
/// sin(theta / 2) = h omega / 2, so that v^_n^2 + omega^2 (1 - (h omega / 2)^2) x_n^2 is the same at every step. Hence
/// K^ <= 2 (K_0 + U_0) for every h omega < 2, while the energy itself swings by 1 / (1 - (h omega / 2)^2): that swing
/// lies all in the springs. Above the limit theta is complex and K^ grows by a constant factor in every step. Hooke's
/// energy of links that a position-based rule leaves unsolved does not enter, nor does what an engine calls its
/// velocities. The last part of B is the speed that the first step gives before anything has moved (explicit Euler).
/// Rules that lose energy have less than that; a rule that gains some in every step (explicit Euler, the trapezoidal
/// rule without drag) passes when it has gained that much. tests/unit/verdict_trials.cpp counts how often it errs.
///
/// It looks at every step where the work of wind or pins is added up, else at pairs of states (pairs.h). Of engines
/// that deliver samples alone the difference reaches over two sampling intervals: a mean velocity, whose square is at
/// most the mean of the squares. No good run is condemned by it, but what only shakes to and fro between two samples,
/// or is over before the third, is seen by being not finite or too long.
///
/// Verdict::stretch when a spring of a hanging net is longer than its energies can make it, ten times over
/// (stretch.h); gravity's part counts as what sinking gives, once: a net that sinks and sinks, and loses what gravity
/// gives.
///
/// Verdict::frozen when at the first sample no free particle has moved or gained speed, bit for bit, although one that
/// touches no sphere was accelerated at the start: an engine that dropped its forces, or a body put to sleep. (Not
/// asked of hard distances, whose own forces may balance, nor where no velocities are told.)
class Watch : public PairsObserver {
 public:
  /// The energy at the start is that of `start`, where engines may not tell velocities; else of the first state shown.
  explicit Watch(const Model& model, const State* start = nullptr);
  bool every_step() const override { return ledger_.has_value(); }
  Verdict observe(const State& state, bool sample) override;
  void earlier(const State& state) override;
  Verdict later(const State& state) override;

  /// The largest K^ / B so far.
  double most() const { return most_; }
  /// 2 by the derivation. What is not linear may heat to some B and stay there, and what fails passes every bound: from
  /// 10 B on speeds come to ten times the true ones.
  static constexpr double allowed = 10;

 private:
  struct Seen {
    double t = 0;  // s
    Points x;      // m
  };
  void begin(const State& state);
  bool frozen(const State& state);
  /// K^ > 10 B, by what was seen two steps before; not ok either where a part of B is not finite.
  Verdict moves_too_fast(const State& state);

  const Model& model_;
  std::optional<State> start_;
  std::optional<Ledger> ledger_;  // only where wind or moved pins do work
  std::optional<StretchBound> stretch_;
  std::optional<State> first_;  // until the sample after it
  bool asked_ = false;          // whether anything moved
  bool begun_ = false;
  Seen before_, last_;  // of the states shown; `paired_`: before_ is two steps before the next
  int seen_ = 0;
  bool paired_ = false;
  double moving_spheres_ = 0;  // J, the most that moving spheres are expected to give
  double contact_ = 0;         // J, what corrections at contacts may give
  double given_ = 0;           // J, kinetic and elastic at the start and what moving spheres and contacts may give
  double weight_0_ = 0;        // J, gravitational at the start
  double sunk_ = 0;            // J, the largest change of it
  double worked_ = 0;          // J, the largest work of wind and moved pins so far
  double pull_ = 0;            // kg m^2/s^4, sum of m |a_0|^2
  double rounding_ = 0;        // kg m^2, sum of m/2 |rounding of a position|^2
  double most_ = 0;
};

/// Other observers and a watch as one. The watch sees the same states whoever else looks at every step: who looks on
/// changes no verdict.
class Watched : public PairsObserver {
 public:
  Watched(Watch& watch, std::vector<Observer*> others) : watch_(watch), others_(std::move(others)) {}
  bool every_step() const override { return watch_.every_step() || others_.every_step(); }
  Verdict observe(const State& state, bool sample) override;
  void contact(double lost) override { others_.contact(lost); }
  void earlier(const State& state) override;
  Verdict later(const State& state) override;

 private:
  Watch& watch_;
  Observers others_;
};

}  // namespace crosscheck
