// A system of the grader's own, which steppers advance. It has every form of evalF and draw, so that it is complete
// whatever the student's base class requires.
#pragma once

#include "case.h"
#include "system.h"

struct GLProgram;

namespace probe {

template <class B>
auto kind_of_init(int) -> decltype(std::declval<B&>().initState());
template <class B>
void kind_of_init(...);

/// For each vector of the state: x_i' = A x_i + q (x x, y y, z z) + c x_(i+1), with cyclic indices. A stepper cannot
/// know the coefficients, and the vectors interact.
class Own : public ParticleSystem {
 public:
  using ParticleSystem::ParticleSystem;
  using Init = decltype(kind_of_init<ParticleSystem>(0));

  /// Sets the nine numbers of A, row by row, q and c.
  void become(const double* numbers, const Vec& state) {
    for (int i = 0; i < 9; ++i) a_[i] = static_cast<float>(numbers[i]);
    q_ = static_cast<float>(numbers[9]), c_ = static_cast<float>(numbers[10]);
    enlarge(*this, state);
    store(base_of(*this), state);
  }

  Vec f(const Vec& state) const {
    coursework::calling("evalF");
    ++asked;
    Vec out;
    for (std::size_t k = 0; k < state.size(); ++k) {
      const Vector3f &s = state[k], &next = state[(k + 1) % state.size()];
      float row[3];
      for (int i = 0; i < 3; ++i)
        row[i] = a_[3 * i] * s[0] + a_[3 * i + 1] * s[1] + a_[3 * i + 2] * s[2] + q_ * s[i] * s[i] + c_ * next[i];
      out.push_back(Vector3f(row[0], row[1], row[2]));
    }
    return out;
  }

  mutable int asked = 0;  // evaluations of f

  Vec evalF(Vec s) { return f(s); }
  Vec evalF(Vec s) const { return f(s); }
  Vec evalF(const Vec& s) { return f(s); }
  Vec evalF(const Vec& s) const { return f(s); }
  Vec evalF(Vec& s) { return f(s); }
  Vec evalF(Vec& s) const { return f(s); }
  Vec evalF(Vec s, float) { return f(s); }
  Vec evalF(const Vec& s, float) { return f(s); }
  Vec evalF(Vec s, double) { return f(s); }
  Vec evalF(const Vec& s, double) { return f(s); }
  Vec evalF(Vec s, int) { return f(s); }
  Vec evalF(const Vec& s, int) { return f(s); }
  Vec evalF(Vec s, bool) { return f(s); }
  Vec evalF(const Vec& s, bool) { return f(s); }
  void draw() {}
  void draw() const {}
  void draw(GLProgram&) {}
  void draw(GLProgram&) const {}
  void draw(bool) {}
  void draw(int) {}
  void draw(float) {}
  Init initState() { return Init(); }
  Init initState() const { return Init(); }

 private:
  /// Some base classes write into their own array, which must first be long enough.
  template <class O>
  static void enlarge(O& own, const Vec& state) {
    if constexpr (requires { own.m_vVecState = state; }) own.m_vVecState = state;
    if constexpr (requires { own.m_numParticles = 1; }) own.m_numParticles = static_cast<int>(state.size());
  }

  float a_[9] = {}, q_ = 0, c_ = 0;
};

}  // namespace probe
