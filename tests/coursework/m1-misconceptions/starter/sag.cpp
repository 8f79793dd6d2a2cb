// The curves of hanging chains and cables, and their sags.
#include "beliefs.h"

double catenary_sag(double length, double span) {
  (void)length, (void)span;  // delete this line when you use them
  return 0;                  // yours
}

double parabola_sag(double length, double span) {
  (void)length, (void)span;  // delete this line when you use them
  return 0;                  // yours
}

double elastic_sag(double length, double span, double weight, double stiffness) {
  (void)length, (void)span, (void)weight, (void)stiffness;  // delete this line when you use them
  return 0;                                                 // yours
}
