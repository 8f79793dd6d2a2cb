// The table of parity certificates.
#pragma once

#include "experiments/tables/typed.h"
#include "reference/certificate/certificate.h"

namespace crosscheck {

template <>
struct EnumRange<Parity> {
  static constexpr Parity first = Parity::match, last = Parity::unattested;
};

struct AttestedRow {
  std::string scene, method, quantity, requested, mapped, read_back;
  Parity parity = Parity::match;

  static constexpr std::string_view table = "certificates",
                                    about = "What was read back from the engines' memory, beside the scene.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &AttestedRow::scene, "scene"), column("method", "1", &AttestedRow::method, "method"),
        column("quantity", "1", &AttestedRow::quantity, "what was read back"),
        column("asked", "1", &AttestedRow::requested, "as the scene says"),
        column("handed over", "1", &AttestedRow::mapped, "as it was handed to the engine"),
        column("read back", "1", &AttestedRow::read_back, "as the engine has it"),
        column("parity", "1", &AttestedRow::parity, "whether both are the same");
  };
};

}  // namespace crosscheck
