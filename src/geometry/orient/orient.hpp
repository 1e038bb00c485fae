#pragma once
// The orientation of a surface: vertices are ordered as P. Bourke, "Facets, planes, normals, rendering"
// (1992), requires.

#include "mesh/mesh.hpp"

#include <string>
#include <vector>

namespace facetmill {

enum class OrientMethod {
    outward,    ///< neighbours agree, and the front is the outside
    consistent, ///< neighbours agree; the front follows the majority of the faces of a component
    flip,       ///< every face is turned round
};
enum class Nested {
    cavities, ///< a closed component inside another, which it does not meet, is its cavity: it faces the
              ///< hollow
    solids,   ///< every closed component is a solid of its own
};

struct OrientSettings {
    OrientMethod method = OrientMethod::outward;
    Nested nested = Nested::cavities;
};

/// A component of the surface: faces connected over edges of two faces.
struct OrientedComponent {
    Index first_face = none;
    std::size_t faces = 0, flipped = 0;
    bool closed = false;    ///< every edge has two faces
    bool orientable = true; ///< else it is left as it was
    bool undecided = false; ///< open, and both sides look alike: only made consistent
    std::size_t depth = 0;  ///< the number of closed components that contain it, if it is closed itself
    Vec3 conflict;          ///< not orientable: where neighbours cannot agree
};

struct OrientResult {
    Mesh mesh;
    std::vector<OrientedComponent> components; ///< by first face
    std::size_t flipped = 0;
    AttributeChanges changes;
};

/// Turns faces round so that neighbours agree (spread over edges of two faces) and, for outward, the front of
/// each component is its outside. For closed components that is decided by the sign of the volume and by how
/// many other closed components contain them without touching them (exact rays along an axis); for open ones
/// by a vote of rays from their faces along the axes: the side from which more of them escape is outside.
/// Edges of more than two faces part components. A component that cannot be oriented (a Moebius strip) is
/// left as it was. Corners are reversed from the second on; wedge normals that then point against their faces
/// are turned with them, and their tangents' handedness. O(n log n).
[[nodiscard]] OrientResult orient(Mesh mesh, const OrientSettings& settings);

/// 1 for the faces that the method consistent turns round; the mesh stays as it is.
[[nodiscard]] std::vector<std::uint8_t> consistent_flips(const Mesh& mesh);

/// Turns the flagged faces round; orient documents the changes of attributes.
AttributeChanges flip_faces(Mesh& mesh, const std::vector<std::uint8_t>& flags);

} // namespace facetmill
