// The answers that the page opens with: a sentence to each question that a reader asks first.
#pragma once

#include <string_view>
#include <vector>

#include "report/findings/recommendation.h"

namespace crosscheck {

/// A question of the first screen, and the chapter that shows its answer; a new one is a row in answers.cpp.
struct Question {
  std::string_view text;                // as the reader asks it
  std::string_view chapter;             // by its id, also of its answer
  std::string_view link;                // to that chapter
  std::vector<std::string_view> rules;  // keys of its answers
};
const std::vector<Question>& questions();

/// The one of these findings that answers it; null where the tables say nothing of it.
const Finding* answer_to(const Question& question, const Findings& findings);
/// The answers to the questions of a chapter, one after the other.
std::string answers_of_chapter(std::string_view chapter, const Findings& findings);

}  // namespace crosscheck
