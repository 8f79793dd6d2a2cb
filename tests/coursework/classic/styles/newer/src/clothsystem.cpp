#include "clothsystem.h"

#include <cstdlib>

#include "gl.h"
#include "vertexrecorder.h"

static const int W = 10, H = 12;
static const float D = 0.2f, M = 0.05f;

static int at(int x, int y) { return 2 * (y * W + x); }

ClothSystem::ClothSystem() {
  for (int y = 0; y < H; ++y)
    for (int x = 0; x < W; ++x) {
      m_vVecState.emplace_back(x * D, 0.0f, y * D);
      m_vVecState.emplace_back(0.0f);
    }
}

std::vector<Vector3f> ClothSystem::evalF(std::vector<Vector3f> state) {
  struct { int dx, dy; float k; } const kinds[] = {{1, 0, 80}, {0, 1, 80}, {1, 1, 50}, {1, -1, 50}, {2, 0, 30}, {0, 2, 30}};
  std::vector<Vector3f> f(state.size());
  for (int y = 0; y < H; ++y)
    for (int x = 0; x < W; ++x) {
      if (y == 0) continue;  // the whole upper edge is fixed
      Vector3f force = M * Vector3f(0, -1, 0) - 0.02f * state[at(x, y) + 1];
      if (wind) force += Vector3f(0, 0, float(rand()) / RAND_MAX);
      for (const auto& kind : kinds)
        for (int way = -1; way <= 1; way += 2) {
          const int u = x + way * kind.dx, v = y + way * kind.dy;
          if (u < 0 || v < 0 || u >= W || v >= H) continue;
          const Vector3f d = state[at(x, y)] - state[at(u, v)];
          const float rest = D * sqrtf(kind.dx * kind.dx + kind.dy * kind.dy);
          force -= kind.k * (d.abs() - rest) * d.normalized();
        }
      f[at(x, y)] = state[at(x, y) + 1];
      f[at(x, y) + 1] = force / M;
    }
  return f;
}

void ClothSystem::draw(GLProgram& gl) {
  gl.disableLighting();
  gl.updateModelMatrix(Matrix4f::identity());
  VertexRecorder rec;
  for (int y = 0; y < H; ++y)
    for (int x = 0; x + 1 < W; ++x) {
      rec.record_poscolor(m_vVecState[at(x, y)], Vector3f(1, 0, 0));
      rec.record_poscolor(m_vVecState[at(x + 1, y)], Vector3f(1, 0, 0));
    }
  glLineWidth(3.0f);
  rec.draw(GL_LINES);
  gl.enableLighting();
}
