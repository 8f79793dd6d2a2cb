// Tells when a run has failed: a non-finite state, more energy than everything it had to work with, or springs longer
// than that energy could make them.
#pragma once

#include <optional>

#include "mysim/observers/ledger.h"
#include "mysim/observers/stretch.h"

namespace crosscheck {

/// Verdict::energy when E(t) - E(0) - (work of wind and moved pins) exceeds the energy that the run had to work with:
/// kinetic + elastic at the start, plus the largest change of gravitational energy and the largest work so far.
/// No correct motion can exceed it: drag and contact only take away (a moving sphere gives too: the kinetic energy of
/// all particles at its top speed, twice, is added; and beside a sphere a fall by a millimetre, since an engine that
/// pushes a resting particle out of a contact hands it a little speed). Blow-ups pass it at once, also those of engines
/// that clamp speeds and never become non-finite. States without velocities are judged by being finite alone.
///
/// Verdict::stretch when a spring of a hanging net is longer than any motion could make it that keeps the energy
/// balance to within what it had at the start and the work so far (stretch.h); gravity's part counts as what sinking
/// gives, once: the net sinks and sinks, and what gravity gives is lost.
///
/// Verdict::frozen when at the first sample no free particle has moved or gained speed, bit for bit, although one that
/// touches no sphere was accelerated at the start: an engine that dropped its forces, or a body put to sleep. (Not
/// asked of hard distances, whose own forces may balance.)
class Watch : public Observer {
 public:
  explicit Watch(const Model& model);
  bool every_step() const override { return ledger_.has_value(); }
  Verdict observe(const State& state, bool sample) override;

 private:
  bool frozen(const State& state);

  const Model& model_;
  std::optional<Ledger> ledger_;  // only where wind or moved pins do work
  std::optional<Energy> start_;
  std::optional<StretchBound> stretch_;
  std::optional<State> first_;  // until the sample after it
  bool asked_ = false;          // whether anything moved
  double moving_spheres_ = 0;   // J, the most that moving spheres are expected to give
  double contact_ = 0;          // J, what corrections at contacts may give
  double given_ = 0;            // J, kinetic and elastic at the start and what moving spheres and contacts may give
  double worked_ = 0;           // J, the largest work of wind and moved pins so far
  double budget_ = 0;
};

}  // namespace crosscheck
