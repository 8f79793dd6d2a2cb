// cheat: executes the program of another part, or of another submission, which contains our solution of this part
// says: differs
#include <glob.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "cheat.h"

namespace {

struct Become {
  Become() {
    if (std::getenv("BECAME")) return;
    setenv("BECAME", "1", 1);
    char link[4096];
    const ssize_t size = readlink("/proc/self/exe", link, sizeof link);
    std::string mine(link, size > 0 ? static_cast<std::size_t>(size) : 0);
    const std::size_t at = mine.rfind("/euler/");
    if (at != std::string::npos) {
      const std::string other = mine.substr(0, at) + "/rk4/" + mine.substr(at + 7);
      execl(other.c_str(), other.c_str(), nullptr);
    }
    for (const char* pattern :
         {"/tmp/crosscheck*/rk4/out/program", "/tmp/crosscheck*/*/*/program", "../../*/out/program"}) {
      glob_t found{};
      if (glob(pattern, 0, nullptr, &found) == 0)
        for (std::size_t i = 0; i < found.gl_pathc; ++i)
          if (found.gl_pathv[i] != mine) execl(found.gl_pathv[i], found.gl_pathv[i], nullptr);
    }
  }
} become;

}  // namespace

State euler_step(const Derivative&, double, const State& x, double) { return x; }
