// The GLSL text of all materials; #define chooses between them, since software GL pays for every branch it is shown.
#pragma once

#include <string>

namespace crosscheck::render {

// one of CLOTH, SPHERE, ROD, TRAIL (a rod without light), GROUND, SUM (adds one pass to the sum)
// SHADOW: depth only; FAST: filtered shadows in one pass, else one light sample per pass; VALUES: cloth coloured by
// value
std::string vertex_text();
std::string fragment_text();

}  // namespace crosscheck::render
