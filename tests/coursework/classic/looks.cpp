// One line for each column of the texts.
#include "tests/coursework/classic/looks.h"

#include <stdexcept>

#include "tests/coursework/classic/oracles.h"
#include "tests/coursework/classic/replay.h"
#include "tests/coursework/classic/springs.h"

namespace coursework::classic {
namespace {

bool is_of_springs(const std::string& column) {
  for (const char* known : {"law", "links", "structural", "shear", "flexion", "others", "lengths", "pins"})
    if (column == known) return true;
  return false;
}

/// `size` is the count of particles that was asked for, of a cloth those along a side.
Features look(const std::string& column, int size, const Numbers& raw) {
  if (column == "purity") return purity(raw);
  if (column == "motion") return motion(raw, size);
  if (column == "cloth_motion") {
    // whether and where a cloth hangs is the student's choice; only what moves is looked at
    Features found = motion(raw, size * size);
    found.erase(found.begin() + 2, found.end());
    return found;
  }
  // an evalF that does not repeat itself says nothing of its forces
  if ((column == "gravity" || column == "drag") && raw.size() > 1 && raw.back() == 0) return {};
  if (column == "gravity") return gravity(raw);
  if (column == "drag") return drag(raw);
  if (is_of_springs(column))
    if (const Springs springs = springs_of(raw); springs.particles > 0 && !springs.repeats) return {};
  if (column == "law") return spring_law(raw);
  if (column == "links") return chain_links(raw);
  if (column == "structural") return cloth_family(raw, {0, 1}, {1, 0});
  if (column == "shear") return cloth_family(raw, {1, 1}, {1, -1});
  if (column == "flexion") return cloth_family(raw, {0, 2}, {2, 0});
  if (column == "others") return cloth_others(raw);
  if (column == "lengths") return cloth_lengths(raw);
  if (column == "pins") return cloth_pins(raw);
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
