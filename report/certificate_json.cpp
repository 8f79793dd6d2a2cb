// One object with one entry per quantity.
#include "report/certificate_json.h"

#include <nlohmann/json.hpp>

namespace crosscheck {

std::string certificate_json(const Certificate& certificate) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const CertificateRow& r : certificate.rows)
    rows.push_back({{"quantity", r.quantity},
                    {"asked", r.asked},
                    {"mapped", r.mapped},
                    {"read_back", r.read_back},
                    {"verdict", name_of(r.parity)}});
  const nlohmann::ordered_json json{{"scene", certificate.scene},
                                    {"method", certificate.method},
                                    {"verdict", certificate.mismatch() ? "mismatch" : "match"},
                                    {"rows", rows}};
  return json.dump(1) + "\n";
}

}  // namespace crosscheck
