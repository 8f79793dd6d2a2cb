#include <nanogui/nanogui.h>  // missing here, so this file does not compile, which costs no points

int main() { return 0; }
