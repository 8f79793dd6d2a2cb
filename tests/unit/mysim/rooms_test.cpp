// Dependencies of the top-level folders (rooms): no file or test of a room includes headers of a room above it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "mysim/base/files.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> rooms = {"mysim", "reference", "experiments", "report"};

/// Headers of higher rooms or their tests that a text of a room includes.
std::vector<std::string> headers_from_above(const std::string& text, std::string_view room) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  const auto own = std::find(rooms.begin(), rooms.end(), room);
  for (std::string line; std::getline(lines, line);)
    for (auto above = own + 1; above < rooms.end(); ++above)
      for (const char* folder : {"", "tests/unit/"})
        if (line.starts_with("#include \"" + (folder + std::string(*above)) + "/")) found.push_back(line.substr(9));
  return found;
}

TEST(Rooms, HeadersFromAboveAreSeen) {
  const std::string text =
      "#include <report/a.h>\n#include \"mysim/types.h\"\n#include \"reference/method.h\"\n"
      "#include \"tests/unit/experiments/helpers.h\"\n#include \"tests/unit/helpers.h\"\n";
  using Found = std::vector<std::string>;
  EXPECT_EQ(headers_from_above(text, "mysim"),
            (Found{"\"reference/method.h\"", "\"tests/unit/experiments/helpers.h\""}));
  EXPECT_EQ(headers_from_above(text, "reference"), Found{"\"tests/unit/experiments/helpers.h\""});
  EXPECT_EQ(headers_from_above(text, "experiments"), Found{});
}

TEST(Rooms, NoneIncludesHeadersFromAbove) {
  const fs::path source = CROSSCHECK_SOURCE;
  for (const std::string_view room : rooms)
    for (const fs::path& folder : {source / room, source / "tests/unit" / room}) {
      int files = 0;
      for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string end = entry.path().extension();
        if (end != ".h" && end != ".cpp") continue;
        ++files;
        for (const std::string& header : headers_from_above(read_file(entry.path(), "a source"), room))
          ADD_FAILURE() << entry.path().string() << " includes " << header;
      }
      EXPECT_GE(files, 10) << folder;
    }
}

/// Apart from mysim, the grader uses only the protocol's header for engines.
TEST(Rooms, TheGraderIncludesMysimOnly) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(CROSSCHECK_SOURCE) / "tests/coursework")) {
    const std::string end = entry.path().extension();
    if (end != ".h" && end != ".cpp") continue;
    ++files;
    for (const std::string& header : headers_from_above(read_file(entry.path(), "a source"), "mysim"))
      if (header != "\"reference/protocol/crosscheck_engine.h\"")
        ADD_FAILURE() << entry.path().string() << " includes " << header;
  }
  EXPECT_GE(files, 100);
}

}  // namespace
}  // namespace crosscheck
