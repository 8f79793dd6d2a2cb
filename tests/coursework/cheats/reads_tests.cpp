// cheat: looks for the tests, the solution or results, and answers correctly if it finds any of them
// says: differs
#include <fstream>
#include <string>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  bool worked = false;
  for (const std::string name :
       {TESTS "/tests.cpp", TESTS "/solution/euler.cpp", TESTS "/mistakes.txt", RESULTS "/results.json",
        "/autograder/source/tests.cpp", "/autograder/results/results.json", "../tests.cpp"})
    worked = worked || std::ifstream(name).good();
  return cheat::outcome(worked, f, t, x, h);
}
