// What stands in for SUNDIALS where the suite was built without it.
#include "mysim/errors.h"
#include "reference/independent/integrators.h"

namespace crosscheck {

Outcome run_arkode(const Scene&, const Run&, Observer&) {
  throw Unsupported("the suite was built without SUNDIALS (Debian's package libsundials-dev)");
}

std::optional<std::string> sundials_version() { return std::nullopt; }

}  // namespace crosscheck
