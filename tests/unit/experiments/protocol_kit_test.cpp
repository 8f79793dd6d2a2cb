// The conformance kit reports nothing missing for a complete adapter, and recognises programs that are not adapters.

#include "tests/unit/experiments/protocol_kit.h"

#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST_F(ProtocolKit, TheShippedExampleLacksNothing) {
  const ConformanceReport report = try_adapter("exec:" CROSSCHECK_EXAMPLE);
  for (const ConformanceLine& line : report.lines)
    EXPECT_NE(line.state, Conformance::lacks) << line.scene << ", " << line.topic << ": " << line.told;
  EXPECT_TRUE(report.complete());
  std::set<std::string> refused, ok;
  for (const ConformanceLine& line : report.lines)
    (line.state == Conformance::refuses ? refused : ok)
        .insert(line.state == Conformance::refuses ? line.scene + ", " + line.topic + ": " + line.told : line.topic);
  EXPECT_EQ(refused, (std::set<std::string>{"damped-spring, starts and ends: this engine has no dashpots",
                                            "ball, starts and ends: this engine has no sphere",
                                            "slope, starts and ends: this engine has no plane",
                                            "rod, starts and ends: this engine has no constraints",
                                            "circle, starts and ends: this engine has no rotation",
                                            "gusts, starts and ends: this engine has no wind",
                                            "fall, unknown term: this engine has no a-term-of-a-later-version"}));
  for (const char* topic :
       {"trajectory", "first frame", "sample times", "velocities", "speeds", "run.json", "run.json: cpu_seconds",
        "run.json: steps", "run.json: force_evaluations", "verdict", "pins led", "same call twice", "acts: gravity",
        "acts: motion of the pins", "certificate: start positions", "certificate: spring law and stiffness",
        "unknown key", "unknown option"})
    EXPECT_TRUE(ok.contains(topic)) << topic;
}

TEST_F(ProtocolKit, ProgramsThatAreNoAdaptersAreTold) {
  const struct {
    std::string text, options;
    std::set<std::string> required;
    std::string told;
  } cases[] = {{"echo no licence >&2\nexit 7\n", "", {"starts and ends"}, "it ended with exit status 7 (no licence)"},
               {"echo nothing works >&2\nexit 3\n", "", {"scenes"}, "no scene of the kit is supported"},
               {"sleep 60\n", "+timeout=0.2", {"starts and ends", "scenes"}, "it did not end within 0.2 s"},
               {"exit 0\n", "", {"trajectory", "unknown term"}, "trajectory.npy is missing"}};
  for (const auto& [text, options, required, told] : cases) {
    SCOPED_TRACE(text);
    const ConformanceReport report = try_adapter("exec:" + script("adapter", text) + options);
    EXPECT_FALSE(report.complete());
    EXPECT_EQ(lacking(report, true), required);
    bool found = false;
    for (const ConformanceLine& line : report.lines) found |= line.told.find(told) != std::string::npos;
    EXPECT_TRUE(found) << told;
  }
  EXPECT_TRUE(contains(refusal_of([] { try_adapter("exec:no-such-program"); }), "no such file"));
}

TEST_F(ProtocolKit, NamesTheIngredientsThatAreMissingAlone) {
  // an engine that supports spheres but ignores one or two ingredients of its scene
  const auto inert = [&](const std::string& edits) {
    const std::string program =
        script("adapter", "sed -i -E " + edits + " \"$1\"\n" CROSSCHECK_BULLET32_PROGRAM " \"$1\" \"$2\"\n");
    std::set<std::string> topics;
    for (const ConformanceLine& line : try_adapter("exec:" + program + "+world=deformable-explicit").lines)
      if (line.state == Conformance::lacks && line.topic.starts_with("acts: "))
        topics.insert(line.scene + ", " + line.topic);
    return topics;
  };
  const std::string no_friction = "-e 's/\"friction\": ?[0-9.e-]+/\"friction\":0/g'",
                    no_drag = "-e 's/\"coefficient\": ?\\[[^]]*\\]/\"coefficient\":[0,0]/'";
  EXPECT_EQ(inert("-e ''"), std::set<std::string>{});
  EXPECT_EQ(inert(no_friction), (std::set<std::string>{"ball, acts: friction", "slope, acts: friction"}));
  EXPECT_EQ(inert(no_friction + " " + no_drag),
            (std::set<std::string>{"ball, acts: friction", "slope, acts: friction", "damped-spring, acts: drag"}));
}

}  // namespace
}  // namespace crosscheck
