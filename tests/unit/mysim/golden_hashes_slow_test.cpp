// Rules with a fixed summation order give identical bits on every instruction set and processor.

#include <array>

#include "mysim/simd/instruction_sets.h"
#include "tests/unit/golden_hashes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Hash of the state after 1000 steps, or the time of a blow-up. Empty if the rule does not support the scene.
std::string hash_of(const Scene& scene, const Stepper& rule) {
  const Run run{.step = scene.step,
                .duration = golden_duration(scene),
                .samples = static_cast<int>(std::round(golden_duration(scene) * scene.samples / scene.duration)),
                .timed = false};
  MotionBoundsCache cache;
  DivergenceMonitor monitor(scene, run, [&](const Scene& of, const Run&) { return cache(of, default_run(of)); });
  try {
    const auto world = make_world(rule, ContactRule::coulomb, scene, run, monitor);
    RunLoop loop(*world, run, monitor);
    for (int i = 0; i < golden_steps && loop.step(); ++i) {
    }
    return fingerprint(world->state(loop.time()));
  } catch (const Unsupported&) {
    return "";
  }
}

/// With CROSSCHECK_WRITE_GOLDEN_HASHES=1, writes the table first.
TEST(GoldenHashes, AreThoseOfTheTable) {
  GoldenHashes computed;
  for (const std::string& name : shipped_scene_names()) {
    const Scene scene = shipped_scene(name);
    for (const Stepper& rule : steppers()) {
      if (!has_same_bits_everywhere(rule)) continue;
      for (const simd::InstructionSet isa : simd::supported_instruction_sets()) {
        setenv("CROSSCHECK_INSTRUCTIONS", std::string(name_of(isa)).c_str(), 1);
        const std::string hash = hash_of(scene, rule);
        if (hash.empty()) continue;
        const auto [row, is_first] = computed.try_emplace({name, std::string(rule.name)}, hash);
        EXPECT_EQ(hash, row->second) << name << ", " << rule.name << ", " << name_of(isa);
      }
    }
  }
  unsetenv("CROSSCHECK_INSTRUCTIONS");
  if (std::getenv("CROSSCHECK_WRITE_GOLDEN_HASHES")) {
    std::string text =
        "# hashes of the state after 1000 steps; written by unit_mysim_slow with CROSSCHECK_WRITE_GOLDEN_HASHES=1\n"
        "scene,rule,hash\n";
    for (const auto& [key, hash] : computed) text += fmt::format("{},{},{}\n", key.first, key.second, hash);
    write_file(golden_hash_file(), text);
  }
  const GoldenHashes golden = golden_hashes();
  EXPECT_GT(golden.size(), 100u);
  EXPECT_EQ(computed.size(), golden.size());
  for (const auto& [key, hash] : computed) {
    const auto expected = golden.find(key);
    ASSERT_NE(expected, golden.end()) << key.first << " by " << key.second;
    EXPECT_EQ(hash, expected->second) << key.first << " by " << key.second;
  }
}

/// Three weighted means (m) of a state's coordinates, with weights of at most 1 in magnitude.
std::array<double, 3> projections(const Points& x) {
  std::array<double, 3> sums{};
  for (Eigen::Index i = 0; i < x.size(); ++i)
    for (int j = 0; j < 3; ++j)
      sums[j] += static_cast<double>((7919 * i + 104729 * j) % 2001 - 1000) / 1000 * x.reshaped()[i] /
                 static_cast<double>(x.size());
  return sums;
}

/// Runs implicit rules for 20 steps on small scenes. With CROSSCHECK_WRITE_GOLDEN_HASHES=1, writes the table first.
TEST(GoldenProjections, OfImplicitRulesAgreeWithTheTable) {
  const std::filesystem::path file = CROSSCHECK_SOURCE "/reference/baselines/implicit-projections.csv";
  std::map<std::string, std::array<double, 3>> computed;
  for (const std::string& name : shipped_scene_names()) {
    const Scene scene = shipped_scene(name);
    if (scene.model.particles.size() > 100) continue;
    for (const Stepper& rule : steppers()) {
      if (has_same_bits_everywhere(rule) || rule.adaptive || !takes(rule, scene)) continue;
      computed[fmt::format("{},{}", name, rule.name)] =
          projections(trajectory_of(rule, scene, {scene.step, 20 * scene.step, 1}).x.back());
    }
  }
  if (std::getenv("CROSSCHECK_WRITE_GOLDEN_HASHES")) {
    std::string text =
        "# weighted means of the coordinates after 20 steps; written by unit_mysim_slow with "
        "CROSSCHECK_WRITE_GOLDEN_HASHES=1\nscene,rule,first [m],second [m],third [m]\n";
    for (const auto& [key, values] : computed) text += fmt::format("{},{}\n", key, fmt::join(values, ","));
    write_file(file, text);
  }
  size_t compared = 0;
  std::istringstream lines(read_file(file, "the table of projections"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with("scene")) continue;
    const std::vector<std::string> words = split(line, ',');
    const auto found = computed.find(words.at(0) + ',' + words.at(1));
    ASSERT_NE(found, computed.end()) << line;
    // Solvers stop at a relative residual of 1e-12. The test of WebAssembly (lab_slow_test.cpp) has the same tolerance.
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(found->second[j], std::stod(words.at(2 + j)), 1e-7) << line;
    ++compared;
  }
  EXPECT_EQ(compared, computed.size());
  EXPECT_GT(compared, 20u);
}

}  // namespace
}  // namespace crosscheck
