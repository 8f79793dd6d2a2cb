// Assets are read from the source tree that the program was built from.
#include "report/base/assets.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace crosscheck {

std::string base64(const std::string& bytes) {
  static constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = std::min<size_t>(3, bytes.size() - i);
    unsigned word = 0;
    for (size_t j = 0; j < 3; ++j) word = word << 8 | (j < left ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (size_t j = 0; j < 4; ++j) out += j <= left ? alphabet[word >> (18 - 6 * j) & 63] : '=';
  }
  return out;
}

std::string asset(const std::string& name) {
  std::ifstream in(std::string(CROSSCHECK_REPORT) + "/" + name, std::ios::binary);
  std::stringstream text;
  if (!in || !(text << in.rdbuf()))
    throw std::runtime_error("cannot read " + std::string(CROSSCHECK_REPORT) + "/" + name);
  return text.str();
}

}  // namespace crosscheck
