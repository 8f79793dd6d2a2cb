// How the numbers of a call are laid out, as the texts say it under "given.CALL". C++17, standard library only.
#pragma once

#include <string>
#include <vector>

#include "case.h"
#include "texts.h"

namespace coursework {

/// Numbers of a call that have one name. In a group that is repeated each repetition has fields of its own.
struct Field {
  std::string name;
  int item = -1;  // of its group, -1 outside of groups
  int group = -1;
  std::size_t begin = 0, rows = 1, columns = 1;
  bool whole = false;  // a count or an index
  bool angle = false;  // in radians
  bool list = false;   // as many as a name of the layout says, in one row
  bool other = false;  // of a row that is not told
  int counted = -1;    // where the count stands that says how many they are; -1: nowhere, or others share it
  std::size_t size() const { return rows * columns; }
};

/// A group: the field that counts its repetitions, and where they stand.
struct FieldGroup {
  int counted = -1;  // as of a field
  std::size_t begin = 0, end = 0, items = 0;
};

/// A layout is NAME, NAME[COUNTS] or COUNT*( ... ), where counts are numbers, names, or names less one (n-1); ~ is as
/// many as there are. Of COUNT@( ... ) only the one is told whose row differs. NAME! is an angle in radians, NAME# an
/// index or a choice.
struct CallLayout {
  std::vector<Field> fields;
  std::vector<FieldGroup> groups;
  bool fits = false;  // the numbers are as many as it says

  /// `row` of `rows` is the one that differs; -1: none is.
  static CallLayout read(const std::string& layout, const Numbers& in, int row = -1, std::size_t rows = 0);
  /// Of a call; its sentence is left out. Does not fit where the texts say nothing of it.
  static CallLayout of(const Texts& own, const Case& what, int row = -1);
};

/// The key under which the texts lay the call out: its whole name, or what stands behind its point.
std::string layout_key(const Texts& own, const Case& what);

}  // namespace coursework
