// Whole programs: how large they may be, and names that no folder could hold beside each other.
#include <gtest/gtest.h>

#include <algorithm>

#include "mysim/files.h"
#include "mysim/temporary_folder.h"
#include "tests/coursework/classic/build.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {
namespace {
namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

TEST(Whole, MoreFilesThanAProgramHasAreRefused) {
  const TemporaryFolder here("test");
  for (std::size_t i = 0; i < most_program_files; ++i)
    write_file(here.path / ("f" + std::to_string(i) + ".h"), "int x;");
  write_file(here.path / "notes.txt", "no C++ file counts for nothing");
  EXPECT_EQ(read_submission(here.path, {}).files.size(), most_program_files);
  write_file(here.path / "one_more.cpp", "");
  const Submission refused = read_submission(here.path, {});
  EXPECT_TRUE(refused.files.empty());
  ASSERT_EQ(refused.remarks.size(), 1u);
  EXPECT_EQ(refused.remarks.front().key, "program.entries");
}

TEST(Whole, ALargerOneThanAProgramIsIsRefused) {
  const TemporaryFolder here("test");
  for (int i = 0; i < 4; ++i) write_file(here.path / ("f" + std::to_string(i) + ".h"), std::string(largest_file, ' '));
  EXPECT_EQ(read_submission(here.path, {}).files.size(), 4u);
  write_file(here.path / "more.h", " ");
  const Submission refused = read_submission(here.path, {});
  EXPECT_TRUE(refused.files.empty());
  ASSERT_EQ(refused.remarks.size(), 1u);
  EXPECT_EQ(refused.remarks.front().key, "program.size");
  // where files are wanted by name the others count for nothing
  EXPECT_EQ(read_submission(here.path, {"more.h"}).files.size(), 1u);
}

/// Keys of what is said of the files, in order.
std::vector<std::string> notes_on(const classic::Files& files) {
  const TemporaryFolder here("test");
  const classic::Plan plan(files, here.path / "tree", folder_of_coursework());
  std::vector<std::string> keys;
  for (const Remark& note : plan.notes()) keys.push_back(note.key);
  return keys;
}

TEST(Whole, NamesThatCannotBeWrittenAreLeftOut) {
  using Keys = std::vector<std::string>;
  EXPECT_EQ(notes_on({{"a.h", "class ClothSystem {"}, {"b.cpp", ""}}), Keys());
  EXPECT_EQ(notes_on({{"a.h", ""}, {"old/a.h", ""}}), Keys{"whole.twice"});
  EXPECT_EQ(notes_on({{"a.h", ""}, {"a.h/b.h", ""}, {"a.h/c/d.h", ""}}), (Keys{"whole.below", "whole.below"}));
  EXPECT_EQ(notes_on({{std::string(300, 'x') + ".h", ""}, {std::string(300, 'x') + "/b.h", ""}}),
            (Keys{"whole.name", "whole.name"}));
  std::string deep;
  for (int i = 0; i < 2000; ++i) deep += "d/";
  EXPECT_EQ(notes_on({{deep + "a.h", ""}}), Keys{"whole.name"});
}

TEST(Whole, IncludesThatCannotBeLedAnywhereAreSaid) {
  using Keys = std::vector<std::string>;
  const std::string odd = "#include \"A.h\"\n#include \"A.h/b.h\"\n#include \"x/B.h/a.h\"\n#include \"x/B.h\"\n";
  EXPECT_EQ(notes_on({{"a.h", ""}, {"b.h", odd}}), (Keys{"whole.include", "whole.include"}));
  const std::string long_name(4000, 'x');
  for (const std::string& name : {long_name + ".h", long_name + "/a.h", std::string("a\0.h/a.h", 8),
                                  std::string("a.h/"), std::string("/"), std::string("..")})
    EXPECT_EQ(notes_on({{"a.h", ""}, {"b.h", "#include \"" + name + "\"\n"}}), Keys()) << name;
}

}  // namespace
}  // namespace coursework
