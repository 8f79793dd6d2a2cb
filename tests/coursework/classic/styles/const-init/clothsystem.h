#ifndef CLOTH
#define CLOTH
#include "PendulumSystem.h"

class ClothSystem : public ParticleSystem
{
    int side;
    vector<Spring> springs;
    void add(int x, int y, int dx, int dy, float k);
public:
    ClothSystem(int size);
    vector<Vector3f> evalF(const vector<Vector3f>& state) const;
    void initState();
    void draw() const;
};
#endif
