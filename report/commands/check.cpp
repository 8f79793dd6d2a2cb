// check: what can be asked of an engine without any truth; with --protocol, what an adapter lacks still.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "experiments/check/protocol_kit.h"
#include "mysim/base/json.h"
#include "report/commands/commands.h"

namespace crosscheck {
namespace {

void print_conformance(const ConformanceReport& report) {
  int ok = 0, lacking = 0, required = 0, refused = 0;
  for (const ConformanceLine& line : report.lines) {
    const bool lacks = line.state == Conformance::lacks;
    ok += line.state == Conformance::ok, lacking += lacks, refused += line.state == Conformance::refuses;
    required += lacks && line.required;
    fmt::print("{:<8} {:<14} {:<38} {}{}{}\n", name_of(line.state), line.scene, line.topic, line.told,
               lacks ? fmt::format(" [PROTOCOL.md, {}]", line.section) : "", lacks && line.required ? " REQUIRED" : "");
  }
  fmt::print("\n{}: {} ok, {} lacking, of which {} required, {} refused\n", report.program, ok, lacking, required,
             refused);
}

Json conformance_json(const ConformanceReport& report) {
  Json json{{"format", 1}, {"program", report.program}, {"complete", report.complete()}, {"lines", Json::list()}};
  for (const ConformanceLine& line : report.lines)
    json["lines"].push({{"scene", line.scene},
                        {"topic", line.topic},
                        {"state", name_of(line.state)},
                        {"required", line.required},
                        {"told", line.told},
                        {"section", line.section}});
  return json;
}

/// 0: nothing required lacks.
int check_protocol(const std::string& program, bool json) {
  const ConformanceReport report = try_adapter(program);
  if (json)
    fmt::print("{}\n", conformance_json(report).dump(2));
  else
    print_conformance(report);
  return report.complete() ? 0 : 1;
}

}  // namespace

void add_check(CLI::App& app, Invocation& call) {
  struct Options {
    std::string program;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  auto* check = app.add_subcommand("check", "says line by line what an engine behind the protocol lacks still");
  check->add_option("--protocol", options->program, "exec:PROGRAM: runs the conformance kit of the engine protocol")
      ->required();
  check->add_flag("--json", options->json, "prints JSON");
  check->callback([options, &call] { call.status = check_protocol(options->program, options->json); });
}

}  // namespace crosscheck
