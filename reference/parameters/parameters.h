// What stiffness, damping and masses of a scene are called in another engine: the numbers, their way back, and how much
// of them is lost on it. The table of engines is in engines.cpp; Bullet's formulas are those of its worlds
// (bullet/parameters.h).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/scene/scene.h"
#include "reference/method.h"

namespace crosscheck {

/// The numbers of a scene, in the order in which they are read back: a stiffness may hang on masses and drag.
enum class SceneNumber { mass, drag, stiffness, dashpot, gravity, friction };
std::string_view name_of(SceneNumber quantity);    // "spring stiffness k"
std::string_view unit_of(SceneNumber quantity);    // of the scene: "N/m"
std::string_view holder_of(SceneNumber quantity);  // what has one: "spring"

/// The numbers of the scene: of each free particle, spring, dashpot or sphere; one of a drag rate gamma = c / m (1/s)
/// that is the same everywhere, and of the size of gravity. Empty where the scene has none.
std::vector<double> values_of(const Scene& scene, SceneNumber quantity);

/// What a formula may depend on beside the number itself.
struct NumberContext {
  double h;       // s, the step
  int n;          // iterations or sub-steps in it
  double gamma;   // 1/s, of a drag that is the same everywhere
  double mu;      // kg, reduced mass of the ends of a spring or dashpot; infinite between two pins
  int particles;  // pins among them
  double k = 0;   // N/m, of the spring beside a dashpot
};

struct NumberRule {
  /// How the numbers of many springs or particles become the engine's: one for each; one, which must be the same for
  /// all; one, that of the middle spring or of the mean particle.
  enum class Gather { each, same, median, mean };

  SceneNumber quantity;
  std::string_view name, unit;  // in the engine and in files of its numbers
  std::string_view formula, inverse;
  std::string_view holds;                                // where
  double (*to)(double, const NumberContext&) = nullptr;  // null: the engine has nothing of the kind
  double (*from)(double, const NumberContext&) = nullptr;
  Gather gather = Gather::each;
  std::string_view expected = {};   // of the engine's number
  bool (*valid)(double) = nullptr;  // null: any finite number that is not below zero
  /// How many times larger a relative error of the engine's number is in the scene's; null: 1.
  double (*condition)(double, const NumberContext&) = nullptr;
  bool one_by_one = false;  // springs are solved one after the other: in a net it holds for short steps
};

/// k h^2 / mu (1) up to which a net whose springs are solved one after the other is as stiff as asked, to 1 %: the sag
/// of a chain of three is too large by 0.25 to 0.32 times that number, of a cloth by 0.27 (experiment `stiffness`).
inline constexpr double sequential_limit = 0.03;

/// An engine's numbers: a row of the table.
struct EngineNumbers {
  std::string_view name = {};        // of one that is no method here, "jolt"; empty: its methods' names
  std::string_view title = {};       // for people
  std::string_view iterations = {};  // its name for them; empty: it has none to choose
  int usual_iterations = 1;
  bool sub_steps = false;               // they divide the step
  bool single_precision = false;        // holds its numbers so
  bool (*of)(const Method&) = nullptr;  // whether it is how a method takes a scene; null: of no method
  std::string_view deaf = {};           // an option with which the method takes no stiffness from the scene
  std::string_view stand_in = {};  // the method that follows the same rule here, where the engine itself cannot run
  std::string_view source = {};    // where its formulas were read
  std::vector<NumberRule> rules = {};
};
std::span<const EngineNumbers> engine_numbers();

/// The engine that a scene is translated for.
struct TranslationTarget {
  std::string name;  // "bullet/pbd+n=4", "jolt+n=10"
  const EngineNumbers* numbers;
  int iterations;
  bool iterations_given;  // and not the usual ones
  bool single_precision;
  std::optional<Method> runs = {};  // the method that can run the translated scene here
  bool stand_in = false;            // it follows the engine's rule, but is not the engine
};
/// By the name of a method, or of an engine of the table, with "+n=N"; iterations: 0, or what +n says otherwise. Throws
/// InputError that says what is known.
TranslationTarget find_target(const std::string& name, int iterations);

struct TranslatedNumber {
  const NumberRule* rule;
  std::vector<double> scene;   // the scene's
  std::vector<double> engine;  // as many, or one for all
  std::vector<double> back;    // what the engine's mean in the scene, as many as the scene's
  double stated = 0;           // largest relative error of the way there and back: rounding, or one number for many
  std::string here = {};       // whether this scene is inside the range in which the rule holds
};

struct Translation {
  TranslationTarget target;
  double h = 0;  // s
  std::vector<TranslatedNumber> numbers;
  std::vector<std::string> lost;  // what the engine has nothing for, one sentence each
  Scene back;                     // the scene that the engine's numbers stand for
};

/// At a step of h (s). Throws Unsupported, with the reason, where the engine has no number for what the scene has.
Translation translate(const Scene& scene, const TranslationTarget& target, double h);

/// Numbers of an engine for a scene, as a file holds them.
struct NumbersFile {
  double h = 0;  // s
  int iterations = 1;
  std::vector<std::pair<const NumberRule*, std::vector<double>>> numbers;
};

/// The scene with what the engine's numbers stand for; what they leave out stays as it is.
Scene scene_of(const Scene& scene, const EngineNumbers& engine, const NumbersFile& numbers);
/// The largest relative error that rounding leaves in the numbers of that scene.
double rounding_of(const Scene& changed, const TranslationTarget& target, const NumbersFile& numbers);

/// As TOML: method, step, iterations, and each number under the engine's name, one for all or a list in the scene's
/// order.
std::string numbers_toml(const Scene& scene, const Translation& translation);
/// Reads them. A step (s) that is not 0, and iterations that the target was given, stand in for those of the file.
/// Throws InputError: "FILE:LINE: KEY: expected ...".
NumbersFile read_numbers(const std::string& text, const std::string& file, const Scene& scene,
                         const TranslationTarget& target, double step);

/// The file of the scene with the numbers of another that was made of it. Throws InputError where a file of its kind
/// cannot hold them: springs of a family of a grid have one stiffness, `within` being what may be rounding.
std::string scene_toml(const Scene& source, const Scene& changed, double within);

}  // namespace crosscheck
