#ifndef FORCE_H
#define FORCE_H

#include <vecmath.h>

#include <memory>
#include <vector>

/// Position and velocity of a particle, on which forces act.
struct Body {
  Vector3f position, velocity;
};

class Force {
 public:
  virtual ~Force() {}
  virtual void addTo(const std::vector<Body>& bodies, std::vector<Vector3f>& sums) const = 0;
};

class Weight : public Force {
 public:
  explicit Weight(Vector3f g) : g_(g) {}
  void addTo(const std::vector<Body>& bodies, std::vector<Vector3f>& sums) const override;

 private:
  Vector3f g_;
};

class Viscosity : public Force {
 public:
  explicit Viscosity(float c) : c_(c) {}
  void addTo(const std::vector<Body>& bodies, std::vector<Vector3f>& sums) const override;

 private:
  float c_;
};

class Hooke : public Force {
 public:
  Hooke(int a, int b, float k, float rest) : a_(a), b_(b), k_(k), rest_(rest) {}
  void addTo(const std::vector<Body>& bodies, std::vector<Vector3f>& sums) const override;

 private:
  int a_, b_;
  float k_, rest_;
};

/// Bodies under forces. The state contains all positions, then all velocities.
class Mechanics {
 public:
  void add(Force* force) { forces_.emplace_back(force); }
  void hold(int i) { held_.push_back(i); }
  std::vector<Vector3f> derivative(const std::vector<Vector3f>& state) const;

 private:
  std::vector<std::unique_ptr<Force>> forces_;
  std::vector<int> held_;
};

#endif
