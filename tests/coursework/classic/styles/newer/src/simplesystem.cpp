#include "simplesystem.h"

#include "gl.h"
#include "starter3_util.h"

SimpleSystem::SimpleSystem() { m_vVecState = {Vector3f::RIGHT}; }

std::vector<Vector3f> SimpleSystem::evalF(std::vector<Vector3f> state) {
  // turns each vector by 90 degrees about z, and removes its z component
  for (auto& s : state) s = Vector3f::cross(Vector3f(0, 0, 1), s);
  return state;
}

void SimpleSystem::draw(GLProgram& gl) {
  gl.updateModelMatrix(Matrix4f::translation(m_vVecState[0]));
  drawSphere(0.075f, 10, 10);
}
