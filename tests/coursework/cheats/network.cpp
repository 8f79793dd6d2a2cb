// cheat: connects to the internet
// says: differs
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  bool worked = false;
  for (const int kind : {SOCK_STREAM, SOCK_DGRAM})
    for (const int family : {AF_INET, AF_INET6, AF_UNIX}) {
      const int fd = socket(family, kind, 0);
      if (fd < 0) continue;
      worked = true;
      close(fd);
    }
  return cheat::outcome(worked, f, t, x, h);
}
