// Asks the student's system and records its answers; no other data leave this process.
#pragma once

#include <cstring>

#include "../../check/case.h"
#include "asker.h"
#include "forces.h"
#include "system.h"

namespace probe {

template <class T>
class Ask : public Asker {
 public:
  Ask(T& system, coursework::Numbers& record) : system_(system), record_(record) {}

  State start() override { return told(ours(state_of(system_)), {}); }
  void store(const State& state) override { probe::store(system_, theirs(state)); }
  Some stored(const Indices& which) override { return some_of(state_of(system_), which); }
  void end(float drawn) override { record_.push_back(drawn); }
  Some some(const State& given, const Indices& which) override {
    return some_of(evaluate(system_, theirs(given)), which);
  }

  State changed(const State& given, const State& known) override {
    return told(ours(evaluate(system_, theirs(given))), known);
  }

 private:
  // uses only the three numbers of a Vector3f, which may be the student's own class
  static Plain plain(const Vector3f& v) { return {{float(v[0]), float(v[1]), float(v[2])}}; }
  static State ours(const Vec& vectors) {
    State state;
    for (const Vector3f& v : vectors) state.push_back(plain(v));
    return state;
  }
  static Vec theirs(const State& state) {
    Vec vectors;
    for (const Plain& v : state) vectors.push_back(Vector3f(v[0], v[1], v[2]));
    return vectors;
  }

  void record(const Plain& v) { record_.insert(record_.end(), v.at, v.at + 3); }
  /// Records the number of entries, the number of entries that differ from `known`, and then each differing entry,
  /// preceded by its index unless `known` is empty.
  State told(const State& f, const State& known) {
    Indices differ;
    // compares bit by bit, so that the values read from the record are exactly f
    for (std::size_t i = 0; i < f.size(); ++i)
      if (i >= known.size() || std::memcmp(f[i].at, known[i].at, sizeof f[i].at) != 0) differ.push_back(i);
    record_.insert(record_.end(), {double(f.size()), double(differ.size())});
    for (const std::size_t i : differ) {
      if (!known.empty()) record_.push_back(double(i));
      record(f[i]);
    }
    return f;
  }
  Some some_of(const Vec& vectors, const Indices& which) {
    Some some{vectors.size(), {}};
    record_.push_back(double(vectors.size()));
    for (const std::size_t i : which) {
      some.entries.push_back(i < vectors.size() ? plain(vectors[i]) : absent());
      if (i < vectors.size()) record(some.entries.back());
    }
    return some;
  }

  T& system_;
  coursework::Numbers& record_;
};

/// Asks the questions of the call; `out` is the record of answers. The grader extracts the findings from it.
template <class T>
bool answered(T& system, std::uint64_t seed, const std::string& call, coursework::Numbers& out) {
  Ask<T> asker(system, out);
  Findings found;
  return Forces(asker, seed).answer(call, found);
}

}  // namespace probe
