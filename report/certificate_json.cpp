// One object with one entry per quantity.
#include "report/certificate_json.h"

#include "mysim/json.h"

namespace crosscheck {

std::string certificate_json(const Certificate& certificate) {
  Json rows = Json::list();
  for (const CertificateRow& r : certificate.rows)
    rows.push({{"quantity", r.quantity},
               {"asked", r.asked},
               {"mapped", r.mapped},
               {"read_back", r.read_back},
               {"verdict", name_of(r.parity)}});
  const Json json{{"scene", certificate.scene},
                  {"method", certificate.method},
                  {"verdict", certificate.mismatch()         ? "mismatch"
                              : certificate.fully_attested() ? "match"
                                                             : "not attested"},
                  {"summary", summary_of(certificate)},
                  {"rows", std::move(rows)}};
  return json.dump(1) + "\n";
}

}  // namespace crosscheck
