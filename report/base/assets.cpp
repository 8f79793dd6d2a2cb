// Assets are read from the source tree that the program was built from.
#include "report/base/assets.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace crosscheck {

std::string asset(const std::string& name) {
  std::ifstream in(std::string(CROSSCHECK_REPORT) + "/" + name, std::ios::binary);
  std::stringstream text;
  if (!in || !(text << in.rdbuf()))
    throw std::runtime_error("cannot read " + std::string(CROSSCHECK_REPORT) + "/" + name);
  return text.str();
}

}  // namespace crosscheck
