// The scene's spheres as Bullet's rigid bodies: fixed, or moved along as kinematic bodies.
#pragma once

#include <memory>
#include <vector>

#include "reference/bullet/scene_body.h"

namespace crosscheck::bullet {

class Obstacles {
 public:
  explicit Obstacles(const Model& model);

  /// Enters them into the world, or takes them out of it.
  void enter(btDiscreteDynamicsWorld& world);
  void leave(btDiscreteDynamicsWorld& world);
  /// Puts the moving ones where they are at time t (s). To be called before each step with the step's end: Bullet takes
  /// the speed of a kinematic body from the distance between two of its places.
  void place(double t);
  /// Where that is, m. All stands as before afterwards.
  std::vector<Vec3> centres_at(double t);

  /// What was built: places, radii, friction and restitution of the balls, and the soft body's margin.
  void read_back(const btDiscreteDynamicsWorld& world, const btSoftBody& body, Readback& readback) const;

 private:
  struct Ball {
    std::unique_ptr<btSphereShape> shape;
    std::unique_ptr<btRigidBody> body;
  };
  const Spheres* spheres_;  // null: none
  std::vector<Ball> balls_;
  std::vector<Vec3> built_;  // m, where they stood when they entered
};

/// "5 mrad on voxels of a = 10 mm": how far Bullet's normals may be off in each direction, on the scene's smallest
/// ball. Inside a voxel the gradient of the grid of distances is constant along each axis, right in the middle and off
/// by half a voxel's turn at its faces.
std::string off_normal(const Scene& scene, double voxel);

}  // namespace crosscheck::bullet
