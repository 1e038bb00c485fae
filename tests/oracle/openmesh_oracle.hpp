#pragma once
// OpenMesh's subdividers on its own mesh, as a reference.

#include "geometry/split/split.hpp"

namespace facetmill::test {

/// The mesh after so many passes of OpenMesh's subdivider; positions and faces only.
Mesh openmesh_subdivided(const Mesh& mesh, SplitMethod method, int passes);

} // namespace facetmill::test
