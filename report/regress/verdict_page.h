// The page of a regression run: what moved, by how much, why, and pictures of it.
#pragma once

#include "experiments/regress/speed_run.h"
#include "report/page/page.h"
#include "report/regress/evidence.h"

namespace crosscheck {

/// A failed question with its figures.
struct FailurePart {
  std::string scene, heading, text;
  std::vector<PageImage> images;
  PageTable table;
};

struct VerdictPage {
  const Regressed& result;
  const Speeds& speeds;
  std::string cause;    // empty: not attributed
  std::string blessed;  // why, where these changes are blessed; empty elsewhere
  std::string beside;   // "baselines in ..." or the other method
  std::vector<FailurePart> parts;
  std::vector<std::string> problems;  // what could not be drawn
  Provenance lines;
};

/// Draws the failures (at most `most`) into OUT/figures. What cannot be drawn is added to `problems`.
std::vector<FailurePart> failure_parts(const std::vector<Question>& questions, const Regressed& result,
                                       const Regression& regression, int most, const Provenance& lines,
                                       std::vector<std::string>& problems);

/// Writes OUT/index.html with its parts: the figures of at most `figures` failed questions. What cannot be drawn is
/// said there and on stderr.
void write_verdict_page(VerdictPage& page, const std::vector<Question>& questions, const Regression& regression,
                        int figures);

std::string verdict_html(const VerdictPage& page);

/// "was 1, is 2 m; tolerance 1e-12, 3e11 tolerances off"
std::string change_in_words(const Compared& row);

}  // namespace crosscheck
