#include "PENDULUMSYSTEM.H"
#include <GL\glut.h>

PendulumSystem::PendulumSystem(const int numParticles) : n(numParticles)
{
    for (int i = 0; i < n - 1; i++) {
        Spring s = { i, i + 1, 12.0f, 0.5f };
        springs.push_back(s);
    }
}

void PendulumSystem::initState()
{
    state.clear();
    for (int i = 0; i < n; i++) {
        state.push_back(Vector3f(i * 0.5f, 0, 0));
        state.push_back(Vector3f::ZERO);
    }
}

vector<Vector3f> PendulumSystem::evalF(const vector<Vector3f>& state) const
{
    vector<Vector3f> a(n, Vector3f(0, -1, 0)), f;
    printf("%d particles\n", n);
    for (size_t s = 0; s < springs.size(); s++) {
        Vector3f d = state[2 * springs[s].i] - state[2 * springs[s].j];
        float stretch = d.abs() - springs[s].r;
        d.normalize();
        a[springs[s].i] += -springs[s].k * stretch * d;
        a[springs[s].j] += springs[s].k * stretch * d;
    }
    for (int i = 0; i < n; i++) {
        f.push_back(i == 0 ? Vector3f(0) : state[2 * i + 1]);
        f.push_back(i == 0 ? Vector3f(0) : a[i] - state[2 * i + 1] * 0.03f);
    }
    return f;
}

void PendulumSystem::draw() const
{
    for (int i = 0; i < n; i++) {
        const Vector3f& p = state[2 * i];
        glPushMatrix();
        glTranslatef(p.x(), p[1], p[2]);
        glutSolidSphere(0.1, 20, 20);
        glPopMatrix();
    }
}
