#include "ClothSystem.h"

ClothSystem::ClothSystem(int width, int height, float spacing) : ParticleSystem(width * height) {
  mechanics.add(new Weight(Vector3f(0, -1, 0)));
  mechanics.add(new Viscosity(1));
  for (int i = 0; i < width * height; ++i) {
    const int x = i % width, y = i / width;
    m_vVecState.push_back(spacing * Vector3f(x, 0.2f * (x % 2), y));
    for (int j = 0; j < i; ++j) {
      const int dx = x - j % width, dy = y - j / width, far = dx * dx + dy * dy;
      if (far > 2 && far != 4) continue;
      mechanics.add(new Hooke(i, j, far == 1 ? 300 : 200, spacing * std::sqrt(float(far))));
    }
  }
  m_vVecState.resize(2 * m_vVecState.size(), Vector3f(0));
  mechanics.hold(0);
  mechanics.hold(width - 1);
}
