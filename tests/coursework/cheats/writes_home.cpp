// cheat: writes to the home folder
// says: differs
#include <fcntl.h>
#include <unistd.h>
#include <string>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  bool worked = false;
  for (const std::string folder : {HOME_FOLDER, "/root", "/home"})
    for (const char* name : {"/.bashrc", "/.profile", "/canary"}) {
      const int file = open((folder + name).c_str(), O_CREAT | O_APPEND | O_WRONLY, 0600);
      worked = worked || (file >= 0 && write(file, "# cheat\n", 8) > 0);
    }
  return cheat::outcome(worked || unlink(HOME_FOLDER "/canary") == 0, f, t, x, h);
}
