// Scenes whose equations of motion are linear, split into modes that do not know each other.
#pragma once

#include <optional>
#include <vector>

#include "mysim/scene.h"

namespace crosscheck {

/// u'' = -w2 (u - sway d) - drag u' - dashpot (u' - sway d') + push, where d(t) is the displacement of moved pins along
/// the line. The particles are displaced by u(t) times the shape.
struct Mode {
  double w2;       // 1/s^2; 0 without springs
  double drag;     // 1/s
  double dashpot;  // 1/s
  double push;     // m/s^2, of gravity and steady wind
  double sway;     // 1
  double u0, v0;   // m, m/s, at the start
  Points shape;    // 3 x n, its largest entry 1 or so; 0 at pins
};

struct LinearScene {
  Points rest;  // 3 x n, m: u = 0, where the springs alone would hold the particles; the start, without springs
  std::vector<Mode> modes;
  double shake = 0;  // m, amplitude of d along the line; 0: the pins stand still

  /// Smallest length that a spring is left with when each mode reaches `amplitude` (m) to either side of `centre` (m)
  /// and moved pins reach theirs; 0 or less: it may turn over, and the scene is linear no more. Infinite without
  /// springs.
  double room(const Model& model, const std::vector<double>& centre, const std::vector<double>& amplitude) const;
};

/// The modes of a scene that is one of these, or nothing:
///   - one free particle under gravity, steady wind and drag: three modes;
///   - Hooke's springs and masses on a line, at least one of them pinned, gravity, steady wind, speeds and the motion
///     of the pins along it, one drag rate for all, and dashpots in proportion to the stiffness (always so with one
///     free mass).
/// Whether a spring turns over is left to the caller.
std::optional<LinearScene> linear_scene(const Scene& scene);

}  // namespace crosscheck
