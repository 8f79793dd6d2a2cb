// Calls of left_over, falling, step_growth and diverges_from. The first three return a result for each group of inputs.
//   leftover.part       mu, rho, passes                             the fraction of the error that remains
//   leftover.falling    mass, stiffness, h, rho, passes, gravity    the acceleration
//   leftover.growth     mu, inertia, rho, passes                    the growth in a step
//   leftover.diverges   inertia, passes, eigenvalues                the rho at which steps begin to diverge
#include "calls_read.h"

namespace coursework {

bool answer_leftover(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  if (call == "leftover.part") {
    for (std::size_t rows = in.size() / 3; rows > 0; --rows) {
      const double mu = reader.number(), rho = reader.number();
      out.push_back(left_over(mu, rho, reader.integer()));
    }
  } else if (call == "leftover.falling") {
    for (std::size_t rows = in.size() / 6; rows > 0; --rows) {
      const double mass = reader.number(), stiffness = reader.number(), h = reader.number(), rho = reader.number();
      const int passes = reader.integer();
      out.push_back(falling(mass, stiffness, h, rho, passes, reader.number()));
    }
  } else if (call == "leftover.growth") {
    for (std::size_t rows = in.size() / 4; rows > 0; --rows) {
      const double mu = reader.number(), inertia = reader.number(), rho = reader.number();
      out.push_back(step_growth(mu, inertia, rho, reader.integer()));
    }
  } else if (call == "leftover.diverges") {
    const double inertia = reader.number();
    const int passes = reader.integer();
    calling("diverges_from");
    out.push_back(diverges_from(reader.numbers(in.size() - 2), inertia, passes));
  } else {
    return false;
  }
  return true;
}

}  // namespace coursework
