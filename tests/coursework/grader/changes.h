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
    third,  // all kinds up to here multiply or replace every number of that name
    square,
    times,
    over,  // multiplied by itself (square) or by another parameter (times), or divided by it (over)
    first,
    next,
    previous,  // replaced by the value of the first or of a neighbouring item
    exchanged,
    instead,  // replaced by another parameter; `exchanged`: the two parameters swap values
    without,
    only_first,
    only_last,  // a list without items, or with its first or last item only
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
