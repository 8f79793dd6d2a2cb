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
    third,  // for all numbers with the name
    square,
    times,
    over,  // by itself (square), or by another number
    first,
    next,
    previous,  // replaced by the value of the first item, or of a neighbour
    exchanged,
    instead,  // with the parameter of another name
    without,
    only_first,
    only_last,  // items of a list
    choice      // another integer
  };
  Kind kind;
  std::string name, other = {};
  double number = 0;
  /// Order of preference, from 1: simpler explanations first.
  int tier() const { return kind == square || kind == times || kind == over ? 2 : 1; }
};

/// All changes that the call allows.
std::vector<Change> changes_of(const Texts& own, const Case& what);
/// The changes that remove something from it.
std::vector<Change> removals_of(const Texts& own, const Case& what);

/// The numbers of the case after the change; empty if it does not apply, or has no effect.
std::optional<Numbers> changed(const Texts& own, const Case& what, const Change& change);

/// "drag = 0"
std::string change_text(const Texts& common, const Change& change);

}  // namespace coursework
