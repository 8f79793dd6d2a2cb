#ifndef PENDULUM
#define PENDULUM
#include "ParticleSystem.h"
struct Spring { int i, j; float k, r; };

class PendulumSystem : public ParticleSystem
{
    const int n;
    vector<Spring> springs;
public:
    PendulumSystem(const int numParticles);
    vector<Vector3f> evalF(const vector<Vector3f>& state) const;
    void initState();
    void draw() const;
};
#endif
