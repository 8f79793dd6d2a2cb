// Who answers the questions of forces.h: the student's system (ask.h), or in the grader what it answered (replay.cpp).
// The questions alone come from both sides' own draws, so that an answer is all that a student's process can make up.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace probe {

/// Three numbers of ours: the same arithmetic on both sides, whatever the student's Vector3f does.
struct Plain {
  float at[3] = {0, 0, 0};
  float& operator[](int k) { return at[k]; }
  float operator[](int k) const { return at[k]; }
};
using State = std::vector<Plain>;
using Indices = std::vector<std::size_t>;

inline Plain absent() { return {{NAN, NAN, NAN}}; }
inline Plain plus(const Plain& a, float f, const Plain& b) {
  return {{a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]}};
}
inline float length(const Plain& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
inline bool same(const Plain& a, const Plain& b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }
inline Plain entry(const State& state, std::size_t i) { return i < state.size() ? state[i] : absent(); }

/// A few entries of many.
struct Some {
  std::size_t size = 0;  // of all
  State entries;         // in the order in which they were asked for; absent() where there is no such
};

class Asker {
 public:
  virtual ~Asker() = default;
  /// The state that the system starts with.
  virtual State start() = 0;
  virtual void store(const State& state) = 0;
  /// Entries of the state that is stored.
  virtual Some stored(const Indices& which) = 0;
  /// evalF: all of it, a few entries, or all of it where little differs from what is known.
  virtual State whole(const State& given) = 0;
  virtual Some some(const State& given, const Indices& which) = 0;
  virtual State changed(const State& given, const State& known) = 0;
  /// Nothing is asked any more. `drawn` is one more draw: who wrote answers down on another seed does not know it.
  virtual void end(float drawn) = 0;
};

}  // namespace probe
