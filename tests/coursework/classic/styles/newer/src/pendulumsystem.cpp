#include "pendulumsystem.h"

#include "gl.h"

static const int count = 5;

PendulumSystem::PendulumSystem() {
  for (int i = 0; i < count; ++i) m_vVecState.insert(m_vVecState.end(), {Vector3f(0.3f * i, 2 - 0.1f * i, 0), 0.0f});
}

std::vector<Vector3f> PendulumSystem::evalF(std::vector<Vector3f> state) {
  // the last particle is fixed; masses are 1, so forces equal accelerations
  const float k = 250, rest = 0.25f;
  std::vector<Vector3f> f(state.size(), Vector3f::ZERO);
  const auto spring = [&](int to, int from) {
    const Vector3f d = state[2 * to] - state[2 * from];
    return -k * (d.abs() - rest) * d / d.abs();
  };
  for (int i = 0; i < count - 1; ++i) {
    f[2 * i] = state[2 * i + 1];
    f[2 * i + 1] = -4.9f * Vector3f::UP - 0.05f * state[2 * i + 1] + spring(i, i + 1);
    if (i > 0) f[2 * i + 1] += spring(i, i - 1);
  }
  return f;
}

void PendulumSystem::draw(GLProgram& gl) {
  for (int i = 0; i < count; ++i) {
    gl.updateModelMatrix(Matrix4f::translation(m_vVecState[2 * i]));
    drawSphere(0.075f, 10, 10);
  }
}
