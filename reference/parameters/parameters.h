// Conversion of a scene's stiffness, damping and masses to another engine's numbers and back, and the accuracy lost.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/scene/scene.h"
#include "reference/method.h"

namespace crosscheck {

/// Quantities in conversion order: a stiffness may depend on masses and drag.
enum class SceneNumber { mass, drag, stiffness, dashpot, gravity, friction };
std::string_view name_of(SceneNumber quantity);    // "spring stiffness k"
std::string_view unit_of(SceneNumber quantity);    // the scene's unit: "N/m"
std::string_view holder_of(SceneNumber quantity);  // the object that has the number: "spring"

/// The scene's values: one per free particle, spring, dashpot or sphere; one for a uniform drag rate gamma = c / m
/// (1/s), and for the magnitude of gravity. Empty if there are none.
std::vector<double> values_of(const Scene& scene, SceneNumber quantity);

/// Quantities besides the number itself on which a formula may depend.
struct NumberContext {
  double h;       // s, step
  int n;          // iterations or sub-steps per step
  double gamma;   // 1/s, if drag is uniform
  double mu;      // kg, reduced mass of a spring's or dashpot's ends; infinite between two pins
  int particles;  // including pins
  double k = 0;   // N/m, spring parallel to a dashpot
};

struct NumberRule {
  /// Ways to represent the numbers of many springs or particles in the engine: one number each; a common number, if all
  /// are equal; the number of the median spring; or the number of the mean particle.
  enum class Gather { each, same, median, mean };

  SceneNumber quantity;
  std::string_view name, unit;  // as in the engine and in files of its numbers
  std::string_view formula, inverse;
  std::string_view holds;                                // range of validity
  double (*to)(double, const NumberContext&) = nullptr;  // null: the engine has no such number
  double (*from)(double, const NumberContext&) = nullptr;
  Gather gather = Gather::each;
  std::string_view expected = {};   // description of valid numbers
  bool (*valid)(double) = nullptr;  // null: any finite number >= 0
  /// Factor by which converting back amplifies a relative error of the engine's number; null: 1.
  double (*condition)(double, const NumberContext&) = nullptr;
  bool one_by_one = false;  // the engine solves springs in turn, so in a network the rule holds for short steps only
};

/// Largest k h^2 / mu (dimensionless) at which a network whose springs are solved one after another has the requested
/// stiffness to 1 %. The sag of a chain of three is too large by 0.25 to 0.32 times k h^2 / mu, and that of a cloth by
/// 0.27 times this value (experiment `stiffness`).
inline constexpr double sequential_limit = 0.03;

/// An engine's numbers: a row of the table.
struct EngineNumbers {
  std::string_view name = {};        // of an engine that is no method here, e.g. "jolt"; empty: methods' names apply
  std::string_view title = {};       // for display
  std::string_view iterations = {};  // the engine's name for iterations; empty: not adjustable
  int usual_iterations = 1;
  bool sub_steps = false;               // the iterations divide the step
  bool single_precision = false;        // stores its numbers in single precision
  bool (*of)(const Method&) = nullptr;  // true for methods that read scenes in this way; null: none does
  std::string_view deaf = {};           // an option with which the method ignores the scene's stiffness
  std::string_view stand_in = {};       // a method here with the same rule, if the engine itself cannot run
  std::string_view source = {};         // origin of the formulas
  std::vector<NumberRule> rules = {};
};
std::span<const EngineNumbers> engine_numbers();

struct TranslationTarget {
  std::string name;  // "bullet/pbd+n=4", "jolt+n=10"
  const EngineNumbers* numbers;
  int iterations;
  bool iterations_given;  // false: the usual iterations
  bool single_precision;
  std::optional<Method> runs = {};  // method that can run the translated scene
  bool stand_in = false;            // `runs` follows the engine's rule, but is not the engine
};
/// Finds a target by the name of a method, or of an engine in the table, optionally with "+n=N". `iterations` is 0, or
/// repeats N. Throws InputError that lists the known targets.
TranslationTarget find_target(const std::string& name, int iterations);

struct TranslatedNumber {
  const NumberRule* rule;
  std::vector<double> scene;   // the scene's values
  std::vector<double> engine;  // one per scene value, or one for all
  std::vector<double> back;    // `engine` converted back, one per scene value
  double stated = 0;           // largest relative error of `back`, due to rounding or to one number for many
  std::string here = {};       // statement whether this scene is within the rule's range of validity
};

struct Translation {
  TranslationTarget target;
  double h = 0;  // s
  std::vector<TranslatedNumber> numbers;
  std::vector<std::string> lost;  // terms without an equivalent in the engine, one sentence each
  Scene back;                     // the scene that the engine's numbers represent
};

/// Translates at a step of h (s). Throws Unsupported with the reason if the engine has no equivalent for a number of
/// the scene.
Translation translate(const Scene& scene, const TranslationTarget& target, double h);

struct NumbersFile {
  double h = 0;  // s
  int iterations = 1;
  std::vector<std::pair<const NumberRule*, std::vector<double>>> numbers;
};

/// The scene with the values that the engine's numbers represent; all other values stay unchanged.
Scene scene_of(const Scene& scene, const EngineNumbers& engine, const NumbersFile& numbers);
/// Largest relative rounding error among the values of such a changed scene.
double rounding_of(const Scene& changed, const TranslationTarget& target, const NumbersFile& numbers);

/// The translation as TOML: method, step, iterations, and each number under the engine's name, one for all or a list in
/// the scene's order.
std::string numbers_toml(const Scene& scene, const Translation& translation);
/// Reads a file of numbers. A nonzero step (s) and explicit iterations of the target override those in the file. Throws
/// InputError: "FILE:LINE: KEY: expected ...".
NumbersFile read_numbers(const std::string& text, const std::string& file, const Scene& scene,
                         const TranslationTarget& target, double step);

/// The source scene's file with the numbers of a scene derived from it. Throws InputError if a file cannot represent
/// them, e.g. because all springs of a grid family must have the same stiffness. `within`: relative difference
/// attributed to rounding.
std::string scene_toml(const Scene& source, const Scene& changed, double within);

}  // namespace crosscheck
