// Writes .npy by its published format: magic, version, padded header, data.
#include "reference/npy.h"

#include <fmt/format.h>

#include <bit>

namespace crosscheck {

static_assert(std::endian::native == std::endian::little, "the data are written as they lie in memory");

std::string npy_bytes(const std::vector<Points>& frames) {
  const long particles = frames.empty() ? 0 : static_cast<long>(frames.front().cols());
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}, 3), }}", frames.size(), particles);
  // magic (6), version (2), length (2), header and newline fill a multiple of 64 bytes
  header.resize((10 + header.size() + 1 + 63) / 64 * 64 - 10 - 1, ' ');
  header += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(header.size() & 0xff);
  out += static_cast<char>(header.size() >> 8);
  out += header;
  // a 3 x n column-major frame is n x 3 in C order
  for (const Points& x : frames) out.append(reinterpret_cast<const char*>(x.data()), sizeof(double) * x.size());
  return out;
}

}  // namespace crosscheck
