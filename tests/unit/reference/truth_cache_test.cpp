// Cache of reference solutions: restored bit for bit, for the same program and scene only. Damage and a full disk are
// harmless.

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "reference/truth/cache.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
namespace fs = std::filesystem;

class Cache : public ::testing::Test {
 protected:
  Cache() : folder(fs::temp_directory_path() / fmt::format("crosscheck-cache-{}", getpid())), cache(folder, "program") {
    fs::remove_all(folder);
  }
  ~Cache() override { fs::remove_all(folder); }

  /// Looks up a reference solution and counts computations.
  std::optional<Truth> look_up(const TruthCache& of, const Scene& requested, const crosscheck::Run& at) {
    return of.find_or_compute(requested, at, [&]() -> std::optional<Truth> {
      ++computed;
      if (!known) return std::nullopt;
      Truth truth{
          Tier::converged, "by two routes", run_and_record("rk4", requested, at).trajectory, 1e-9, {1e-12, 1e-9}};
      truth.under_contact_rule = true;
      truth.until = 0.25;
      truth.contact = {0, 2}, truth.contact_bars = {0, 1e-3};
      return truth;
    });
  }

  fs::path folder;
  TruthCache cache;
  Scene scene = shipped_scene("pendulum");
  crosscheck::Run run{1e-2, 0.1, 4};
  int computed = 0;
  bool known = true;
};

TEST_F(Cache, ReturnsTheSameBitsWithoutComputingAgain) {
  const auto first = look_up(cache, scene, run), again = look_up(cache, scene, run);
  EXPECT_EQ(computed, 1);
  ASSERT_TRUE(again);
  EXPECT_TRUE(identical(first->trajectory, again->trajectory));
  EXPECT_EQ(again->tier, Tier::converged);
  EXPECT_EQ(again->how, "by two routes");
  EXPECT_EQ(again->error_bar, 1e-9);
  EXPECT_EQ(again->error_bars, (std::vector{1e-12, 1e-9}));
  EXPECT_TRUE(again->under_contact_rule);
  EXPECT_EQ(again->until, 0.25);
  EXPECT_EQ(again->contact, (std::vector{0., 2.}));
  EXPECT_EQ(again->contact_bars, (std::vector{0, 1e-3}));
  // one file and its lock, and no partial file
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
  EXPECT_TRUE(fs::exists(cache.file_of(scene, run).string() + ".lock"));
}

TEST_F(Cache, OfSeveralProcessesOneComputesAndTheOthersWait) {
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i)
    if (children.push_back(fork()); children.back() == 0) {
      cache.find_or_compute(scene, run, [&]() -> std::optional<Truth> {
        std::ofstream(folder / "computed", std::ios::app) << "x";
        usleep(50000);
        return std::nullopt;
      });
      _exit(0);
    }
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  std::ifstream in(folder / "computed");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "x");
}

TEST_F(Cache, RemembersThatNothingIsKnown) {
  known = false;
  EXPECT_FALSE(look_up(cache, scene, run));
  EXPECT_FALSE(look_up(cache, scene, run));
  EXPECT_EQ(computed, 1);
}

TEST_F(Cache, AnotherSceneOrProgramIsAnotherTruth) {
  look_up(cache, scene, run);
  Scene heavier = scene, finer = scene;
  heavier.model.particles.mass[1] *= 1 + 1e-15;  // changes a few bits; the file's hash stays
  finer.step /= 2;
  look_up(cache, heavier, run);
  look_up(cache, finer, run);
  look_up(cache, scene, {1e-2, 0.2, 4});
  look_up(cache, scene, {1e-2, 0.1, 5});
  look_up(TruthCache(folder, "another program"), scene, run);
  EXPECT_EQ(computed, 6);
  // the step of the methods to compare does not matter
  look_up(cache, scene, {1e-4, 0.1, 4});
  EXPECT_EQ(computed, 6);
}

TEST_F(Cache, DamagedFilesAreComputedAgain) {
  const auto first = look_up(cache, scene, run);
  const fs::path file = cache.file_of(scene, run);
  std::ifstream in(file, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;
  int expected = 1;
  for (const std::string& damaged :
       {std::string(), whole.substr(0, 7), whole.substr(0, whole.size() - 1), whole + "x", flipped}) {
    std::ofstream(file, std::ios::binary) << damaged;
    const auto again = look_up(cache, scene, run);
    EXPECT_EQ(computed, ++expected);
    EXPECT_TRUE(identical(first->trajectory, again->trajectory));
    look_up(cache, scene, run);
    EXPECT_EQ(computed, expected);  // intact again
  }
}

TEST_F(Cache, AFolderThatCannotBeWrittenToDoesNoHarm) {
  std::ofstream(folder) << "a file where the folder should be";
  EXPECT_TRUE(look_up(cache, scene, run));
  EXPECT_TRUE(look_up(cache, scene, run));
  EXPECT_EQ(computed, 2);
}

TEST_F(Cache, OldTruthsGoAndOtherFilesStay) {
  look_up(cache, scene, run);
  const fs::path old = cache.file_of(scene, run), other = folder / "notes.txt";
  std::ofstream(other) << "mine";
  for (const fs::path& file : {old, other})
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(31 * 24));
  look_up(cache, scene, {1e-2, 0.2, 4});
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(other));
}

TEST(BuildId, IsThatOfTheProgramAndStaysTheSame) {
  EXPECT_EQ(build_id().size(), 40u);  // SHA-1
  EXPECT_EQ(build_id(), build_id());
  EXPECT_EQ(build_id().find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(CacheFolder, FollowsTheEnvironment) {
  const auto folder_with = [](const char* own, const char* xdg, const char* home) -> std::string {
    const std::pair<const char*, const char*> wanted[] = {
        {"CROSSCHECK_CACHE", own}, {"XDG_CACHE_HOME", xdg}, {"HOME", home}};
    std::vector<std::pair<const char*, std::optional<std::string>>> before;
    for (const auto& [name, value] : wanted) {
      const char* was = std::getenv(name);
      before.emplace_back(name, was ? std::optional<std::string>(was) : std::nullopt);
      value ? setenv(name, value, 1) : unsetenv(name);
    }
    const auto cache = TruthCache::from_environment();
    for (const auto& [name, value] : before) value ? setenv(name, value->c_str(), 1) : unsetenv(name);
    return cache ? cache->file_of(shipped_scene("circle"), {1, 1, 1}).parent_path().string() : "none";
  };
  EXPECT_EQ(folder_with("/a", "/b", "/c"), "/a");
  EXPECT_EQ(folder_with("", "/b", "/c"), "/b/crosscheck");
  EXPECT_EQ(folder_with(nullptr, nullptr, "/c"), "/c/.cache/crosscheck");
  EXPECT_EQ(folder_with(nullptr, nullptr, nullptr), "none");
}

}  // namespace
}  // namespace crosscheck
