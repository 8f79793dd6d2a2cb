// The hand-out's calls of the cloth, in a separate file because the other headers may define the same names
// differently.
#include "ClothSystem.h"
#include "calls.h"
#include "probe/roles.h"

namespace coursework {

bool answer_cloth(const std::string& call, const Numbers& in, Numbers& out) {
  return probe::cloth<ClothSystem>(call, in, out);
}

}  // namespace coursework
