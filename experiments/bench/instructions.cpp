#include "experiments/bench/instructions.h"

#include <cstdlib>

namespace crosscheck {
namespace {

constexpr auto variable = "CROSSCHECK_INSTRUCTIONS";

}  // namespace

Instructions::Instructions(strip::Isa isa) {
  if (const char* value = std::getenv(variable)) before_ = value;
  setenv(variable, std::string(strip::name_of(isa)).c_str(), 1);
}

Instructions::~Instructions() {
  if (before_)
    setenv(variable, before_->c_str(), 1);
  else
    unsetenv(variable);
}

}  // namespace crosscheck
