// Divides the points of a test between its public and its hidden form.
#include "tests/coursework/grader/rubric.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mysim/base/files.h"
#include "mysim/base/text.h"
#include "mysim/scene/toml.h"

namespace coursework {
namespace {

using crosscheck::TomlTable;

/// The submissions of a student; `known` receives the names by which students can be addressed.
std::vector<std::string> submissions_of(const std::string& student, const std::vector<Handed>& handed,
                                        std::set<std::string>& known) {
  std::vector<std::string> found;
  for (const Handed& one : handed) {
    std::set<std::string> names{one.name};
    for (const Person& person : one.people) names.insert({person.name, person.id});
    names.erase("");
    if (names.contains(student)) found.push_back(one.name);
    known.merge(names);
  }
  return found;
}

}  // namespace

std::string Rubric::apply(Result& result) const {
  std::map<std::string, std::vector<TestResult*>> twins;
  for (TestResult& test : result.tests) twins[test.id].push_back(&test);
  for (const auto& [id, wanted] : points) {
    double shipped = 0, given = 0;
    for (const TestResult* test : twins[id]) shipped += test->points;
    for (TestResult* test : twins[id]) {
      const bool last = test == twins[id].back();
      const bool full = test->earned > 0;
      test->points = last ? wanted - given : std::round(100 * wanted * test->points / shipped) / 100;
      test->earned = full ? test->points : 0;
      given += test->points;
    }
  }
  std::string unused;
  for (const Override& one : overrides) {
    if (one.submission != result.submission) continue;
    if (twins[one.test].empty()) unused += fmt::format("; the rubric's points of test {} are not used", one.test);
    double left = one.points;
    for (TestResult* test : twins[one.test]) {
      test->earned = std::min(left, test->points);
      left -= test->earned;
      test->ungraded = false;
      test->reason = one.reason;
    }
  }
  return unused;
}

double points_of(const Assignment& assignment, const Rubric& rubric, const std::string& test) {
  double sum = 0;
  for (const Test& one : assignment.tests)
    if (test.empty() || one.id == test) {
      const auto own = rubric.points.find(std::string(one.id));
      sum += own == rubric.points.end() ? one.points + one.hidden : own->second;
    }
  return sum;
}

Rubric read_rubric(const std::filesystem::path& file, const Assignment& assignment, const std::vector<Handed>& handed,
                   bool whole_class) {
  const TomlTable table = TomlTable::parse_text(crosscheck::read_file(file, "a rubric (TOML)"), file.string());
  Rubric rubric;
  std::vector<std::string> ids;
  for (const Test& test : assignment.tests) {
    const std::string id = ids.emplace_back(test.id);
    if (!table.has("points")) continue;
    if (const TomlTable points = table.section("points"); points.has(id)) rubric.points[id] = points.not_negative(id);
  }
  std::set<std::pair<std::string, std::string>> set;
  for (const TomlTable& one : table.sections("override")) {
    Rubric::Override read{"", one.text("test"), one.not_negative("points"), one.text("reason")};
    if (std::find(ids.begin(), ids.end(), read.test) == ids.end())
      one.fail("test", fmt::format("a test of {}{}", assignment.name, crosscheck::did_you_mean(read.test, ids)));
    if (const double most = points_of(assignment, rubric, read.test); read.points > most)
      one.fail("points", fmt::format("at most {}, the points of test {}", points_text(most), read.test));
    const std::string student = one.text("student");
    std::set<std::string> known;
    const std::vector<std::string> found = submissions_of(student, handed, known);
    if (found.size() > 1)
      one.fail("student", fmt::format("the name of one submission; these fit: {}", fmt::join(found, ", ")));
    if (found.empty() && whole_class)
      one.fail("student", fmt::format("a submission, id or name of the class{}",
                                      crosscheck::did_you_mean(student, {known.begin(), known.end()})));
    if (found.empty()) continue;
    read.submission = found.front();
    if (!set.emplace(read.submission, read.test).second)
      one.fail("test", fmt::format("one override of test {} for {}, got a second", read.test, read.submission));
    rubric.overrides.push_back(std::move(read));
  }
  table.finish();
  return rubric;
}

}  // namespace coursework
