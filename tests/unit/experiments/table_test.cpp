// Tables and files: CSV quoting, numbers that read back to the same bits, files written whole or not at all.

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "experiments/tables/table.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;
using namespace testing_tools;

/// An empty folder of its own, gone at the end.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(fs::temp_directory_path() / fmt::format("crosscheck-{}-{}", name, getpid())) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(Csv, HasProvenanceHeaderWithUnitsAndQuotesWhereNeeded) {
  Table t{"probe", {{"scene", "1"}, {"error", "m"}, {"steps", "1"}, {"note, long", "1"}}, {}};
  t.add({std::string("a,b"), 0.1, 7L, std::string("plain")});
  t.add({std::string("say \"so\""), -2.0, -3L, {}});
  t.add({std::string("two\nlines"), 1e300, 0L, std::string()});
  EXPECT_EQ(
      csv(t, {{"command", "test"}, {"seed", "1"}}),
      "# command: test\n# seed: 1\nscene [1],error [m],steps [1],\"note, long [1]\"\n"
      "\"a,b\",0.10000000000000001,7,plain\n\"say \"\"so\"\"\",-2,-3,\n\"two\nlines\",1.0000000000000001e+300,0,\n");
}

TEST(Csv, NumbersReadBackToTheSameBits) {
  Random random(1);
  std::vector<double> numbers = {0, -0.0, 1.0 / 3, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 1e22, 0.1};
  for (int i = 0; i < 2000; ++i)
    numbers.push_back(std::ldexp(random.between(-1, 1), static_cast<int>(random.between(-1000, 1000))));
  for (const double number : numbers) {
    const double back = std::strtod(exact_text(number).c_str(), nullptr);
    EXPECT_EQ(std::memcmp(&back, &number, sizeof back), 0) << exact_text(number);
  }
  EXPECT_EQ(exact_text(NAN), "nan");
  EXPECT_EQ(exact_text(-INFINITY), "-inf");
}

TEST(Csv, ColumnsAreFoundByName) {
  Table t{"probe", {{"a", "1"}, {"b", "m"}}, {}};
  t.add({1.0, 2.0});
  EXPECT_EQ(t.column("b"), 1);
  EXPECT_EQ(std::get<double>(t.at(0, "b")), 2.0);
  try {
    t.column("c");
    ADD_FAILURE();
  } catch (const std::out_of_range& e) {
    EXPECT_TRUE(contains(e.what(), "table probe has no column c"));
  }
}

TEST(Files, AreWrittenWholeIntoNewFoldersAndOverOldOnes) {
  const Folder folder("files");
  const fs::path file = folder.path() / "deep" / "er" / "text.csv";
  const std::string bytes = std::string("zero\0byte\r\n", 11) + "end";
  for (const std::string& text : {std::string("first"), bytes, std::string()}) {
    write_file(file, text);
    EXPECT_EQ(content_of(file), text);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1) << "a temporary file was left";
  write_csv({"probe", {{"a", "1"}}, {}}, {}, folder.path());
  EXPECT_EQ(content_of(folder.path() / "probe.csv"), "a [1]\n");
}

TEST(Files, UnwritablePathsAreNamedAndNothingIsLeft) {
  const Folder folder("unwritable");
  write_file(folder.path() / "file", "x");
  fs::create_directories(folder.path() / "taken" / "inside");
  // below a file, in place of a folder that is not empty, in a file system that takes no files: root is refused as well
  for (const fs::path& file :
       {folder.path() / "file" / "below.csv", folder.path() / "taken", fs::path("/proc/crosscheck.csv")}) {
    SCOPED_TRACE(file);
    try {
      write_file(file, "text");
      ADD_FAILURE() << "written";
    } catch (const InputError& e) {
      EXPECT_TRUE(contains(e.what(), file.string() + ": cannot be written"));
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_EQ(content_of(folder.path() / "file"), "x");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2) << "a temporary file was left";
  EXPECT_THROW(require_writable(folder.path() / "file"), InputError);
  EXPECT_THROW(require_writable("/proc/crosscheck"), InputError);
  try {
    require_writable(folder.path() / "file" / "x");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_TRUE(contains(e.what(), (folder.path() / "file" / "x").string()));
  }
  EXPECT_NO_THROW(require_writable(folder.path() / "new" / "folder"));
  EXPECT_TRUE(fs::is_directory(folder.path() / "new" / "folder"));
}

TEST(Files, NamesKeepSafeCharactersOnly) {
  EXPECT_EQ(file_name_of("bullet/pbd+n=10"), "bullet-pbd+n=10");
  EXPECT_EQ(file_name_of("a b:c\\d*e?f\"g<h>i|j,k"), "a-b-c-d-e-f-g-h-i-j-k");
  EXPECT_EQ(file_name_of("AZaz09._=+-"), "AZaz09._=+-");
  EXPECT_EQ(file_name_of("caf\xc3\xa9"), "caf--");  // two bytes of UTF-8
  EXPECT_EQ(file_name_of(""), "");
}

}  // namespace
}  // namespace crosscheck
