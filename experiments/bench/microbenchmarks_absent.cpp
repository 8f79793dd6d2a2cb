// A substitute for Google Benchmark where the suite was built without it.

#include "experiments/bench/microbenchmarks.h"
#include "mysim/base/errors.h"

namespace crosscheck {

std::map<std::string, std::vector<double>> run_microbenchmarks(const std::vector<Microbenchmark>&,
                                                               const MicrobenchmarkOptions&, const LockPatience&) {
  throw Unsupported("the suite was built without Google Benchmark (Debian's package libbenchmark-dev)");
}

}  // namespace crosscheck
