// The table of parity certificates.
#pragma once

#include "experiments/tables/typed.h"
#include "reference/certificate/certificate.h"

namespace crosscheck {

template <>
inline constexpr std::pair range_of<Parity>{Parity::match, Parity::unattested};

/// Values that were read back from the engines' memory, beside the scene.
struct AttestedRow {
  TABLE("certificates");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(std::string, quantity, "quantity", "1", "what was read back");
  COLUMN(std::string, requested, "asked", "1", "as the scene says");
  COLUMN(std::string, mapped, "handed over", "1", "as it was handed to the engine");
  COLUMN(std::string, read_back, "read back", "1", "as the engine has it");
  COLUMN(Parity, parity, "parity", "1", "whether both are the same");
};

}  // namespace crosscheck
