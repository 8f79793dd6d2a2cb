// The base class of all systems in the newer version of the course, for submissions without this header.
#ifndef PARTICLESYSTEM_H
#define PARTICLESYSTEM_H

#include <vecmath.h>

#include <vector>

struct GLProgram;

class ParticleSystem {
 public:
  virtual ~ParticleSystem() {}

  /// The derivative of `state`: X' = f(X).
  virtual std::vector<Vector3f> evalF(std::vector<Vector3f> state) = 0;

  std::vector<Vector3f> getState() { return m_vVecState; }
  void setState(const std::vector<Vector3f>& newState) { m_vVecState = newState; }

  virtual void draw(GLProgram& gl) = 0;

 protected:
  std::vector<Vector3f> m_vVecState;
};

#endif
