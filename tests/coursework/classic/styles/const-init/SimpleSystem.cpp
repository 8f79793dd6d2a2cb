#include "simplesystem.h"
#ifdef __APPLE__
#include <GLUT/glut.h>
#else
#include "GL/freeglut.h"
#endif

void SimpleSystem::draw() const
{
    glutWireSphere(0.05, 8, 8);
}
