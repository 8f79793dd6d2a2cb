// The tests of a2-pendulum: closed forms, and forces as gradients of one energy (energy.h).
#include "tests/coursework/a2-pendulum/chain_cases.h"
#include "tests/coursework/a2-pendulum/force_cases.h"
#include "tests/coursework/a2-pendulum/pendulum_cases.h"
#include "tests/coursework/a2-pendulum/symplectic_cases.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {
namespace {

using namespace a2;

const std::vector<Test>& table() {
  using Tags = std::vector<std::string_view>;
  static const Tags gravity{"gravity"}, drag{"drag"}, spring{"spring"}, law{"third law", "energy"}, limits{"limits"},
      forces{"forces"}, mass{"mass"}, pure{"pure functions"}, fixed{"fixed particle"}, energy{"energy"}, chain{"chain"},
      size{"systems of any size"}, rest{"equilibrium"}, modes{"normal modes"}, step{"one step"}, fall{"free fall"},
      bounded{"stability", "energy"}, cost{"stages", "cost"};
  static const std::vector<Test> tests{
      {"1.1", "gravity_drag", 4, 2, gravity, "Gravity", gravity_cases},
      {"1.2", "gravity_drag", 4, 2, drag, "Drag", drag_cases},
      {"2.1", "spring", 4, 2, spring, "A spring", straight_spring_cases},
      {"2.2", "spring", 5, 2, law, "A spring is the slope of an energy", spring_cases},
      {"2.3", "spring", 4, 2, limits, "Three springs that are easily forgotten", special_spring_cases},
      {"3.1", "pendulum", 3, 1, forces, "The pendulum", single_force_cases},
      {"3.2", "pendulum", 4, 2, forces, "The pendulum", all_forces_cases},
      {"3.3", "pendulum", 3, 1, mass, "Forces and accelerations", mass_cases},
      {"3.4", "pendulum", 3, 1, pure, "The state that is given", pendulum_twice_cases},
      {"3.5", "pendulum", 3, 1, fixed, "The fixed particle", pendulum_fixed_cases},
      {"3.6", "pendulum", 3, 1, energy, "A swing keeps its energy", swing_cases, path_and_energy},
      {"4.1", "chain", 3, 1, chain, "The chain", four_cases, nullptr, small_chain_cases},
      {"4.2", "chain", 3, 1, size, "The chain", length_cases, nullptr, small_chain_cases},
      {"4.3", "chain", 3, 1, law, "What springs cannot do", third_law_cases, total_force_and_moment},
      {"4.4", "chain", 3, 1, rest, "A chain at rest", hanging_cases},
      {"4.5", "chain", 3, 1, modes, "Normal modes", mode_cases},
      {"4.6", "chain", 2, 1, pure, "The state that is given", chain_twice_cases},
      {"4.7", "chain", 2, 1, fixed, "The fixed particle", chain_fixed_cases},
      {"5.1", "symplectic", 4, 1, step, "Symplectic Euler", one_step_cases},
      {"5.2", "symplectic", 3, 1, fall, "Free fall", fall_cases},
      {"5.3", "symplectic", 3, 1, bounded, "Why it stays", oscillator_cases},
      {"5.4", "symplectic", 3, 1, cost, "Symplectic Euler", evaluation_cases},
  };
  return tests;
}

constexpr Part parts[] = {{"gravity_drag", "gravity_drag.title", "gravity_force,drag_force"},
                          {"spring", "spring.title", "spring_force"},
                          {"pendulum", "pendulum.title", "pendulum_derivative"},
                          {"chain", "chain.title", "chain_derivative"},
                          {"symplectic", "symplectic.title", "symplectic_step"}};

}  // namespace

const Assignment& a2_pendulum() {
  static const Assignment assignment{"a2-pendulum", "Pendulum and chain", parts, table()};
  return assignment;
}

}  // namespace coursework
