#pragma once

#include <vecmath.h>

#include <vector>

struct GLProgram;

class ParticleSystem {
 public:
  virtual ~ParticleSystem() = default;
  virtual std::vector<Vector3f> evalF(std::vector<Vector3f> state) = 0;
  std::vector<Vector3f> getState() { return m_vVecState; }
  void setState(const std::vector<Vector3f>& newState) { m_vVecState = newState; }
  virtual void draw(GLProgram&) = 0;

 protected:
  std::vector<Vector3f> m_vVecState;
};
