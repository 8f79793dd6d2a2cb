// PNG files made smaller, and told how large they are in print.
#include "report/render/png_file.h"

#include "tests/unit/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
namespace fs = std::filesystem;

class PngFile : public InFolder {};

TEST_F(PngFile, PacksTightlyAndKeepsEveryPixel) {
  int smaller = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(CROSSCHECK_SOURCE) / "tests/unit/golden")) {
    if (entry.path().extension() != ".png") continue;
    SCOPED_TRACE(entry.path().string());
    const fs::path copy = folder_ / entry.path().filename();
    fs::copy_file(entry.path(), copy);
    render::set_resolution(copy, 300);
    const auto size = fs::file_size(copy);
    const std::string told = read(copy).substr(33, 21);
    render::pack_tightly(copy);
    EXPECT_LE(fs::file_size(copy), size);
    smaller += fs::file_size(copy) < size;
    EXPECT_EQ(render::read_png(copy).rgb, render::read_png(entry.path()).rgb);
    EXPECT_EQ(read(copy).substr(33, 21), told) << "what else is in it stays";
    const std::string once = read(copy);
    render::pack_tightly(copy);
    EXPECT_EQ(read(copy), once);
  }
  EXPECT_GT(smaller, 0);
}

TEST_F(PngFile, WhatIsNoneIsNamed) {
  const fs::path file = write("none.png", "\x89PNG, but not further than that: no chunk of it is whole");
  try {
    render::pack_tightly(file);
    FAIL() << "nothing is said";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), "cannot read " + file.string());
  }
}

}  // namespace
}  // namespace crosscheck
