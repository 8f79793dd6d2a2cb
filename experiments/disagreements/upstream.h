// Texts for upstream projects, made from the rows of experiment `disagreements`.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace crosscheck {

struct TableSet;

struct UpstreamText {
  std::string file, text;  // Markdown
};

/// Returns upstream-gallery.md and reports. The gallery contains each disagreement with its threads, its state and the
/// evidence, and then the threads without a scene. The report upstream-NAME.md is about a reproduced disagreement for
/// which a report was written. `engines`: the versions that were run, as in the tables; rows about an external program
/// name the program.
std::vector<UpstreamText> upstream_texts(const TableSet& rows, const std::string& engines);

}  // namespace crosscheck
