// Calls of gradient and jacobi_pass. Input: a net, h, ahead (3 n), x (3 n).
//   pass.gradient, pass.jacobi     three numbers for each particle
#include "calls_read.h"

namespace coursework {

bool answer_pass(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "pass.gradient" && call != "pass.jacobi") return false;
  Reader reader(in);
  const Net net = read_net(reader);
  const std::size_t n = net.held.size();
  const double h = reader.number();
  const std::vector<Vec3> ahead = reader.vectors<Vec3>(n), x = reader.vectors<Vec3>(n);
  put(out, of_all(x, [&] { return (call == "pass.gradient" ? gradient : jacobi_pass)(net, ahead, x, h); }));
  return true;
}

}  // namespace coursework
