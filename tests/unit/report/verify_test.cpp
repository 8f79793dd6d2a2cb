// Findings follow from the data: tables survive a round trip, findings name their rules and rows, and a report with
// changed data does not pass.

#include <fstream>

#include "experiments/scenes/scenes.h"
#include "experiments/tables/table.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "report/findings/evidence.h"
#include "report/findings/findings_text.h"
#include "report/findings/verify.h"
#include "report/page/page.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/made_up_findings.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class ReadCsv : public InFolder {
 protected:
  std::string message_of(const std::string& text) {
    try {
      read_csv(write("bad.csv", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(ReadCsv, RowsComeBackAsTheyWereWritten) {
  Table t{"probe", {{"words", "1"}, {"error", "m"}, {"steps", "1"}, {"note [odd], long", "1"}, {"none", "s"}}, {}};
  t.add({std::string("a,b"), 0.1, 7L, std::string("plain"), {}});
  t.add({std::string("say \"so\""), -0.0, -3L, {}, {}});
  t.add({std::string("two\nlines"), 1e300, {}, std::string("12"), {}});
  t.add({std::string("x"), NAN, 0L, {}, {}});
  t.add({std::string("y"), -INFINITY, 0L, {}, {}});
  write_csv(t, {{"command", "test"}}, folder_);
  const Table back = read_csv(folder_ / "probe.csv");
  EXPECT_EQ(back.name, "probe");
  EXPECT_EQ(back.columns, t.columns);
  ASSERT_EQ(back.rows.size(), t.rows.size());
  for (size_t i = 0; i < t.rows.size(); ++i) EXPECT_EQ(csv_row(back.rows[i]), csv_row(t.rows[i]));
  EXPECT_EQ(std::get<long>(back.at(0, "steps")), 7);
  EXPECT_EQ(std::get<std::string>(back.at(2, "note [odd], long")), "12");  // a number in a text column is read as text
  EXPECT_TRUE(std::signbit(std::get<double>(back.at(1, "error"))));
}

TEST_F(ReadCsv, SaysWhatIsWrongAndWhere) {
  EXPECT_TRUE(contains(message_of("# a: b\nscene [1],x [m]\nq,1\nq\n"), "bad.csv:5: expected 2 cells in the row"));
  EXPECT_TRUE(contains(message_of("scene\n"), "bad.csv:2: expected columns as \"name [unit]\""));
  EXPECT_TRUE(contains(message_of("scene [1]\n\"open\n"), "expected a closing quote"));
  EXPECT_TRUE(contains(message_of("scene [1]\ntorn"), "expected a line feed at the end of the row"));
  EXPECT_TRUE(contains(message_of("scene [1]"), "expected a line feed"));
  EXPECT_TRUE(contains(message_of("scene [1]\n\"a\nb\"\n"), "column scene: expected text without control"));
  EXPECT_TRUE(contains(message_of("note [1]\n\x1b[2J\n"), "column note: expected text without control"));
  try {
    read_csv(folder_ / "absent.csv");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "absent.csv: expected a table"));
  }
}

std::vector<std::string> placeholders_of(const std::string& sentence) {
  std::vector<std::string> names;
  for (size_t at = sentence.find('{'); at != std::string::npos; at = sentence.find('{', at + 1))
    names.push_back(sentence.substr(at + 1, sentence.find('}', at) - at - 1));
  return names;
}

TEST(FindingRules, HaveTextsAndTheseAskForNothingElse) {
  std::set<std::string_view> keys, of_texts;
  for (const FindingRule& rule : finding_rules()) {
    EXPECT_TRUE(keys.insert(rule.key).second) << rule.key;
    EXPECT_FALSE(rule.tables.empty()) << rule.key;
    EXPECT_FALSE(rule.quantity.empty()) << rule.key;
  }
  EXPECT_LE(keys.size(), 45u) << "numbers shown in a table of the page need no sentence";
  const std::set<std::string> of_all{"scene", "method", "other", "value", "low", "high", "range", "value±"};
  std::set<std::string> asked;  // "key word"
  for (const auto& [key, text] : finding_texts()) {
    SCOPED_TRACE(key);
    EXPECT_FALSE(text.formula.empty());
    const FindingRule& rule = finding_rule(key);  // throws if there is no such rule
    of_texts.insert(rule.key);
    const std::vector<std::string> words = split(rule.words, ' ');
    for (const std::string& name : placeholders_of(text.sentence)) {
      EXPECT_TRUE(of_all.contains(name) || std::ranges::count(words, name) > 0) << name;
      asked.insert(fmt::format("{} {}", rule.key, name));
    }
    EXPECT_EQ(count(text.sentence, "["), count(text.sentence, "]"));
    Finding f = made_up(rule, "x");
    f.rule = key;
    expect_short({f});
  }
  EXPECT_EQ(of_texts, keys) << "each rule must have a text";
  for (const FindingRule& rule : finding_rules())
    for (const std::string& name : split(rule.words, ' '))
      if (!name.empty()) {
        EXPECT_TRUE(asked.contains(fmt::format("{} {}", rule.key, name))) << rule.key << " needs no " << name;
      }
  EXPECT_THROW(finding_rule("unheard-of"), std::logic_error);
}

TEST(FindingRules, TextsAreFilledInWithTheUnitOfTheirQuantity) {
  Finding f{.rule = "cone", .method = "bullet/pbd", .value = 36, .words = {{"cases", "72"}, {"planes", ""}}};
  EXPECT_EQ(sentence_of(f), "On slopes Bullet's pbd sticks or slides as Coulomb's law says in 36 of 72 cases.");
  f.words["planes"] = "31 of 72";
  EXPECT_TRUE(sentence_of(f).ends_with("in 36 of 72 cases on a ball and 31 of 72 on a plane."));
  EXPECT_EQ(tier_of(f), "exact (Coulomb's law)");
  f.tier = "converged";
  EXPECT_EQ(tier_of(f), "converged");
  f.words.clear();
  EXPECT_THROW(sentence_of(f), std::logic_error) << "expected an error for a missing word";
  const std::pair<const char*, const char*> written[] = {{"answer-contact", "differ by 5 mm until"},      // m
                                                         {"energy-failed", "after 5 ms ("},               // s
                                                         {"numerical-damping", "within 0.005 %."},        // %
                                                         {"still-touches", "slides at 5 mm/s."},          // m/s
                                                         {"engines-damp", "a drag of 0.005 per second"},  // 1/s
                                                         {"leaving", "off by 0.005 degrees"},
                                                         {"bend-power", "with the power 0.01 ± 0.00 of"}};
  for (const auto& [rule, text] : written)
    EXPECT_TRUE(contains(sentence_of(made_up(finding_rule(rule), "x")), text)) << rule;
  Finding times = made_up(finding_rule("engine-times"), "x");
  for (const auto& [value, text] :
       {std::pair{27.4, "27 times"}, {3., " 3 times"}, {0.35, " 0.35 times"}, {100000., "100 000 times"}}) {
    times.low = times.high = value;
    EXPECT_TRUE(contains(sentence_of(times), text)) << sentence_of(times);
  }
}

TEST(FindingRules, APartInBracketsIsLeftOutWhereAWordIsEmpty) {
  Finding f = made_up(finding_rule("answer-contact"), "x");
  EXPECT_TRUE(contains(sentence_of(f), "until x and by x at the end."));
  f.words["final"] = "";
  EXPECT_TRUE(sentence_of(f).ends_with("until x."));
}

TEST(FindingRules, NamesOfMethodsAndEnginesAreThoseThatPeopleUse) {
  const std::pair<const char*, const char*> names[] = {
      {"mysim/leapfrog", "leapfrog"},           {"mysim/trapezoidal", "Heun"}, {"mysim", "mysim"},
      {"bullet/pbd+n=10", "Bullet's pbd+n=10"}, {"bullet", "Bullet"},          {"odeint/rk4", "odeint/rk4"},
      {"exec:./bin/mine+n=2/3", "mine+n=2/3"},  {"exec:mine", "mine"}};
  for (const auto& [name, shown] : names) EXPECT_EQ(name_in_sentence(name), shown);
  EXPECT_EQ(listed({"a", "b", "c"}), "a, b and c");
  EXPECT_EQ(listed({"a", "b", "c", "d", "e"}), "a, b, c and 2 more");
}

/// A report on two scenes with a few methods, reduced to its data and report.json.
class Verify : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    Request request;
    request.scenes = load_scenes({"projectile", "chain"});
    request.methods = find_methods("mysim/symplectic-euler,mysim/explicit-euler,bullet/deformable-explicit");
    for (const Experiment& e : experiments())
      if (e.name == std::string_view("engines"))
        for (const Point& point : e.points(request)) point.compute(rows_);
    PageContent page;
    const AllFindings all = all_findings(request.scenes, rows_);
    for (size_t i = 0; i < request.scenes.size(); ++i) page.scenes.push_back({&request.scenes[i], &all.facts[i], {}});
    for (const Table& table : rows_.tables) write_csv(table, {}, folder_ / "data");
    for (const Scene& scene : request.scenes)
      write_file(folder_ / "data/scenes" / (scene.name + ".toml"), scene.source);
    write_file(folder_ / "report.json", report_json(page, all, {}, rows_, "named"));
    findings_ = all.overall.size() + all.of_scenes[0].size() + all.of_scenes[1].size();
  }
  /// Replaces the first occurrence of `from` in a file.
  void replace(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = read(folder_ / file);
    const size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_file(folder_ / file, text.replace(at, from.size(), to));
  }
  std::string mismatches() const {
    std::string all;
    for (const std::string& m : verify_report(folder_).mismatches) all += m + "\n";
    return all;
  }
  TableSet rows_;
  size_t findings_ = 0;
};

