// One thing changed in the numbers of a call.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/texts.h"

namespace coursework {

/// A change that is told by names of the layout, so that it can be made in every case of a call.
struct Change {
  enum Kind {
    zero,
    one,
    minus,
    twice,
    half,
    thrice,
    third,  // of all numbers with the name
    square,
    times,
    over,  // by itself, by another number
    first,
    next,
    previous,  // of the first or of the neighbour, for all
    exchanged,
    instead,  // with another name
    without,
    only_first,
    only_last,  // items of a list
    choice      // a whole number
  };
  Kind kind;
  std::string name, other = {};
  double number = 0;
  /// From 1: what explains with less comes first.
  int tier() const { return kind == square || kind == times || kind == over ? 2 : 1; }
};

/// All changes that the call allows.
std::vector<Change> changes_of(const Texts& own, const Case& what);
/// Those that take something out of it.
std::vector<Change> removals_of(const Texts& own, const Case& what);

/// The numbers of the case with the change made; nothing where it cannot be made, or changes nothing.
std::optional<Numbers> changed(const Texts& own, const Case& what, const Change& change);

/// "drag = 0"
std::string change_text(const Texts& common, const Change& change);

}  // namespace coursework
