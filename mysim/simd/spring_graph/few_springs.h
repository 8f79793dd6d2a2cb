// Springs between few particles, one by one: as the plain loop of terms/springs.h, to the last bit, but onto
// nothing. The first spring that acts on a particle stores its force where the others add theirs, so that nothing is
// cleared, and a step that has them in a loop of its own waits for fewer stores.
#pragma once

#include <vector>

#include "mysim/terms/springs.h"

namespace crosscheck {

class FewSprings {
 public:
  FewSprings() = default;
  /// Empty where there are too many particles, or one without a spring.
  FewSprings(const Springs& springs, int particles) : law_(springs.law) {
    if (particles > few_particles) return;
    std::vector<char> met(particles, 0);
    for (const Spring& s : springs.list) {
      list_.push_back({s.a, s.b, s.k, s.rest, !met[s.a], !met[s.b]});
      met[s.a] = met[s.b] = 1;
    }
    for (const char any : met)
      if (!any) list_.clear();
  }
  bool empty() const { return list_.empty(); }

  /// Writes the force on particle i to f[stride i ...] (N), at positions x (m, x y z of each particle). Returns how
  /// many springs of some rest length have ends that met.
  template <int stride>
  long set_forces(const double* x, double* f) const {
    return law_ == SpringLaw::hooke ? loop<stride, SpringLaw::hooke>(x, f) : loop<stride, SpringLaw::bullet_link>(x, f);
  }

 private:
  struct OneOfFew {
    int a, b;        // ends
    double k, rest;  // N/m, m
    bool first_on_a, first_on_b;
  };

  template <int stride, SpringLaw law>
  long loop(const double* x, double* f) const {
    using Point = Eigen::Map<const Vec3>;
    long degenerate = 0;
    for (const OneOfFew& s : list_) {
      const Vec3 d = Point(x + 3 * s.a) - Point(x + 3 * s.b);
      const double squared = d.squaredNorm();
      double scale = 0;
      if (squared != 0)
        scale = force_over_length<law>(s.k, s.rest, squared);
      else
        degenerate += s.rest > 0;
      const Vec3 pull = scale * d;
      double *const a = f + stride * s.a, *const b = f + stride * s.b;
      Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();
      if (!s.first_on_a) on_a = Point(a);
      if (!s.first_on_b) on_b = Point(b);
      Eigen::Map<Vec3>{a} = on_a + pull;
      Eigen::Map<Vec3>{b} = on_b - pull;
    }
    return degenerate;
  }

  SpringLaw law_ = SpringLaw::hooke;
  std::vector<OneOfFew> list_;
};

}  // namespace crosscheck