TEST_F(Verify, AReportFollowsFromItsData) {
  const Verification found = verify_report(folder_);
  EXPECT_TRUE(found.mismatches.empty()) << mismatches();
  EXPECT_EQ(static_cast<size_t>(found.findings), findings_);
  EXPECT_GT(found.findings, 4);
  size_t rows = 0;
  for (const Table& table : rows_.tables) rows += table.rows.size();
  EXPECT_EQ(static_cast<size_t>(found.rows), rows);
}

TEST_F(Verify, EveryChangedRowIsNoticed) {
  // change each cell of a table that findings depend on, one at a time
  const Table& engines = *rows_.table("engines");
  const std::string whole = read(folder_ / "data/engines.csv");
  for (size_t row = 0; row < engines.rows.size(); ++row)
    for (size_t i = 0; i < engines.columns.size(); ++i) {
      Table changed = engines;
      Cell& cell = changed.rows[row][i];
      if (auto* number = std::get_if<double>(&cell))
        *number = std::nextafter(*number, INFINITY);
      else if (auto* count = std::get_if<long>(&cell))
        ++*count;
      else
        continue;
      if (csv_row(changed.rows[row]) == csv_row(engines.rows[row])) continue;  // nan
      write_csv(changed, {}, folder_ / "data");
      EXPECT_FALSE(mismatches().empty()) << row << " " << engines.columns[i].name;
    }
  write_file(folder_ / "data/engines.csv", whole);
  EXPECT_EQ(mismatches(), "");
}

