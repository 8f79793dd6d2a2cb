// Joining rows, naming points.
#include "experiments/point.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "mysim/fnv.h"
#include "reference/build_id.h"

namespace crosscheck {

const Table* Rows::table(const std::string& name) const {
  for (const Table& t : tables)
    if (t.name == name) return &t;
  return nullptr;
}

void Rows::add(const Table& table) {
  for (Table& t : tables) {
    if (t.name != table.name) continue;
    if (t.columns != table.columns) throw std::logic_error(fmt::format("table {}: its columns differ", t.name));
    t.rows.insert(t.rows.end(), table.rows.begin(), table.rows.end());
    return;
  }
  tables.push_back(table);
}

void Rows::append(const Rows& other) {
  for (const Table& t : other.tables) add(t);
  certificates.insert(certificates.end(), other.certificates.begin(), other.certificates.end());
  for (const std::string& note : other.notes)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

std::string Point::hash() const {
  return fmt::format("{:016x}", Fnv1a::of(fmt::format("{}\n{}\n{}", build_id(), name, content)));
}

std::string content_of(const Scene& scene) {
  return fmt::format("{} {} duration={} samples={} step={} window={} tolerance={} method={}", scene.name, scene.hash,
                     exact_text(scene.duration), scene.samples, exact_text(scene.step), exact_text(scene.window),
                     exact_text(scene.tolerance), scene.method);
}

}  // namespace crosscheck
