// Calls of verlet_next, observed_order and predicted_error.
//   verlet.next        h, acceleration, before, now       x
//   verlet.orders      omega, h, steps, amplitude, phase, halvings
//                      computes the motion amplitude * cos(omega t + phase) with h, h/2, ...; returns the order of the
//                      error of a single step, and the order of the error after the time steps * h
//   verlet.observed    number of errors, errors           the observed order
//   verlet.predicted   omega, h, steps, error, times, then the prediction of a belief, which is shown but not used
//                      the predicted error for a step that is `times` times smaller
#include <cmath>

#include "beliefs.h"
#include "calls.h"
#include "numbers.h"

namespace coursework {
namespace {

struct Motion {
  double omega, amplitude, phase;
  double at(double t) const { return amplitude * std::cos(omega * t + phase); }
};

/// Error at the time steps * h. The run starts from the exact positions at the times 0 and h.
double error_of(const Motion& motion, double h, int steps) {
  double before = motion.at(0), now = motion.at(h);
  for (int i = 1; i < steps; ++i) {
    calling("verlet_next");
    const double next = verlet_next(before, now, -motion.omega * motion.omega * now, h);
    before = now, now = next;
  }
  return std::abs(now - motion.at(steps * h));
}

double order_of(const std::vector<double>& errors) {
  calling("observed_order");
  return observed_order(errors);
}

}  // namespace

bool answer_verlet(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  if (call == "verlet.next") {
    const double h = reader.number(), acceleration = reader.number(), before = reader.number(), now = reader.number();
    calling("verlet_next");
    out = {verlet_next(before, now, acceleration, h)};
    return true;
  }
  if (call == "verlet.orders") {
    const double omega = reader.number(), h = reader.number();
    const int steps = reader.integer();
    const double amplitude = reader.number(), phase = reader.number();
    const int finest = 1 << reader.integer();
    const Motion motion{omega, amplitude, phase};
    std::vector<double> of_one, of_all;
    for (int parts = 1; parts <= finest; parts *= 2) {
      of_one.push_back(error_of(motion, h / parts, 2));
      of_all.push_back(error_of(motion, h / parts, steps * parts));
    }
    out = {order_of(of_one), order_of(of_all)};
    return true;
  }
  if (call == "verlet.observed") {
    std::vector<double> errors(static_cast<std::size_t>(reader.integer()));
    for (double& error : errors) error = reader.number();
    out = {order_of(errors)};
    return true;
  }
  if (call != "verlet.predicted") return false;
  calling("predicted_error");
  out = {predicted_error(in.at(3), in.at(4))};
  return true;
}

}  // namespace coursework
