// cheat: fills the disk with files of the largest permitted size
// says: differs too_much_output
#include <fcntl.h>
#include <unistd.h>
#include <string>
#include <vector>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  const std::vector<char> block(1 << 20, 'x');
  long written = 0;
  for (const std::string folder : {".", "/tmp", "/var/tmp", "/dev/shm"})
    for (int i = 0; i < 100; ++i) {
      const int file = open((folder + "/cheat" + std::to_string(i)).c_str(), O_CREAT | O_WRONLY, 0600);
      for (int k = 0; file >= 0 && k < 10; ++k) written += write(file, block.data(), block.size()) > 0;
      if (file >= 0) close(file);
    }
  return cheat::outcome(written > 500, f, t, x, h);
}