TEST_F(Verify, WhatDiffersIsNamed) {
  const std::string report = read(folder_ / "report.json");
  replace("report.json", "At a step of 1 ms", "At a step of 9 ms");
  EXPECT_TRUE(contains(mismatches(), "the data say \"At a step of 1 ms"));
  write_file(folder_ / "report.json", report);
  replace("report.json", "\"tier\": \"measured\"", "\"tier\": \"exact\"");
  EXPECT_TRUE(contains(mismatches(), "it rests on \"measured\""));
  write_file(folder_ / "report.json", report);
  replace("data/scenes/chain.toml", "gamma = ", "gamma = 1");
  EXPECT_TRUE(contains(mismatches(), "scene chain: differs from the reported one"));
}

TEST_F(Verify, EveryPartOfAFindingIsComparedWithTheData) {
  const std::string whole = read(folder_ / "report.json");
  const JsonField report = JsonField::parse_file((folder_ / "report.json").string());
  const std::vector<JsonField> findings = report["findings"].elements();
  ASSERT_FALSE(findings.empty());
  for (const auto& [key, value] : findings.back().items()) {
    if (key == "figure" || key == "evidence")
      continue;  // `figure` is presentation only; another test covers `evidence`
    const std::string line = fmt::format("\"{}\": {}", key, value.dump());
    std::string text = whole;
    const size_t at = text.rfind(line);
    ASSERT_NE(at, std::string::npos) << line;
    write_file(folder_ / "report.json",
               text.replace(at, line.size(), fmt::format("\"{}\": {}", key, value.is_text() ? "\"other\"" : "0.125")));
    EXPECT_FALSE(mismatches().empty()) << key;
  }
}

