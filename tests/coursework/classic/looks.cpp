// Dispatch table: one line for each column of the texts.
#include "tests/coursework/classic/looks.h"

#include <stdexcept>

#include "tests/coursework/classic/oracles.h"
#include "tests/coursework/classic/replay.h"
#include "tests/coursework/classic/springs.h"

namespace coursework::classic {
namespace {

/// `size` is the requested number of particles; for a cloth, the number along a side.
Features look(const std::string& column, int size, const Findings& found) {
  if (column == "purity") return purity(found);
  if (column == "motion") return motion(found, size);
  if (column == "cloth_motion") {
    // the presence and the place of a cloth's pins are the student's choice; only the moving particles are checked
    Features features = motion(found, size * size);
    features.erase(features.begin() + 2, features.end());
    return features;
  }
  // the forces of a non-deterministic evalF cannot be inferred
  if (!found.repeats) return {};
  if (column == "gravity") return gravity(found);
  if (column == "drag") return drag(found);
  if (column == "law") return spring_law(found);
  if (column == "links") return chain_links(found);
  if (const auto family = family_of(column); !family.empty()) return cloth_family(found, family);
  if (column == "others") return cloth_others(found);
  if (column == "lengths") return cloth_lengths(found);
  if (column == "pins") return cloth_pins(found);
  throw std::logic_error("no oracle finds the column " + column);
}

}  // namespace

Found features(const Case& what, const Numbers& answers) {
  if (what.column == "vector") return answers;
  Found found({});
  for (const Feature& one : look(what.column, static_cast<int>(what.in.at(0)), replay(what, answers)))
    found.got.push_back(one.got), found.of.push_back(one.of);
  return found;
}

}  // namespace coursework::classic
