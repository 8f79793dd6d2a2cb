// Jolt's soft body among balls, told in plain numbers: what includes Jolt is compiled with Jolt's instructions (AVX2 as
// a rule), under which Eigen lays out memory otherwise, so that neither Eigen nor the rest of crosscheck meets it.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace crosscheck::jolt {

using Triple = std::array<double, 3>;

struct Vertex {
  Triple x, v;          // m in the scene's frame, m/s
  double inverse_mass;  // 1/kg; 0 where held
};
struct Edge {
  int a, b;
  double rest;        // m
  double compliance;  // m/N
};
struct Ball {
  Triple centre;  // m
  double radius;  // m, at which vertices touch
  double friction, restitution;
};
struct Settings {
  Triple origin = {};  // m: of the body's frame, in which places are rounded to single precision
  int iterations = 1;  // sub-steps of a step
  double damping = 0;  // 1/s
};

/// Memory, types and factory of Jolt, which belong to a program: to be made once, before all bodies.
class Library {
 public:
  Library();
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

/// The version of the headers and how they were compiled: "5.5.1, single precision, ... (AVX2 ...)".
std::string version();

/// One body in a world of its own. Throws std::runtime_error where Jolt does not make it, or says that a step failed.
class SoftBody {
 public:
  SoftBody(const std::vector<Vertex>& vertices, const std::vector<Edge>& edges, const std::vector<Ball>& balls,
           const Settings& settings);
  ~SoftBody();

  void set_gravity(const Triple& acceleration);  // m/s^2
  void step(double h);                           // s
  /// 3 numbers for each vertex: m in the scene's frame, m/s.
  void read(double* x, double* v) const;
  void place(int vertex, const Triple& x);         // m in the scene's frame
  void set_velocity(int vertex, const Triple& v);  // m/s
  Triple moved(int vertex) const;                  // m, in the body's frame, unrounded by its origin

  // what Jolt's objects hold
  double inverse_mass(int vertex) const;
  std::vector<Edge> edges_like(const std::vector<Edge>& given) const;  // in the order given: Jolt changes it
  Triple gravity() const;
  std::vector<Ball> balls() const;
  Settings settings() const;
  bool may_sleep() const;
  double largest_speed() const;  // m/s

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace crosscheck::jolt
