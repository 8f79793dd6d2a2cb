#include "experiments/check/check.h"
#include "experiments/check/protocol_kit.h"
#include "reference/which_rule.h"
#include "report/commands/command_line.h"
#include "report/commands/json_files.h"
#include "report/page/page.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {
namespace {

/// Returns 0 if all required parts of the protocol are present.
int check_protocol(const std::string& program, bool as_json) {
  const ConformanceReport report = try_adapter(program);
  Json json{{"format", 1}, {"program", report.program}, {"complete", report.complete()}, {"lines", Json::array()}};
  int ok = 0, lacking = 0, required = 0, refused = 0;
  for (const ConformanceLine& line : report.lines) {
    json["lines"].push_back({{"scene", line.scene},
                             {"topic", line.topic},
                             {"state", name_of(line.state)},
                             {"required", line.required},
                             {"told", line.told},
                             {"section", line.section}});
    const bool lacks = line.state == Conformance::lacks;
    ok += line.state == Conformance::ok, lacking += lacks, refused += line.state == Conformance::refuses;
    required += lacks && line.required;
    if (!as_json)
      fmt::print("{:<8} {:<14} {:<38} {}{}{}\n", name_of(line.state), line.scene, line.topic, line.told,
                 lacks ? fmt::format(" [PROTOCOL.md, {}]", line.section) : "",
                 lacks && line.required ? " REQUIRED" : "");
  }
  if (as_json)
    fmt::print("{}\n", dump(json, 2));
  else
    fmt::print("\n{}: {} ok, {} lacking, of which {} required, {} refused\n", report.program, ok, lacking, required,
               refused);
  return report.complete() ? 0 : 1;
}

struct CheckOptions {
  std::vector<std::string> words;
  std::string known, junit, out, relation;
  unsigned seed = 1;
  std::string program;  // argument of --protocol; if it is empty, the command tests relations
  bool json = false;
  std::string command_line;
};

/// Names of shipped scenes and files ending in .toml are scenes; other words are methods.
void sort_words(const std::vector<std::string>& words, std::vector<Method>& methods, std::vector<Scene>& scenes) {
  std::vector<std::string> names;
  const auto shipped = shipped_scenes();
  for (const std::string& word : words) {
    if (word.ends_with(".toml") || std::find(shipped.begin(), shipped.end(), word) != shipped.end()) {
      names.push_back(word);
      continue;
    }
    try {
      methods.push_back(find_method(word));
    } catch (const InputError&) {
      const std::vector<std::string> scenes_by_name{shipped.begin(), shipped.end()};
      if (closest_match(word, scenes_by_name).empty()) throw;
      throw InputError(unknown_name("method or scene", word, scenes_by_name, "crosscheck list scenes"));
    }
  }
  if (methods.empty()) throw InputError("check: expected at least one method in addition to the scenes");
  if (!names.empty()) scenes = load_scenes(names, methods[0].name);
}

Json json_of(const std::vector<Answer>& answers) {
  Json all{{"format", 1}, {"passed", status_of(answers) == 0}, {"relations", Json::array()}};
  for (const Answer& a : answers) {
    Json one{{"method", a.method}, {"relation", a.relation->name}, {"says", a.relation->sentence},
             {"scene", a.scene},   {"scene_hash", a.scene_hash},   {"mark", name_of(a.mark)}};
    if (!a.finding.what.empty())
      one.update({{"compared", a.finding.what},
                  {"unit", a.finding.unit},
                  {"measured", a.finding.measured},
                  {"tolerance", a.finding.tolerance},
                  {"allowed", a.relation->allowed}});
    if (a.finding.since) one["since"] = *a.finding.since;
    if (!a.reason.empty()) one["reason"] = a.reason;
    all["relations"].push_back(std::move(one));
  }
  return all;
}

/// JUnit XML with one test case per answer: failed if the relation is broken for an unknown cause; skipped if the cause
/// is known, or the relation is not applicable.
std::string junit_of(const std::vector<Answer>& answers) {
  std::vector<TestCase> cases;
  for (const Answer& a : answers)
    cases.push_back({a.method, fmt::format("{}: {}", a.relation->name, a.scene),
                     a.mark == RelationMark::holds    ? ""
                     : a.mark == RelationMark::broken ? "failure"
                                                      : "skipped",
                     a.sentence()});
  return junit_xml("check", cases);
}

/// Draws violations without a known cause: at the time of the violation or, if no time is known, at the end of the run.
/// Omits violations that cannot be drawn.
std::vector<PageImage> draw_breaks(const std::vector<Answer>& answers, const std::vector<Method>& methods,
                                   const std::vector<Scene>& scenes, const std::filesystem::path& folder,
                                   ResumableOutput& output) {
  std::vector<PageImage> pictures;
  for (const Answer& a : answers) {
    if (a.mark != RelationMark::broken) continue;
    const std::vector<Scene> asked = scenes.empty() ? a.relation->smallest() : scenes;
    const auto scene = std::ranges::find(asked, a.scene, &Scene::name);
    const auto file = folder / (file_name_of(fmt::format("{}-{}-{}", a.relation->name, a.method, a.scene)) + ".png");
    output.announce({file.filename().string()});
    if (scene == asked.end()) continue;
    try {
      const Method& method = *std::ranges::find(methods, a.method, &Method::name);
      const MethodResult result = recorded_result(method, *scene, run_for_relations(*scene));
      Shot shot = usual_shot(*scene, false);
      shot.at = a.finding.since.value_or(-1);
      render::write_png(picture_of(*scene, {&result}, shot), file);
    } catch (const std::exception&) {
      continue;
    }
    const std::string caption =
        fmt::format("{} on {}{}. Broken: {}.", a.method, a.scene,
                    a.finding.since ? fmt::format(" at {:.2g} s", *a.finding.since) : "", a.relation->sentence);
    pictures.push_back({file, fmt::format("{} on {}", a.method, a.scene), caption});
  }
  return pictures;
}

int check_relations(const CheckOptions& options) {
  std::vector<Method> methods;
  std::vector<Scene> scenes;
  sort_words(options.words, methods, scenes);
  const auto known =
      read_known_breaks(options.known.empty() ? shipped_known_breaks() : std::filesystem::path(options.known));
  std::optional<ResumableOutput> folder;
  if (!options.out.empty()) folder.emplace(options.out, "check");
  Progress progress(static_cast<int>(methods.size() * relations().size()));
  std::vector<Answer> answers;
  const Provenance lines = provenance(options.command_line);
  Table so_far = table_of(std::vector<Answer>());
  // print and write each row at once: a check that is stopped keeps its results
  const OnAnswer on_answer = [&](const Answer& answer) {
    if (!options.json)
      fmt::print("{:<16} {:<17} {:<20} {:<20} {}\n", name_of(answer.mark), answer.relation->name, answer.method,
                 answer.scene, answer.sentence());
    std::fflush(stdout);
    if (!folder) return;
    so_far.add(table_of(std::vector{answer}).rows[0]);
    write_file(folder->growing(so_far.name + ".csv"), csv(so_far, lines));
  };
  const Relation* only = options.relation.empty() ? nullptr : &find_relation(options.relation);
  for (const Method& method : methods) {
    if (method.identify && !options.json)
      fmt::print("{}: its rule is {}\n", method.name, sentence_of(method.identify()));
    std::ranges::move(answers_of(
                          method, scenes, options.seed, known, [&](const std::string& what) { progress.begin(what); },
                          on_answer, only),
                      std::back_inserter(answers));
  }
  progress.done();
  if (folder) {
    const std::filesystem::path out(options.out);
    const Table table = table_of(answers);
    folder->announce({table.name + ".csv", "index.html"});
    write_csv(table, lines, out);
    write_file(out / "index.html", relations_page_html(rows_of<RelationRow>(table),
                                                       draw_breaks(answers, methods, scenes, out, *folder), lines));
    folder->finish();
  }
  if (!options.junit.empty()) write_file(options.junit, junit_of(answers));
  std::vector<std::string> counts;
  for (const auto mark : {RelationMark::holds, RelationMark::broken, RelationMark::known, RelationMark::not_applicable})
    counts.push_back(fmt::format("{} {}", std::ranges::count(answers, mark, &Answer::mark), name_of(mark)));
  if (options.json)
    fmt::print("{}\n", dump(json_of(answers), 1));
  else
    fmt::print("\n{} answers: {}\n", answers.size(), fmt::join(counts, ", "));
  return status_of(answers);
}

int check_command(const CheckOptions& options) {
  if (!options.program.empty()) return check_protocol(options.program, options.json);
  if (options.words.empty()) throw InputError("check: expected a method, or --protocol exec:PROGRAM");
  return check_relations(options);
}

}  // namespace

void add_check(CLI::App& app, Invocation& call) {
  auto [check, options] = add_command(
      app, call, "check", "tests invariants of a method (symmetries, conservation, order); needs no reference solution",
      check_command);
  auto* words = check.add_option("METHOD", options.words,
                                 "methods, and scenes to test on (default: the smallest scene of each relation)");
  check
      .add_option("--protocol", options.program,
                  "exec:PROGRAM: tests an adapter against the engine protocol, line by line")
      ->excludes(words);
  check.add_option("--known", options.known, "TOML file of known breaks, instead of those that come with Crosscheck");
  check.add_option("--relation", options.relation, "tests this relation only (default: all)");
  check.add_option("--seed", options.seed, "seed of the random rotations, shifts and orders (default: 1)");
  check.add_flag("--json", options.json, "prints JSON");
  check.add_option("--junit", options.junit, "file for JUnit XML");
  check.add_option("--out", options.out, "folder for a page and relations.csv (default: none is written)");
}

}  // namespace crosscheck
