#include "ClothSystem.h"
#include <OpenGL/gl.h>

ClothSystem::ClothSystem(int size) : side(size)
{
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            add(x, y, 1, 0, 5000), add(x, y, 0, 1, 5000);
            add(x, y, 1, 1, 1200), add(x, y, -1, 1, 1200);
            add(x, y, 2, 0, 2400), add(x, y, 0, 2, 2400);
        }
}

void ClothSystem::add(int x, int y, int dx, int dy, float k)
{
    if (x + dx < 0 || x + dx >= side || y + dy >= side) return;
    Spring s = { y * side + x, (y + dy) * side + x + dx, k, sqrt(float(dx * dx + dy * dy)) * 0.3f };
    springs.push_back(s);
}

void ClothSystem::initState()
{
    state.clear();
    for (int i = 0; i < side * side; i++) {
        state.push_back(Vector3f(0.3f * (i % side), 3, 0.3f * (i / side)));
        state.push_back(0);
    }
}

vector<Vector3f> ClothSystem::evalF(const vector<Vector3f>& state) const
{
    vector<Vector3f> f(state.size());
    int n = side * side;
    for (int i = 0; i < n; i++) {
        f[2 * i] = state[2 * i + 1];
        f[2 * i + 1] = Vector3f(0, -2, 0) - 5 * state[2 * i + 1];
    }
    for (size_t s = 0; s < springs.size(); s++) {
        Vector3f d = state[2 * springs[s].i] - state[2 * springs[s].j];
        Vector3f pull = springs[s].k * (1 - springs[s].r / d.abs()) * d;
        f[2 * springs[s].i + 1] -= pull;
        f[2 * springs[s].j + 1] += pull;
    }
    // fixes four particles of the first row, like a curtain
    for (int x = 0; x < side; x++)
        if (x == 0 || x == side - 1 || x == side / 2 || x == side - 1 - side / 2) f[2 * x] = f[2 * x + 1] = 0;
    return f;
}

void ClothSystem::draw() const
{
    glBegin(GL_TRIANGLES);
    glNormal3f(0, 1, 0);
    for (int i = 0; i < side; i++) glVertex3f(state[2 * i].x(), state[2 * i].y(), state[2 * i].z());
    glEnd();
    glWindowPos2iARB(0, 0);
    glEnable(GL_SOMETHING_RARE_NV);
}
