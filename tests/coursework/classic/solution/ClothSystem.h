// A square cloth that hangs by two of its corners.
#ifndef CLOTHSYSTEM_H
#define CLOTHSYSTEM_H

#include "particleSystem.h"

class ClothSystem : public ParticleSystem {
 public:
  ClothSystem();
  vector<Vector3f> evalF(vector<Vector3f> state);
  void draw();

 private:
  struct Spring {
    int a, b;
    float k, rest;
  };
  void connect(int row, int column, int downward, int sideward, float k);
  vector<Spring> m_springs;
};

#endif
