// Names and paths that come from data.
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/base/text.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;

/// The UTF-8 bytes of a code point.
std::string utf8(unsigned c) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) return {static_cast<char>(c)};
  if (c < 0x800) return {static_cast<char>(0xc0 | c >> 6), tail(0)};
  if (c < 0x10000) return {static_cast<char>(0xe0 | c >> 12), tail(6), tail(0)};
  return {static_cast<char>(0xf0 | c >> 18), tail(12), tail(6), tail(0)};
}

TEST(Names, OfAllScriptsAreAcceptedUpTo200Bytes) {
  for (const char* name : {"cloth", "a b", "布料", "Ткань", "Größe-2", "x+n=10", "\xf0\x9f\x8e\x89", "a..b", "it's"})
    EXPECT_TRUE(is_name(name)) << name;
  EXPECT_TRUE(is_name(std::string(200, 'a')));
  EXPECT_FALSE(is_name(std::string(201, 'a')));
}

TEST(Names, WithControlHiddenOrBrokenCharactersAreRefused) {
  for (unsigned c = 0; c < 32; ++c) EXPECT_FALSE(is_name("a" + std::string(1, static_cast<char>(c)) + "b")) << c;
  for (const unsigned c : {0x7fu, 0x80u, 0x9bu, 0x9fu, 0xadu, 0x61cu, 0x200bu, 0x200du, 0x200eu, 0x200fu, 0x2028u,
                           0x202au, 0x202eu, 0x2066u, 0x2069u, 0xfeffu, 0xe0020u}) {
    EXPECT_FALSE(is_name("a" + utf8(c) + "b")) << std::hex << c;
    EXPECT_EQ(file_name_of("a" + utf8(c) + "b").find(utf8(c)), std::string::npos) << std::hex << c;
  }
  for (const char* name : {"", "-a", ".a", "..", "a/b", "/", "\xff", "a\xc3", "\xed\xa0\x80", "\xc0\xaf"})
    EXPECT_FALSE(is_name(name)) << shell_quote(name);
  EXPECT_THROW(require_name("a\nb", "x.json: name"), InputError);
}

TEST(Names, FileNamesMadeOfTwoNamesFitEveryFileSystemAndStayApart) {
  const TemporaryFolder here("test");
  std::string scene, method;  // characters of one to four bytes
  for (const char* sign : {"a", "\xc3\xa9", "\xe5\xb8\x83", "\xf0\x9f\xa7\xb5"})
    for (int i = 0; i < 20; ++i) scene += sign, method = sign + method;
  ASSERT_EQ(scene.size(), 200u);
  const auto longest_prefix = [](const std::string& text, size_t bytes) {
    while (!is_printable(text.substr(0, bytes))) --bytes;
    return text.substr(0, bytes);
  };
  std::set<std::string> pairs, files;
  for (size_t i = 1; i <= 200; ++i)
    for (size_t j = 1; j <= 200; j += i == 200 || i % 20 == 1 ? 1 : 29) {
      const std::string pair = fmt::format("certificate-{}x-{}y", longest_prefix(scene, i), longest_prefix(method, j));
      const std::string file = file_name_of(pair);
      EXPECT_LE(file.size(), longest_derived_name);
      EXPECT_TRUE(is_name(file, longest_derived_name)) << file;
      EXPECT_EQ(file_name_of(file), file);
      EXPECT_TRUE(file.starts_with(longest_prefix(pair, std::min<size_t>(pair.size(), 200))));
      pairs.insert(pair), files.insert(file);
    }
  EXPECT_EQ(files.size(), pairs.size());
  // the longest suffix is that of a kept file that the user changed
  const std::string last = file_name_of(std::string(412, 'b')) + ".json.yours";
  write_file(here.path / last, "whole");
  EXPECT_LE(last.size() + std::string(".4194304.part").size() + 1, 255u);
  for (size_t bytes = 1; bytes <= 200; ++bytes)
    EXPECT_EQ(file_name_of(longest_prefix(scene, bytes)), longest_prefix(scene, bytes))
        << "a short name must not change";
}

