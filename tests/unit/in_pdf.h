// What stands in a PDF as cairo writes it: the size of its page and of its letters.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <regex>
#include <set>
#include <string>

namespace crosscheck::testing_tools {

/// Of a PDF's first page, points.
inline std::pair<double, double> page_of(const std::string& pdf) {
  std::smatch found;
  EXPECT_TRUE(std::regex_search(pdf, found, std::regex("/MediaBox \\[ ?[0-9.]+ [0-9.]+ ([0-9.]+) ([0-9.]+)")));
  return {std::stod(found[1]), std::stod(found[2])};
}

/// The heights of all letters on its pages, points.
inline std::set<double> letters_of(const std::string& pdf) {
  std::set<double> sizes;
  const std::string begin = "stream\n";
  for (size_t at = pdf.find(begin); at != std::string::npos; at = pdf.find(begin, at + 1)) {
    std::string text(1 << 24, ' ');
    uLongf size = text.size();
    const size_t from = at + begin.size();
    uLong rest = pdf.size() - from;
    if (uncompress2(reinterpret_cast<Bytef*>(text.data()), &size, reinterpret_cast<const Bytef*>(pdf.data() + from),
                    &rest) != Z_OK)
      continue;
    text.resize(size);
    if (text.find(" Tm") == std::string::npos) continue;
    const std::regex matrix("([-0-9.]+) ([-0-9.]+) [-0-9.]+ [-0-9.]+ [-0-9.]+ [-0-9.]+ Tm");
    for (std::sregex_iterator i(text.begin(), text.end(), matrix), end; i != end; ++i)
      sizes.insert(std::hypot(std::stod((*i)[1]), std::stod((*i)[2])));
  }
  return sizes;
}

}  // namespace crosscheck::testing_tools
