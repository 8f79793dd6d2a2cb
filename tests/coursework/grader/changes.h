// A single change of the numbers of a call.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/texts.h"

namespace coursework {

/// A change addressed by names of the layout, so that it applies to every case of a call.
struct Change {
  enum Kind {
    zero,
    one,
    minus,
    twice,
    half,
    thrice,
    third,  // these kinds multiply or replace all numbers with the name
    square,
    times,
    over,  // multiplied or divided: by themselves (square), or by another parameter
    first,
    next,
    previous,  // replaced by the value of the first item, or of a neighbour
    exchanged,
    instead,  // replaced by another parameter; `exchanged`: also the other way round
    without,
    only_first,
    only_last,  // items of a list
    choice      // another integer
  };
  Kind kind;
  std::string name, other = {};
  double number = 0;
  /// Order of preference: 1 for simple explanations, 2 for others.
  int tier() const { return kind == square || kind == times || kind == over ? 2 : 1; }
};

/// All changes that the call allows.
std::vector<Change> changes_of(const Texts& own, const Case& what);
/// The changes that remove an input from the call.
std::vector<Change> removals_of(const Texts& own, const Case& what);

/// The numbers of the case after the change; nullopt if the change does not apply, or has no effect.
std::optional<Numbers> changed(const Texts& own, const Case& what, const Change& change);

/// "drag = 0"
std::string change_text(const Texts& common, const Change& change);

}  // namespace coursework