TEST(Names, StandardStreamsPrintTextOnlyAndSplitCharactersStayWhole) {
  const TemporaryFolder here("test");
  const std::string file = (here.path / "out").string();
  const pid_t child = fork();
  if (child == 0) {
    if (!std::freopen(file.c_str(), "w", stdout) || dup2(fileno(stdout), STDOUT_FILENO) < 0) _exit(1);
    print_only_text();
    for (const char* part : {"a\x1b[2J", "b\xe5", "\xb8", "\x83\xe6\x96", "\x99\n"}) {
      std::fputs(part, stdout);
      std::fflush(stdout);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_file(file, "text"), "a?[2Jb布料\n");
}

TEST(Names, PrintedTextHoldsNoEscapes) {
  EXPECT_EQ(printable("a\x1b]0;t\x07\xc2\x9b"
                      "31m\r\b\n\tb\xff 布\xe2\x80\xae"),
            "a?]0;t??31m??\n\tb? 布?");
}

TEST(Names, CellsOfScenesAndMethodsAreOneLine) {
  EXPECT_NO_THROW(require_cell("note", "two\nlines"));
  for (const char* column : {"scene", "method", "other_method"}) EXPECT_THROW(require_cell(column, "a\nb"), InputError);
  EXPECT_THROW(require_cell("note", "\x1b[2J"), InputError);
}

TEST(Names, FilesWithoutAnEndAreRefusedAndNotRead) {
  const TemporaryFolder here("test");
  const fs::path file = here.path / "file";
  for (const std::string& text : {std::string(), std::string("a\0b", 3), std::string(100000, 'x')}) {
    write_file(file, text);
    EXPECT_EQ(try_read_file(file), text);
  }
  EXPECT_FALSE(try_read_file(here.path));
  EXPECT_FALSE(try_read_file(here.path / "none"));
  std::error_code full;
  fs::resize_file(file, std::uintmax_t{1} << 42, full);  // a sparse file, which occupies no space
  if (!full) {
    EXPECT_THROW(try_read_file(file), InputError);
  }
}

class PathsInside : public testing_tools::InFolder {};

TEST_F(PathsInside, NeitherLeaveTheFolderNorFollowLinks) {
  write_file(folder_ / "in/data/a.csv", "1");
  fs::create_symlink("data", folder_ / "in/link");
  fs::create_symlink("a.csv", folder_ / "in/data/b.csv");
  const fs::path root = folder_ / "in";
  EXPECT_EQ(path_inside(root, "data/a.csv"), root / "data/a.csv");
  EXPECT_EQ(path_inside(root, "data/..."), root / "data/...");  // a valid file name, existing or not
  const std::string deep(300, 'a');
  for (const std::string path : {"", ".", "..", "../x", "data/../..", "/etc/passwd", "data//a.csv", "data/", "./data",
                                 "link/a.csv", "data/b.csv", "a\nb", deep.c_str()})
    EXPECT_THROW(path_inside(root, path), InputError) << path;
  std::string long_path = "a";
  while (long_path.size() <= 1024) long_path += "/a";
  EXPECT_THROW(path_inside(root, long_path), InputError);
}

TEST_F(PathsInside, FolderWithLinksOrPipesIsNotPlain) {
  write_file(folder_ / "in/data/a.csv", "1");
  EXPECT_NO_THROW(require_plain_files(folder_ / "in"));
  ASSERT_EQ(mkfifo((folder_ / "in/data/pipe").c_str(), 0600), 0);
  EXPECT_THROW(path_inside(folder_ / "in", "data/pipe"), InputError);
  EXPECT_THROW(require_plain_files(folder_ / "in"), InputError);
  fs::remove(folder_ / "in/data/pipe");
  fs::create_symlink("/etc/passwd", folder_ / "in/data/link");
  EXPECT_THROW(require_plain_files(folder_ / "in"), InputError);
}

}  // namespace
}  // namespace crosscheck
