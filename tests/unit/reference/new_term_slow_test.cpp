// A new term must be handled everywhere that all terms are listed; until then these files must not compile. The tests
// run the compiler on each original file with one more term in the list (extra_term.h).

#include <gtest/gtest.h>

#include "tests/unit/compiler.h"

namespace crosscheck::testing_tools {
namespace {

ProgramResult compiled_with_a_new_term(const std::string& file) {
  return check_syntax(CROSSCHECK_SOURCE "/" + file,
                      {"-include", CROSSCHECK_SOURCE "/tests/unit/reference/extra_term.h"});
}

/// A missing term that the compiler's error must name.
struct Place {
  std::string file, where, what;
};
const std::vector<Place> places = {
    {"mysim/model/energy.cpp", "energy_of", "Tide"},
    {"mysim/model/energy.cpp", "power_of", "Tide"},
    {"mysim/scene/scene.cpp", "Hash", "Tide"},
    {"reference/certificate/rows.cpp", "certify_terms", "Tide"},
    {"reference/truth/independent/right_hand_side.cpp", "RightHandSide::add_term", "Tide"},
    {"reference/protocol/scene_json.cpp", "add(", "Tide"},
    {"reference/protocol/scene_json.cpp", "term_readers", "std::variant_size_v<Term>"},
    {"reference/bullet/deformable.cpp", "DeformableForces", "Tide"},
    {"reference/bullet/pbd.cpp", "PbdWorld", "Tide"},
    {"reference/parameters/parameters.cpp", "values_of", "Tide"},
};

TEST(NewTerm, DoesNotCompileWhereItIsNotAnswered) {
  std::string file;
  ProgramResult end;
  for (const Place& place : places) {
    SCOPED_TRACE(place.file + ", " + place.where);
    if (place.file != file) end = compiled_with_a_new_term(file = place.file);
    EXPECT_NE(end.status, 0);
    EXPECT_NE(end.err.find(place.file), std::string::npos) << end.err;
    EXPECT_NE(end.err.find(place.where), std::string::npos) << end.err;
    EXPECT_NE(end.err.find(place.what), std::string::npos) << end.err;
  }
}

/// Conversely, the term is valid: files that use terms through their functions compile.
TEST(NewTerm, CompilesWhereTermsAreTakenByTheirFunctions) {
  for (const char* file : {"mysim/model/system.cpp", "mysim/implicit/newton.cpp"}) {
    const ProgramResult end = compiled_with_a_new_term(file);
    EXPECT_EQ(end.status, 0) << file << ": " << end.err;
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
