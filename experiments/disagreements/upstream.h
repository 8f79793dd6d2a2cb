// What is sent upstream: texts made of the rows of experiment `disagreements`.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace crosscheck {

struct TableSet;

struct UpstreamText {
  std::string file, text;  // Markdown
};

/// upstream-gallery.md: each trouble with its threads, its state and the measured evidence, and the threads that no
/// scene can ask. upstream-NAME.md: a report for each trouble that is written up, where it is there. Empty without the
/// rows. `engines`: what was run, as tables say it; rows of a program name the program instead.
std::vector<UpstreamText> upstream_texts(const TableSet& rows, const std::string& engines);

}  // namespace crosscheck
