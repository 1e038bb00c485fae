#pragma once
// The edges where a surface bends.

#include "mesh/topology.hpp"

namespace facetmill {

/// The other ends of the sharp edges at each vertex, ascending. Sharp is an edge whose two faces' normals
/// differ by more than the angle (radians, in world space; the faces' directions are compared along the edge,
/// so neighbours that disagree in direction do not count as bent), and one of more than two faces; with
/// boundaries, one of a single face too. Faces without area bend nothing.
VertexLists sharp_ends(const Mesh& mesh, double angle, const Transform& to_world, bool boundaries);

} // namespace facetmill
