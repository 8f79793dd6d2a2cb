#pragma once

#include "experiments/tables/typed.h"
#include "reference/certificate/certificate.h"

namespace crosscheck {

template <>
inline constexpr std::pair range_of<Parity>{Parity::match, Parity::unattested};

struct AttestedRow {
  TABLE("certificates");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(std::string, quantity, "quantity", "1", "quantity that was read back");
  COLUMN(std::string, requested, "asked", "1", "value in the scene");
  COLUMN(std::string, mapped, "handed over", "1", "value passed to the engine");
  COLUMN(std::string, read_back, "read back", "1", "value in the engine");
  COLUMN(Parity, parity, "parity", "1", "whether the value that was read back matches the scene");
};

}  // namespace crosscheck
