#include "calls.h"

#include "tiny.h"

namespace coursework {

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  if (call == "twice")
    out = {twice(in.at(0))};
  else if (call == "sums")
    out = sums(in);
  else
    return false;
  return true;
}

}  // namespace coursework
