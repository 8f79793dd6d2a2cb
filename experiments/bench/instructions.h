// Which instruction set mysim uses, for a while.
#pragma once

#include <optional>
#include <string>

#include "mysim/strip/kernels.h"

namespace crosscheck {

/// For as long as it is there mysim's fast paths keep to an instruction set, as CROSSCHECK_INSTRUCTIONS does it from
/// outside; afterwards all is as before. Not for use beside other threads.
class Instructions {
 public:
  explicit Instructions(strip::Isa isa);
  ~Instructions();
  Instructions(const Instructions&) = delete;
  Instructions& operator=(const Instructions&) = delete;

 private:
  std::optional<std::string> before_;
};

}  // namespace crosscheck
