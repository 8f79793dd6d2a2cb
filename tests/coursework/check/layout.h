// Layout of the numbers of a call, as declared in the texts under "given.CALL".
#pragma once

#include <string>
#include <vector>

#include "case.h"
#include "texts.h"

namespace coursework {

/// Numbers of a call under one name. Each repetition of a group has its own fields.
struct Field {
  std::string name;
  int item = -1;  // index within its group, -1 outside of groups
  int group = -1;
  std::size_t begin = 0, rows = 1, columns = 1;
  bool whole = false;  // a count or an index
  bool angle = false;  // in radians
  bool list = false;   // a single row whose length is a named count of the layout
  bool other = false;  // belongs to a repetition that is not shown
  int counted = -1;    // position of the count of its numbers; -1 if there is no count, or if other fields share it
  std::size_t size() const { return rows * columns; }
};

/// A group of fields that is repeated: position of the count of repetitions, and range of its numbers.
struct FieldGroup {
  int counted = -1;  // as in Field
  std::size_t begin = 0, end = 0, items = 0;
};

/// A layout is a sequence of NAME, NAME[COUNTS] and COUNT*( ... ). A count is a number, a name, a name minus one (n-1),
/// or ~ for all remaining numbers. COUNT@( ... ) shows only the repetition whose row differs. NAME! is an angle in
/// radians, NAME# an index or a choice.
struct CallLayout {
  std::vector<Field> fields;
  std::vector<FieldGroup> groups;
  bool fits = false;  // the layout accounts for exactly the given numbers

  /// `row`: index of the row (of `rows`) that differs, or -1.
  static CallLayout read(const std::string& layout, const Numbers& in, int row = -1, std::size_t rows = 0);
  /// Layout of a call, without its sentence. `fits` is false if the texts do not mention the call.
  static CallLayout of(const Texts& own, const Case& what, int row = -1);
};

/// The key of the call's layout in the texts: the full name, or the part of the name after the dot.
std::string layout_key(const Texts& own, const Case& what);

}  // namespace coursework
