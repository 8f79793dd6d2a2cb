// Where the cloth of scene drop-aside, which should slide off its ball, is in the end: shared by a finding and a
// figure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/table.h"

namespace crosscheck {

/// A method's last state, at the finest step of mysim/symplectic-euler.
struct DrapeEnd {
  std::string method;
  double height, end;           // m, of the centre; s
  std::optional<double> creep;  // m/s, of the particles that touch; empty where none does
  /// "still touches it, sliding at 1.95 mm/s"
  std::string touch_text() const;
};

/// Of table `sphere-drape`: mysim/symplectic-euler first, then those of Bullet and the sticky sphere, as far as they
/// came to the end. Empty where mysim/symplectic-euler did not.
std::vector<DrapeEnd> drape_ends(const Table& drapes);
/// "At 1.6 s it is off the ball with a and b; with c it still touches it, frozen."
std::string drape_end_sentence(const std::vector<DrapeEnd>& ends);

}  // namespace crosscheck
