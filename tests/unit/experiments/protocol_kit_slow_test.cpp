// The conformance kit detects each seeded defect of an adapter, and reports no other defects.

#include "tests/unit/experiments/protocol_kit.h"

#include <algorithm>

#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST_F(ProtocolKit, TheExampleInJavaScriptLacksNothing) {
  NEEDS_PROGRAM("node", "nodejs", "the JavaScript example is not tested");
  const ConformanceReport report = try_adapter("exec:" CROSSCHECK_SOURCE "/reference/protocol/example_engine.mjs");
  for (const ConformanceLine& line : report.lines)
    EXPECT_NE(line.state, Conformance::lacks) << line.scene << ", " << line.topic << ": " << line.told;
  const auto acts = [&](const std::string& topic) {
    return std::ranges::any_of(report.lines, [&](const ConformanceLine& line) {
      return line.topic == topic && line.state == Conformance::ok;
    });
  };
  for (const char* topic :
       {"acts: dashpots", "acts: drag", "acts: gusts", "certificate: dashpots", "certificate: wind"})
    EXPECT_TRUE(acts(topic)) << topic;
}

TEST_F(ProtocolKit, FindsWhatIsSpoiledAndNamesNothingElse) {
  const std::string rewrite = "sed -i -E ";
  const struct {
    std::string what, before, after;
    std::set<std::string> required, other;
    std::string told;
  } cases[] = {
      {"gives no velocities", "", "rm \"$2/velocities.npy\"\n", {}, {"velocities"}, "there are no energies"},
      {"tells nothing", "", "rm \"$2/run.json\"\n", {}, {"run.json", "certificate"}, "nothing is attested"},
      {"writes a number that is none",
       "",
       "echo '{\"cpu_seconds\": nan}' > \"$2/run.json\"\n",
       {"run.json", "verdict"},
       {"certificate"},
       "cpu_seconds: expected a finite number"},
      {"counts nothing",
       "",
       rewrite + "'s/\"(steps|force_evaluations)\"/\"some\"/' \"$2/run.json\"\n",
       {},
       {"run.json: steps", "run.json: force_evaluations"},
       "the number of steps"},
      {"leaves a row untold",
       "",
       rewrite + "'s/\"may_sleep\"/\"may_rest\"/' \"$2/run.json\"\n",
       {},
       {"certificate: sleeping"},
       "add to readback: may_sleep"},
      {"is at other times",
       rewrite + "'s/\"steps_per_sample\":[0-9]+/\"steps_per_sample\":37/' \"$1\"\n",
       "",
       // verdicts change, too: each state that they judge is requested as a sample
       {"sample times", "speeds", "verdict"},
       {"certificate"},
       "write frames at run.times"},
      {"leaves the pins where they were",
       rewrite + "'s/\"motion\":\\{[^}]*\\},//' \"$1\"\n",
       "",
       {"pins led", "acts: motion of the pins", "certificate: motion of pins"},
       {},
       "place pins at home + d(t)"},
      {"has another gravity",
       rewrite + "'s/-9.81/-1.62/' \"$1\"\n",
       "",
       {"certificate: gravity", "acts: gravity", "speeds"},
       {},
       "another scene was built"},
      {"computes what it does not know",
       rewrite + "'s/\\{\"type\":\"a-term-of-a-later-version\",\"strength\":1.0\\},//' \"$1\"\n",
       "",
       {"unknown term"},
       {},
       "check the type of every term"},
      {"does not leave dashpots to others",
       rewrite + "'s/,\\{\"type\":\"dashpots\",\"list\":\\[[^]]*\\]\\}//' \"$1\"\n",
       "",
       {"acts: dashpots", "certificate: dashpots"},
       {},
       "compute it, or exit 3"},
      {"fails at a new key",
       "if grep -q a-key-of-a-later \"$1\"; then exit 1; fi\n",
       "",
       {"unknown key"},
       {},
       "ignore keys that you do not know"},
      {"dies of an option",
       "if grep -q an-option-that \"$1\"; then kill -SEGV $$; fi\n",
       "",
       {"unknown option"},
       {},
       "was ended by signal 11"},
      {"is another each time",
       rewrite + "\"s/-9.81/-9.81$(date +%N)/\" \"$1\"\n",
       "",
       {"certificate: gravity"},
       {"same call twice"},
       "different bytes"},
      {"leaves a process behind",
       "",
       "sleep 60 &\n",
       {"leaves nothing behind"},
       {},
       "wait for all processes that you start"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.what);
    const ConformanceReport report = spoiled(c.before, c.after);
    EXPECT_EQ(lacking(report, true), c.required);
    EXPECT_EQ(lacking(report, false), c.other);
    EXPECT_EQ(report.complete(), c.required.empty());
    bool told = false;
    for (const ConformanceLine& line : report.lines) {
      told |= line.state == Conformance::lacks && line.told.find(c.told) != std::string::npos;
      EXPECT_EQ(line.section.empty(), line.state != Conformance::lacks);
    }
    EXPECT_TRUE(told) << c.told;
  }
}

}  // namespace
}  // namespace crosscheck
