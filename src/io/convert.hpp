#pragma once
// Units and up axes: what a scene's numbers mean, from one file's convention to another's.

#include "io/codec.hpp"

namespace facetmill::io {

struct Convention {
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
};

/// What convert did.
struct Conversion {
    double factor = 1;         ///< every length was multiplied by it
    bool turned = false;       ///< the up axis changed
    bool unit_guessed = false; ///< the target has a unit, the scene none: numbers are as they were
    bool up_guessed = false;
    Transform transform; ///< old world -> new world
};

/// A quarter turn about x that brings the one axis to where the other was; none when they are the same.
Transform turn_up(UpAxis from, UpAxis to);

/// Puts the scene into the convention by the transforms of its parts; meshes stay as they are. Unknown, in
/// the target, means as the scene has it. Skinned parts are moved in bind pose.
Conversion convert(Scene& scene, const Convention& target);

/// Adds the parts, materials and documents of `more` to the scene, in the scene's convention (the first load
/// that has a unit, or an up axis, decides). Names of parts become unique: "cube", "cube_2".
Conversion add_scene(Scene& scene, Scene more);

} // namespace facetmill::io
