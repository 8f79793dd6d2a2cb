// GLUT that opens no window and never calls a callback.
#pragma once

// included by the real header too, and submissions rely on that
#include <stdlib.h>

#include "gl.h"
#include "glu.h"

CLASSIC_NOTHING(glutAddMenuEntry)
CLASSIC_NOTHING(glutAddSubMenu)
CLASSIC_NOTHING(glutAttachMenu)
CLASSIC_NOTHING(glutBitmapCharacter)
CLASSIC_NOTHING(glutBitmapString)
CLASSIC_NOTHING(glutBitmapWidth)
CLASSIC_NOTHING(glutCreateMenu)
CLASSIC_NOTHING(glutCreateWindow)
CLASSIC_NOTHING(glutDestroyWindow)
CLASSIC_NOTHING(glutDetachMenu)
CLASSIC_NOTHING(glutDisplayFunc)
CLASSIC_NOTHING(glutFullScreen)
CLASSIC_NOTHING(glutGet)
CLASSIC_NOTHING(glutGetModifiers)
CLASSIC_NOTHING(glutIdleFunc)
CLASSIC_NOTHING(glutIgnoreKeyRepeat)
CLASSIC_NOTHING(glutInit)
CLASSIC_NOTHING(glutInitDisplayMode)
CLASSIC_NOTHING(glutInitWindowPosition)
CLASSIC_NOTHING(glutInitWindowSize)
CLASSIC_NOTHING(glutKeyboardFunc)
CLASSIC_NOTHING(glutKeyboardUpFunc)
CLASSIC_NOTHING(glutLeaveMainLoop)
CLASSIC_NOTHING(glutMainLoop)
CLASSIC_NOTHING(glutMainLoopEvent)
CLASSIC_NOTHING(glutMotionFunc)
CLASSIC_NOTHING(glutMouseFunc)
CLASSIC_NOTHING(glutMouseWheelFunc)
CLASSIC_NOTHING(glutPassiveMotionFunc)
CLASSIC_NOTHING(glutPostRedisplay)
CLASSIC_NOTHING(glutReshapeFunc)
CLASSIC_NOTHING(glutReshapeWindow)
CLASSIC_NOTHING(glutSetCursor)
CLASSIC_NOTHING(glutSetMenu)
CLASSIC_NOTHING(glutSetOption)
CLASSIC_NOTHING(glutSetWindow)
CLASSIC_NOTHING(glutSetWindowTitle)
CLASSIC_NOTHING(glutSolidCone)
CLASSIC_NOTHING(glutSolidCube)
CLASSIC_NOTHING(glutSolidSphere)
CLASSIC_NOTHING(glutSolidTeapot)
CLASSIC_NOTHING(glutSolidTorus)
CLASSIC_NOTHING(glutSpecialFunc)
CLASSIC_NOTHING(glutSpecialUpFunc)
CLASSIC_NOTHING(glutStrokeCharacter)
CLASSIC_NOTHING(glutSwapBuffers)
CLASSIC_NOTHING(glutTimerFunc)
CLASSIC_NOTHING(glutVisibilityFunc)
CLASSIC_NOTHING(glutWarpPointer)
CLASSIC_NOTHING(glutWireCone)
CLASSIC_NOTHING(glutWireCube)
CLASSIC_NOTHING(glutWireSphere)
CLASSIC_NOTHING(glutWireTeapot)
CLASSIC_NOTHING(glutWireTorus)

#define GLUT_RGB 0
#define GLUT_RGBA 0
#define GLUT_SINGLE 0
#define GLUT_DOUBLE 2
#define GLUT_ALPHA 8
#define GLUT_DEPTH 16
#define GLUT_STENCIL 32
#define GLUT_MULTISAMPLE 128
#define GLUT_DOWN 0
#define GLUT_UP 1
#define GLUT_LEFT_BUTTON 0
#define GLUT_MIDDLE_BUTTON 1
#define GLUT_RIGHT_BUTTON 2
#define GLUT_ACTIVE_SHIFT 1
#define GLUT_ACTIVE_CTRL 2
#define GLUT_ACTIVE_ALT 4
#define GLUT_KEY_LEFT 100
#define GLUT_KEY_UP 101
#define GLUT_KEY_RIGHT 102
#define GLUT_KEY_DOWN 103
#define GLUT_KEY_PAGE_UP 104
#define GLUT_KEY_PAGE_DOWN 105
#define GLUT_KEY_HOME 106
#define GLUT_KEY_END 107
#define GLUT_KEY_INSERT 108
#define GLUT_KEY_F1 109
#define GLUT_KEY_F2 110
#define GLUT_KEY_F3 111
#define GLUT_KEY_F4 112
#define GLUT_KEY_F5 113
#define GLUT_ELAPSED_TIME 196608
#define GLUT_WINDOW_WIDTH 196609
#define GLUT_WINDOW_HEIGHT 196610
#define GLUT_SCREEN_WIDTH 196611
#define GLUT_SCREEN_HEIGHT 196612
#define GLUT_ACTION_ON_WINDOW_CLOSE 196613
#define GLUT_ACTION_CONTINUE_EXECUTION 196614
#define GLUT_ACTION_GLUTMAINLOOP_RETURNS 196615
#define GLUT_CURSOR_NONE 196616
#define GLUT_CURSOR_INHERIT 196617
#define GLUT_BITMAP_8_BY_13 nullptr
#define GLUT_BITMAP_9_BY_15 nullptr
#define GLUT_BITMAP_TIMES_ROMAN_10 nullptr
#define GLUT_BITMAP_TIMES_ROMAN_24 nullptr
#define GLUT_BITMAP_HELVETICA_10 nullptr
#define GLUT_BITMAP_HELVETICA_12 nullptr
#define GLUT_BITMAP_HELVETICA_18 nullptr