TEST_F(Verify, SentencesAreShort) {
  const AllFindings all = all_findings(load_scenes({"projectile", "chain"}), rows_);
  expect_short(all.overall);
  for (const auto& of_scene : all.of_scenes) expect_short(of_scene);
}

TEST_F(Verify, ReportsOfOlderVersionsAreHeldAgainstTheDataToo) {
  std::string text = read(folder_ / "report.json");
  for (size_t at; (at = text.find("\"quantity\": ")) != std::string::npos;) text.erase(at, text.find('\n', at) - at);
  write_file(folder_ / "report.json", text);
  EXPECT_TRUE(contains(mismatches(), "the data say quantity: "));
}

TEST_F(Verify, MissingPartsAreErrors) {
  std::filesystem::remove(folder_ / "data/engines.csv");
  EXPECT_THROW(verify_report(folder_), InputError);
  write_file(folder_ / "report.json", "{\"format\": 2, \"problems\": [\"the report was not finished\"]}");
  try {
    verify_report(folder_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "expected a finished report"));
  }
}

using Changes = Verify;

TEST_F(Changes, AreTheSentencesThatDiffer) {
  const std::vector<Scene> scenes = load_scenes({"projectile", "chain"});
  const AllFindings now = all_findings(scenes, rows_);
  EXPECT_TRUE(changes_since(folder_, now).empty());
  replace("report.json", "At a step of 1 ms", "At a step of 9 ms");
  const std::vector<Change> changes = changes_since(folder_, now);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].scene, "chain");
  EXPECT_TRUE(contains(changes[0].before, "At a step of 9 ms"));
  EXPECT_TRUE(contains(changes[0].now, "At a step of 1 ms"));
  EXPECT_FALSE(changes[0].timed);
}

TEST_F(Changes, NewAndGoneFindingsHaveOneSideOnly) {
  AllFindings now = all_findings(load_scenes({"projectile", "chain"}), rows_);
  const Finding gone = now.overall.front();
  now.overall.erase(now.overall.begin());
  const Finding added = made_up(finding_rule("size-cost"), "more");
  now.overall.push_back(added);
  const std::vector<Change> changes = changes_since(folder_, now);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].before, "");
  EXPECT_EQ(changes[0].now, sentence_of(added));
  EXPECT_TRUE(changes[0].timed);
  EXPECT_EQ(changes[1].before, sentence_of(gone));
  EXPECT_EQ(changes[1].now, "");
  write_file(folder_ / "report.json", "{}");
  EXPECT_THROW(changes_since(folder_, now), InputError);
}

}  // namespace
}  // namespace crosscheck
