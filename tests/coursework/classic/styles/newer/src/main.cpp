#include <nanogui/nanogui.h>  // not there: this file does not compile here, and nothing is lost by it

int main() { return 0; }
