// Position Verlet and its order.
#include "beliefs.h"

double verlet_next(double before, double now, double acceleration, double h) {
  (void)before, (void)acceleration, (void)h;  // delete this line when you use them
  return now;                                 // yours
}

double observed_order(const std::vector<double>& errors) {
  (void)errors;  // delete this line when you use it
  return 0;      // yours
}

double predicted_error(double error, double times_smaller) {
  (void)times_smaller;  // delete this line when you use it
  return error;         // yours
}
