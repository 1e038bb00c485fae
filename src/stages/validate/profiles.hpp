#pragma once
// Named sets of assertions for the purposes of a mesh.

#include "stage/purpose.hpp"
#include "stages/validate/scene_limits.hpp"

namespace facetmill::validate_stage {

enum class Profile { none, solid, printing, web, simulation, shop, unreal, unity, godot, ar };

template <class S>
void declare_profile(Declare<S>& d, Profile S::*member) {
    d.template choice<Profile>(
        "for", member,
        {{"none", Profile::none, "only the given assertions"},
         {"solid", Profile::solid,
          "closed, manifold, oriented outward; no degenerate, duplicate or folded faces; not empty"},
         {"printing", Profile::printing,
          "a solid without self-intersections or isolated vertices; it may touch itself"},
         {"web", Profile::web,
          "finite attributes, unit normals, weights that sum to 1; no degenerate or duplicate faces, no "
          "isolated "
          "vertices; not empty"},
         {"simulation", Profile::simulation,
          "fit for printing, no T-junctions, all angles at least 5 degrees, aspect ratios up to 20"},
         {"shop", Profile::shop,
          "web, and the limits of Khronos's guidelines for 3D commerce: 100,000 triangles, 5 materials, draw "
          "calls and parts; textures with sides of 512, 1024 or 2048; texture coordinates in the unit "
          "square, neither overlapping nor mirrored; base colours from 30 to 240, metal or not; 1 cm to 100 "
          "m; no transform "
          "at the top of the scene"},
         {"unreal", Profile::unreal,
          "web, sides of textures powers of two up to 8192, no transform at the top of the scene, at most "
          "256 joints"},
         {"unity", Profile::unity, "the same, with textures up to 16384"},
         {"godot", Profile::godot, "the same, with textures up to 16384 of any side"},
         {"ar", Profile::ar,
          "shop with base colours of any brightness; the origin at the centre or at the centre of the "
          "bottom"}},
        "The purpose of the mesh. Its assertions are added to yours.");
}

/// The given assertions, plus the profile's assertions about other properties. If both are empty, the checks
/// of a sound solid.
[[nodiscard]] Assertions profiled(Assertions given, Profile profile, const SceneLimits& limits,
                                  const Mark& where);

/// The given limits, plus the profile's limits that are not given.
[[nodiscard]] SceneLimits profiled(SceneLimits given, Profile profile);

/// The purpose of that profile for the stages that follow, with the bounds that override it. Not none.
[[nodiscard]] Purpose purpose_of(const Assertions& given, Profile profile, const Mark& where);

} // namespace facetmill::validate_stage
