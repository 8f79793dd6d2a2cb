// The classic assignment's programs, as the grader asks for them.
#pragma once

#include "tests/coursework/grader/build.h"

namespace coursework::classic {

std::unique_ptr<Builder> whole_builder(const Assignment& assignment, const Lane& trusted, const Lane& lane);

}  // namespace coursework::classic
