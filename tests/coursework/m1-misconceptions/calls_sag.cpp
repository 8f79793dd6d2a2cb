// Calls of the three functions of sag.cpp, each of which returns the sag. The last inputs are predictions of beliefs,
// which are shown but not used.
//   sag.catenary   length, span, sag of a parabola, sag of two straight lines
//   sag.parabola   length, span, sag of a catenary
//   sag.elastic    length, span, weight, stiffness, sag of an inextensible chain
#include "beliefs.h"
#include "calls.h"

namespace coursework {

bool answer_sag(const std::string& call, const Numbers& in, Numbers& out) {
  if (call == "sag.catenary") {
    calling("catenary_sag");
    out = {catenary_sag(in.at(0), in.at(1))};
  } else if (call == "sag.parabola") {
    calling("parabola_sag");
    out = {parabola_sag(in.at(0), in.at(1))};
  } else if (call == "sag.elastic") {
    calling("elastic_sag");
    out = {elastic_sag(in.at(0), in.at(1), in.at(2), in.at(3))};
  } else {
    return false;
  }
  return true;
}

}  // namespace coursework
