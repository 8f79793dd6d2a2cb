// GLFW that opens no window and never calls a callback.
#pragma once

#include "../GL/gl.h"

struct GLFWwindow {};
struct GLFWmonitor {};
template <class... A>
inline GLFWwindow* glfwCreateWindow(A&&...) {
  return nullptr;
}
inline double glfwGetTime() { return 0.0; }

CLASSIC_NOTHING(glfwCreateStandardCursor)
CLASSIC_NOTHING(glfwDestroyWindow)
CLASSIC_NOTHING(glfwGetCursorPos)
CLASSIC_NOTHING(glfwGetFramebufferSize)
CLASSIC_NOTHING(glfwGetKey)
CLASSIC_NOTHING(glfwGetMouseButton)
CLASSIC_NOTHING(glfwGetWindowSize)
CLASSIC_NOTHING(glfwInit)
CLASSIC_NOTHING(glfwMakeContextCurrent)
CLASSIC_NOTHING(glfwPollEvents)
CLASSIC_NOTHING(glfwSetCharCallback)
CLASSIC_NOTHING(glfwSetCursorPosCallback)
CLASSIC_NOTHING(glfwSetErrorCallback)
CLASSIC_NOTHING(glfwSetFramebufferSizeCallback)
CLASSIC_NOTHING(glfwSetKeyCallback)
CLASSIC_NOTHING(glfwSetMouseButtonCallback)
CLASSIC_NOTHING(glfwSetScrollCallback)
CLASSIC_NOTHING(glfwSetTime)
CLASSIC_NOTHING(glfwSetWindowShouldClose)
CLASSIC_NOTHING(glfwSetWindowSizeCallback)
CLASSIC_NOTHING(glfwSetWindowTitle)
CLASSIC_NOTHING(glfwSwapBuffers)
CLASSIC_NOTHING(glfwSwapInterval)
CLASSIC_NOTHING(glfwTerminate)
CLASSIC_NOTHING(glfwWaitEvents)
CLASSIC_NOTHING(glfwWindowHint)
CLASSIC_NOTHING(glfwWindowShouldClose)

#define GLFW_RELEASE 0
#define GLFW_PRESS 1
#define GLFW_REPEAT 2
#define GLFW_MOUSE_BUTTON_LEFT 0
#define GLFW_MOUSE_BUTTON_RIGHT 1
#define GLFW_MOUSE_BUTTON_MIDDLE 2
#define GLFW_KEY_A 65
#define GLFW_KEY_B 66
#define GLFW_KEY_C 67
#define GLFW_KEY_D 68
#define GLFW_KEY_E 69
#define GLFW_KEY_F 70
#define GLFW_KEY_G 71
#define GLFW_KEY_H 72
#define GLFW_KEY_I 73
#define GLFW_KEY_J 74
#define GLFW_KEY_K 75
#define GLFW_KEY_L 76
#define GLFW_KEY_M 77
#define GLFW_KEY_N 78
#define GLFW_KEY_O 79
#define GLFW_KEY_P 80
#define GLFW_KEY_Q 81
#define GLFW_KEY_R 82
#define GLFW_KEY_S 83
#define GLFW_KEY_T 84
#define GLFW_KEY_U 85
#define GLFW_KEY_V 86
#define GLFW_KEY_W 87
#define GLFW_KEY_X 88
#define GLFW_KEY_Y 89
#define GLFW_KEY_Z 90
#define GLFW_KEY_ESCAPE 256
#define GLFW_KEY_ENTER 257
#define GLFW_KEY_TAB 258
#define GLFW_KEY_BACKSPACE 259
#define GLFW_KEY_RIGHT 260
#define GLFW_KEY_LEFT 261
#define GLFW_KEY_DOWN 262
#define GLFW_KEY_UP 263
#define GLFW_KEY_SPACE 32
#define GLFW_MOD_SHIFT 1
#define GLFW_MOD_CONTROL 2
#define GLFW_MOD_ALT 4
#define GLFW_MOD_SUPER 8
#define GLFW_CONTEXT_VERSION_MAJOR 262144
#define GLFW_CONTEXT_VERSION_MINOR 262145
#define GLFW_OPENGL_PROFILE 262146
#define GLFW_OPENGL_CORE_PROFILE 262147
#define GLFW_OPENGL_FORWARD_COMPAT 262148
#define GLFW_OPENGL_DEBUG_CONTEXT 262149
#define GLFW_SAMPLES 262150
#define GLFW_RESIZABLE 262151
#define GLFW_VISIBLE 262152
