// A new key is one line here and one line where it is read.
#include "mysim/scene/keys.h"

namespace crosscheck {
namespace keys_of_scenes {

using enum Key::Kind;

constexpr bool required = true, optional = false;

constexpr Key time_keys[] = {
    {"duration", "a number above zero (s)", required},
    {"samples", "a whole number from 1 to 1000000, the frames after the first", required},
    {"step", "a number above zero (s), not longer than the duration", required},
    {"window", "a number above zero (s), not longer than the duration, up to which runs are compared", required},
    {"tolerance", "a number above zero (m), the largest difference that does not matter", required},
    {"method", "the name of a method in quotes, as in \"leapfrog\"", required},
};
constexpr Key stiffness_keys[] = {
    {"structural", "a number above zero (N/m)", required, value, {}, "inextensible"},
    {"shear", "a number above zero (N/m)"},
    {"bend", "a number above zero (N/m)"},
};
constexpr Key grid_keys[] = {
    {"size", "two whole numbers from 2 (cloth) or three (a block), as in [20, 20]", required},
    {"origin", "three finite numbers [x, y, z] (m)", required},
    {"u", "three finite numbers [x, y, z] (m), one whole side", required},
    {"v", "three finite numbers [x, y, z] (m), the other side", required},
    {"w", "three finite numbers [x, y, z] (m), the third side of a block"},
    {"mass", "a number above zero (kg), of the whole grid", required},
    {"stiffness", "of the springs", required, table, stiffness_keys, "inextensible"},
    {"inextensible", "\"structural\""},
    {"bending", "a number above zero (N m), the rigidity of a cloth"},
    {"dashpot", "a number above zero (N s/m)"},
};
constexpr Key particle_keys[] = {
    {"position", "three finite numbers [x, y, z] (m)", required},
    {"mass", "a number above zero (kg)", required, value, {}, "rotation"},
    {"velocity", "three finite numbers [x, y, z] (m/s)"},
};
constexpr Key spring_keys[] = {
    {"ends", "two different particles, as in [0, 1]", required},
    {"stiffness", "a number above zero (N/m)", required},
    {"rest", "a number not below zero (m)"},
    {"dashpot", "a number above zero (N s/m)"},
    {"family", "\"structural\", \"shear\" or \"bend\", as a grid's"},
};
constexpr Key constraint_keys[] = {
    {"ends", "two different particles, as in [0, 1]", required},
    {"length", "a number above zero (m)"},
};
constexpr Key law_keys[] = {
    {"law", "\"hooke\" or \"bullet-link\"", required},
};
constexpr Key motion_keys[] = {
    {"amplitude", "three finite numbers [x, y, z] (m)", required},
    {"frequency", "a number above zero (Hz)", required},
    {"ramp", "a number above zero (s)", required},
};
constexpr Key pin_keys[] = {
    {"particles", "a list of fixed particles, as in [0, 19]", required},
    {"motion", "how they are moved", optional, table, motion_keys},
};
constexpr Key start_keys[] = {
    {"positions", "a list of three numbers for each particle (m), in their order, or of triples", required},
    {"velocities", "a list of three numbers for each particle (m/s), in their order, or of triples"},
};
constexpr Key rotation_keys[] = {
    {"rate", "a finite number (rad/s)", required},
};
constexpr Key gravity_keys[] = {
    {"acceleration", "three finite numbers [x, y, z] (m/s^2), as in [0, -9.81, 0]", required},
};
constexpr Key drag_keys[] = {
    {"coefficient",
     "a number above zero (N s/m), or gamma = a number above zero (1/s) in its place",
     required,
     value,
     {},
     "gamma"},
    {"gamma", "a number above zero (1/s)"},
};
constexpr Key gust_keys[] = {
    {"variation", "a number not below zero", required},
    {"side", "three finite numbers [x, y, z], as the mean wind", required},
    {"seed", "a whole number from 1", required},
};
constexpr Key wind_keys[] = {
    {"acceleration", "three finite numbers [x, y, z] (m/s^2)", required},
    {"gusts", "how it varies", optional, table, gust_keys},
};
constexpr Key aerodynamics_keys[] = {
    {"density", "a number above zero (kg/m^3)", required},
    {"coefficient", "a number above zero", required},
    {"velocity", "three finite numbers [x, y, z] (m/s)", required},
    {"gusts", "how it varies", optional, table, gust_keys},
};
constexpr Key sphere_keys[] = {
    {"centre", "three finite numbers [x, y, z] (m)", required},
    {"radius", "a number above zero (m)", required},
    {"margin", "a number not below zero (m)"},
    {"friction", "a number not below zero"},
    {"restitution", "a number from 0 to 1"},
    {"motion", "how it moves", optional, table, motion_keys},
};
constexpr Key plane_keys[] = {
    {"point", "three finite numbers [x, y, z] (m), any point of its face", required},
    {"normal", "three finite numbers [x, y, z], the direction out of the solid", required},
    {"margin", "a number not below zero (m)"},
    {"friction", "a number not below zero"},
    {"restitution", "a number from 0 to 1"},
    {"velocity", "three finite numbers [x, y, z] (m/s)"},
};
constexpr Key camera_keys[] = {
    {"eye", "three finite numbers [x, y, z] (m)", required},
    {"target", "three finite numbers [x, y, z] (m)", required},
    {"at", "a number not below zero (s)"},
};
constexpr Key wish_keys[] = {
    {"sag", "a number above zero (m)"},
    {"period", "a number above zero (s)"},
    {"settle_time", "a number above zero (s)"},
    {"max_stretch", "a number above zero"},
    {"c11", "a number above zero (N/m of a sheet, Pa of a block)"},
    {"anisotropy", "a number above zero; 1 is isotropic"},
};
constexpr Key file_keys[] = {
    {"question", "a text in quotes: the question that the scene answers", required},
    {"parameters", "a text in quotes: how its values were chosen", required},
    {"time", "", required, table, time_keys},
    {"particle", "", required, tables, particle_keys, "grid"},
    {"grid", "", optional, table, grid_keys},
    {"spring", "", optional, tables, spring_keys},
    {"constraint", "", optional, tables, constraint_keys},
    {"springs", "", optional, table, law_keys},
    {"start", "", optional, table, start_keys},
    {"pins", "", optional, table, pin_keys},
    {"rotation", "", optional, table, rotation_keys},
    {"gravity", "", optional, table, gravity_keys},
    {"drag", "", optional, table, drag_keys},
    {"wind", "", optional, table, wind_keys},
    {"aerodynamics", "", optional, table, aerodynamics_keys},
    {"sphere", "", optional, table_or_tables, sphere_keys},
    {"plane", "", optional, table_or_tables, plane_keys},
    {"camera", "", optional, table, camera_keys},
    {"wish", "", optional, table, wish_keys},
};

}  // namespace keys_of_scenes

std::span<const Key> scene_keys() { return keys_of_scenes::file_keys; }

}  // namespace crosscheck
