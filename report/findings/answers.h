// The answers at the top of the page: one sentence per question that readers ask first.
#pragma once

#include <string_view>
#include <vector>

#include "report/findings/recommendation.h"

namespace crosscheck {

/// A question on the first screen. To add one, add a row in answers.cpp.
struct Question {
  std::string_view text;
  std::string_view chapter;             // id of the chapter that also shows the answer
  std::string_view link;                // text of the link to the chapter
  std::vector<std::string_view> rules;  // keys of the possible answers
};
const std::vector<Question>& questions();

/// The answer to a question, or null if the tables contain none.
const Finding* answer_to(const Question& question, const Findings& findings);
std::string answers_of_chapter(std::string_view chapter, const Findings& findings);

}  // namespace crosscheck
