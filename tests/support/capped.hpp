#pragma once
// A solid with a cap, and the distance of the cap from its plane.

#include "mesh/shapes.hpp"
#include "support/run_stage.hpp"

namespace facetmill::test {

/// The part of an icosphere above z = 0.2, with a cap on the cut.
inline Scene capped_sphere() {
    return run_stage("clip", "{plane: z=0.2, cap: true}", scene_of(shapes::icosphere(3))).scene;
}

/// The largest distance of a vertex of the cap from z = 0.2; -1 without a cap.
inline double cap_unevenness(const Mesh& mesh) {
    const Attribute* cut = mesh.find("cut_id", Domain::face);
    double most = -1;
    for (Index f = 0; cut && f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f) && cut->value(f, 0) > 0; ++c)
            most = std::max(most, std::abs(mesh.positions[mesh.vertex(c)].z - 0.2));
    return most;
}

} // namespace facetmill::test
