// A round cloth over a smaller disc, as a net of rings and spokes: Cusick's drape test, without contact.
//
// The net is that of mysim/terms/bending.h in polar coordinates. A thin plate of Poisson's ratio 0 has an energy per
// area of B/2 times
//   |x_rr|^2 + 2 |(x_t / r)_r|^2 + |x_r / r + x_tt / r^2|^2,   with the angle t (rad),
// the square of the second derivatives of x in polar coordinates (S. Timoshenko and S. Woinowsky-Krieger, Theory of
// Plates and Shells, chapter 9). For rings at distances d and spokes at angles D, to second order in both,
//   x_rr = (x_{i-1} - 2 x_i + x_{i+1}) / d^2                   on the area r d D of a particle,
//   (x_t / r)_r = ((x_11 - x_10) / r_{i+1} - (x_01 - x_00) / r_i) / (2 sin(D/2) d)   on the area of a cell, and
//   x_r / r + x_tt / r^2 = (x_{i+1} - x_{i-1}) / (2 d r) + (x_{j-1} - 2 x_j + x_{j+1}) / (2 (1 - cos D) r^2).
// The sines and cosines make these expressions vanish if x is linear in the positions on the flat sheet, so that the
// flat sheet is free of strain to the last digit. On the rim, whose particles have half the area, x_r is the difference
// from the next inner ring, because x_rr is small there: no moment acts on a free edge.
//
// In its plane the net is isotropic, with moduli C11 and C12 = C66 = C11 / 3. For a cell with sides p and q along
// spokes and rings and diagonals l = (p^2 + q^2)^(1/2), the following springs contribute equally to every cell
// (moduli.h):
//   diagonals C66 l^2 / (2 p q), along spokes (C11 - C66 p^2 / q^2) q / p, along rings (C11 - C66 q^2 / p^2) p / q.
#pragma once

#include "mysim/scene/scene.h"

namespace crosscheck {

/// Specimen and disc as in ISO 9073-9: 30 and 18 cm in diameter.
struct DrapedDisc {
  int rings;               // number of free rings between the disc and the rim
  double rigidity;         // B, N m
  double shear = 40;       // C66, N/m
  double density = 0.15;   // kg/m^2
  double gravity = 9.81;   // m/s^2
  double specimen = 0.15;  // m, radii
  double disc = 0.09;

  int spokes() const { return 10 * rings; }  // so that q^2 < 3 p^2 up to the rim (positive stiffness)
  double spacing() const { return (specimen - disc) / (rings + 0.5); }
  /// Radius of a ring, m. Ring 0 is pinned half a spacing inside the disc's edge; ring 1 is half a spacing outside. The
  /// last ring, number rings + 1, is the rim.
  double radius(int ring) const { return disc + (ring - 0.5) * spacing(); }
  int particle(int ring, int spoke) const { return ring * spokes() + (spoke + spokes()) % spokes(); }
};

/// The scene of the flat sheet. The height is y.
Scene disc_scene(const DrapedDisc& disc);

/// Initial shape for the search: a flat sheet with `waves` waves of one centimetre around the rim, and noise of ten
/// micrometres that breaks their symmetry. If waves = 0, the waves are random, with two to nine around the rim.
Points wavy(const DrapedDisc& disc, int waves, unsigned seed);

/// The shape x of net `from`, transferred to net `to` by cubic interpolation.
Points on_net(const DrapedDisc& from, const Points& x, const DrapedDisc& to);

/// Drape coefficient (projected area - disc) / (specimen - disc), %. All areas are those of the net's polygons; the
/// projected area includes everything below any part of the cloth.
double drape_coefficient(const DrapedDisc& disc, const Points& x);

/// Number of nodes of the drape: maxima of the rim's distance from the axis.
int nodes_of(const DrapedDisc& disc, const Points& x);

}  // namespace crosscheck
