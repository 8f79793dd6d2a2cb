// A point: one piece of an experiment's work, independent of all others. Sweeps compute points in any order, on any
// machine, and keep what they gave.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/table.h"
#include "mysim/scene.h"
#include "reference/certificate.h"

namespace crosscheck {

/// What points give. Results are joined by appending the rows of tables of the same name.
struct Rows {
  std::vector<Table> tables;
  std::vector<Certificate> certificates;
  std::vector<std::string> notes;  // what was left out and why, for people

  const Table* table(const std::string& name) const;
  /// Appends the rows of a table to the one of that name, or begins it. Throws std::logic_error when columns differ.
  void add(const Table& table);
  /// Appends all of another's; a note that is there already is not said twice.
  void append(const Rows& other);
};

struct Point {
  std::string name;     // for people: "engines: cloth-hang"; no two of a sweep share it
  std::string content;  // everything, beside the program, that its rows depend on
  std::function<void(Rows&)> compute;
  bool timed = false;  // measures time: is run alone, pinned to one core, after all others

  /// Fingerprint of name, content and program: 16 hexadecimal digits. The same point of another build is another point.
  std::string hash() const;
};

/// What the rows of a scene depend on: its name, its hash, its times, its tolerance and its default method.
std::string content_of(const Scene& scene);

}  // namespace crosscheck
