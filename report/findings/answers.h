// The answers at the top of the page: one sentence per question that readers ask first.
#pragma once

#include <string_view>
#include <vector>

#include "report/findings/recommendation.h"

namespace crosscheck {

/// A question of the first screen and the chapter that shows its answer; a new question is a row in answers.cpp.
struct Question {
  std::string_view text;                // as displayed
  std::string_view chapter;             // id of the chapter, which shows the answer, too
  std::string_view link;                // text of the link to that chapter
  std::vector<std::string_view> rules;  // keys of its possible answers
};
const std::vector<Question>& questions();

/// The finding that answers the question, or null if the tables do not answer it.
const Finding* answer_to(const Question& question, const Findings& findings);
/// The answers to the questions of a chapter, joined.
std::string answers_of_chapter(std::string_view chapter, const Findings& findings);

}  // namespace crosscheck
