#include <GL/glut.h>

#include "system.h"

int wind = 1;
int windDirection() { return wind; }

int main(int argc, char** argv) {
  glutInit(&argc, argv);
  TimeStepper* stepper = new RK4;
  ParticleSystem* system = new ClothSystem(100);
  stepper->takeStep(system, 0.01f);
  glutMainLoop();
}
