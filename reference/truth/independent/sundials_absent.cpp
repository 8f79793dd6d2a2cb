// Replaces SUNDIALS if the suite is built without it.

#include "mysim/base/errors.h"
#include "reference/truth/independent/integrators.h"

namespace crosscheck {
namespace {

[[noreturn]] void refuse() {
  throw Unsupported("the suite was built without SUNDIALS (Debian's package libsundials-dev)");
}

}  // namespace

Outcome run_arkode(const Scene&, const Run&, Observer&) { refuse(); }
Outcome run_arkode_order4(const Scene&, const Run&, Observer&) { refuse(); }
Outcome run_cvode(const Scene&, const Run&, Observer&) { refuse(); }

std::optional<std::string> sundials_version() { return std::nullopt; }

}  // namespace crosscheck
