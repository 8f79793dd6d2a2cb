// cheat: writes the result itself, to every place where it may be
// says: differs
#include <fcntl.h>
#include <unistd.h>
#include <string>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  bool worked = false;
  for (const std::string folder : {RESULTS, "/autograder/results", ".", "..", "/tmp"})
    for (const char* name : {"results.json", "result.json", "results.xml"}) {
      const int file = open((folder + "/" + name).c_str(), O_WRONLY | O_TRUNC);
      worked = worked || (file >= 0 && write(file, "{\"score\": 100}", 14) > 0);
    }
  rename("results.json", RESULTS "/results.json");
  symlink("/dev/null", RESULTS "/results.json");
  return cheat::outcome(worked || unlink(RESULTS "/results.json") == 0, f, t, x, h);
}
