#pragma once
// Conversion of units and up axes from one file's convention to another's.

#include "io/codec.hpp"

namespace facetmill::io {

struct Convention {
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
};

/// The result of convert.
struct Conversion {
    double factor = 1;         ///< every length was multiplied by it
    bool turned = false;       ///< the up axis changed
    bool unit_guessed = false; ///< the target has a unit but the scene has none: numbers are unchanged
    bool up_guessed = false;
    Transform transform;    ///< from the old world to the new world
    bool keys_kept = false; ///< keys of animated lengths of cameras and lights have the old numbers
};

/// The warning (W-TRANSFORM) about `keys_kept`, and its hint.
inline constexpr const char* keys_kept_message =
    "KHR_animation_pointer animates lengths of cameras or lights, and their keys are not converted";
inline constexpr const char* keys_kept_hint =
    "scale the keys of these animations in the program that made them, or keep the unit and the size";

/// A quarter turn about x that turns the axis `from` to `to`; identity if they are the same.
[[nodiscard]] Transform turn_up(UpAxis from, UpAxis to);

/// Converts the scene by changing the transforms of its parts, and of cameras and lights. Meshes stay
/// unchanged. An unknown unit or
/// axis in the target keeps the scene's. Skinned parts are moved in bind pose.
Conversion convert(Scene& scene, const Convention& target);

/// Adds the parts, materials and documents of `more`, converted to the scene's convention. The first load
/// with a unit, or an up axis, sets it. Part names become unique: "cube", "cube_2".
Conversion add_scene(Scene& scene, Scene more);

} // namespace facetmill::io
