// Parity certificates as JSON.
#pragma once

#include <string>

#include "reference/certificate.h"

namespace crosscheck {

std::string certificate_json(const Certificate& certificate);

}  // namespace crosscheck
