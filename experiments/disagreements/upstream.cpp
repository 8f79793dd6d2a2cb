#include "experiments/disagreements/upstream.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/disagreements/disagreements.h"
#include "experiments/tables/disagreements.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"

namespace crosscheck {
namespace {

std::string filled(const std::string& name, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string text = read_file(data_folder() / "experiments/disagreements/upstream" / name, "a text");
  for (const auto& [key, value] : values)
    if (const size_t at = text.find(key); at != std::string::npos) text.replace(at, key.size(), value);
  return text;
}

/// The row's program, or the installed version of Bullet (from the tables' line of engines) and the world.
std::string version_of(const DisagreementRow& row, const std::string& engines) {
  if (row.world.starts_with(program_prefix)) return row.world;
  const size_t bullet = engines.find("Bullet");  // Bullet is the last engine
  return fmt::format("{}, {}", bullet == std::string::npos ? engines : engines.substr(bullet), row.world);
}

std::string gallery(const std::vector<DisagreementRow>& rows, const std::string& engines) {
  std::string troubles;
  for (const DisagreementRow& row : rows)
    troubles +=
        fmt::format("\n## {}\n\n**{}** · scene `{}` · {}\n\nUpstream: {}.\n\n{}\n\nMeasured: {}\n\nCriterion: {}.\n",
                    row.what, row.state, row.name, version_of(row, engines),
                    row.threads.empty() ? "no report known" : row.threads, row.cause, row.effect, row.criterion);
  return filled("gallery.md", {{"{troubles}", troubles}});
}

// The programs in the reports and their output were tested with Bullet 3.24 in double precision (Debian 3.24+dfsg-2).
// The change to buildTreeBottomUp was tested with btSoftBody.cpp from tag 3.24.
constexpr std::string_view reports[] = {"network-in-pieces", "contact-direction"};

bool is_there(const DisagreementRow& row) {
  return row.state == name_of(TroubleState::explained) || row.state == name_of(TroubleState::reproduced);
}

}  // namespace

std::vector<UpstreamText> upstream_texts(const TableSet& rows, const std::string& engines) {
  const Table* table = rows.table(std::string(DisagreementRow::table));
  if (!table || table->rows.empty()) return {};
  const std::vector<DisagreementRow> all = rows_of<DisagreementRow>(*table);
  std::vector<UpstreamText> texts{{"upstream-gallery.md", gallery(all, engines)}};
  for (const DisagreementRow& row : all)
    if (std::ranges::find(reports, row.name) != std::end(reports) && is_there(row))
      texts.push_back(
          {fmt::format("upstream-{}.md", row.name),
           filled(row.name + ".md",
                  {{"{version}", version_of(row, engines)}, {"{effect}", row.effect}, {"{threads}", row.threads}})});
  return texts;
}

}  // namespace crosscheck
