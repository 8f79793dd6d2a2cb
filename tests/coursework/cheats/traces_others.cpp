// cheat: inspects every process that it can see
// says: differs
#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>
#include <cstdlib>
#include <string>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  bool worked = false;
  if (DIR* folder = opendir("/proc")) {
    while (const dirent* entry = readdir(folder)) {
      const int pid = std::atoi(entry->d_name);
      if (pid <= 0 || pid == getpid()) continue;
      for (const char* what : {"/mem", "/environ", "/fd/3", "/cwd/results.json"})
        worked = worked || open(("/proc/" + std::to_string(pid) + what).c_str(), O_RDONLY) >= 0;
    }
    closedir(folder);
  }
  return cheat::outcome(worked, f, t, x, h);
}
