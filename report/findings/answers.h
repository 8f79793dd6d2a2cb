// The answers at the top of the page: one sentence per question that readers ask first.
#pragma once

#include <string_view>
#include <vector>

#include "report/findings/recommendation.h"

namespace crosscheck {

/// To add a question to the first screen, add a row in answers.cpp.
struct Question {
  std::string_view text;
  std::string_view chapter;             // id of the chapter that shows the answer, too
  std::string_view link;                // text of the link to the chapter
  std::vector<std::string_view> rules;  // keys of the possible answers
};
const std::vector<Question>& questions();

/// Null if the tables do not answer the question.
const Finding* answer_to(const Question& question, const Findings& findings);
/// Joined answers to the questions of a chapter.
std::string answers_of_chapter(std::string_view chapter, const Findings& findings);

}  // namespace crosscheck
