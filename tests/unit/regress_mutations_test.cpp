// The list of wrong changes to mysim, and how it is read.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "experiments/regress/mutations.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/temporary_folder.h"

namespace crosscheck {
namespace {

TEST(Mutations, EachStandsOnceInItsFile) {
  const std::filesystem::path source = CROSSCHECK_SOURCE;
  const auto all = read_mutations(source / "tests/mutants/mutations.txt");
  EXPECT_GE(all.size(), 25u);
  std::set<std::string> names;
  for (const Mutation& m : all) {
    SCOPED_TRACE(m.name);
    EXPECT_TRUE(names.insert(m.name).second);
    std::ifstream in(source / "mysim" / m.file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const size_t at = text.find(m.right);
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(text.find(m.right, at + 1), std::string::npos);
  }
}

TEST(Mutations, BadFilesAreNamed) {
  const TemporaryFolder folder("mutations");
  const auto says = [&](const std::string& text) -> std::string {
    write_file(folder.path / "list.txt", text);
    try {
      read_mutations(folder.path / "list.txt");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(says("== a\nfile: b\nwhat: c\n").find("list.txt:3: expected file:, cause:, right: or wrong:"),
            std::string::npos);
  EXPECT_NE(says("== a\nfile: b\nright:\nc\nwrong:\nc\n")
                .find("a: expected a file, and a right and a wrong text that differ"),
            std::string::npos);
  EXPECT_EQ(says("== a\nfile: b\nright:\nc\nwrong:\nd\n"), "");
  EXPECT_THROW(read_mutations(folder.path / "none.txt"), InputError);
}

}  // namespace
}  // namespace crosscheck
