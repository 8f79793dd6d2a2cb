// Interface that answers the questions of forces.h: the student's system (ask.h) or, in the grader, its recorded
// answers (replay.cpp). Both sides draw the questions independently, so a student's process can forge only answers.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace probe {

/// Three numbers with our arithmetic: identical on both sides, independent of the student's Vector3f.
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

/// A few entries of a larger vector.
struct Some {
  std::size_t size = 0;  // size of the whole vector
  State entries;         // in the order of the request; absent() for entries that do not exist
};

class Asker {
 public:
  virtual ~Asker() = default;
  virtual State start() = 0;
  virtual void store(const State& state) = 0;
  virtual Some stored(const Indices& which) = 0;
  /// The next two functions evaluate evalF at `given`. some() returns a few entries, changed() all of them. `known` is
  /// an earlier result from which the entries differ in few places, or empty.
  virtual Some some(const State& given, const Indices& which) = 0;
  virtual State changed(const State& given, const State& known) = 0;
  /// Ends the record with one more random number, `drawn`, which shows that the answers belong to this seed.
  virtual void end(float drawn) = 0;
};

}  // namespace probe
