// The table of engines with shipped adapters.

#include <gtest/gtest.h>

#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "reference/engines/engines.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

TEST(OutsideEngines, HaveTheFilesTheyAreBuiltFrom) {
  const auto reference = data_folder() / "reference";
  std::set<std::string> names;
  for (const OutsideEngine& e : outside_engines()) {
    SCOPED_TRACE(e.name);
    EXPECT_TRUE(names.insert(e.name).second);
    for (const std::string* text : {&e.title, &e.licence, &e.precision, &e.rule}) EXPECT_FALSE(text->empty());
    EXPECT_TRUE(e.is_native() || e.built == "WebAssembly" || e.built == "JavaScript") << e.built;
    EXPECT_FALSE(e.source.empty() && e.module.empty() && e.cmake.empty());
    EXPECT_EQ(e.source.empty(), e.package.empty() || e.header.empty());
    EXPECT_EQ(e.module.empty(), e.npm.empty());
    EXPECT_EQ(e.cmake.empty(), e.prefix.empty() || e.prefix_file.empty());
    for (const std::string& file : {e.source, e.module})
      EXPECT_TRUE(file.empty() || std::filesystem::exists(reference / "engines" / file)) << file;
    if (!e.cmake.empty()) {
      EXPECT_TRUE(std::filesystem::exists(data_folder() / e.cmake / "CMakeLists.txt"));
    }
    if (!e.npm.empty()) {
      EXPECT_TRUE(std::filesystem::exists(reference / "engines/npm" / e.name / "package-lock.json"));
    }
  }
}

TEST(OutsideEngines, AreKnownByTheirKeptProgram) {
  const std::string ode = "exec:" + kept_program("ode").string();
  ASSERT_TRUE(kept_engine_of(ode + "+springs=dball"));
  EXPECT_EQ(kept_engine_of(ode)->name, "ode");
  EXPECT_EQ(without_folders(ode + "+springs=dball"), "ode+springs=dball");
  for (const std::string other : {"exec:./ode", "mysim/leapfrog"}) {
    EXPECT_FALSE(kept_engine_of(other));
    EXPECT_EQ(without_folders(other), other);
  }
  EXPECT_FALSE(kept_engine_of(ode + "2"));
}

}  // namespace
}  // namespace crosscheck
