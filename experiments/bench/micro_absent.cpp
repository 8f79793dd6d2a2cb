// What stands in for Google Benchmark where the suite was built without it.
#include "experiments/bench/micro.h"
#include "mysim/errors.h"

namespace crosscheck {

std::map<std::string, std::vector<double>> measured(const std::vector<Micro>&, const MicroPlan&) {
  throw Unsupported("the suite was built without Google Benchmark (Debian's package libbenchmark-dev)");
}

}  // namespace crosscheck
