#pragma once
// Orients a surface: orders vertices as P. Bourke, "Facets, planes, normals, rendering" (1992), requires.

#include "mesh/mesh.hpp"

#include <string>
#include <vector>

namespace facetmill {

enum class OrientMethod {
    outward,    ///< neighbours agree, and the front is the outside
    consistent, ///< neighbours agree; the front follows the majority of the faces of a component
    flip,       ///< every face is reversed
};
enum class Nested {
    cavities, ///< a closed component inside another, without touching it, is its cavity and faces inward
    solids,   ///< every closed component is a separate solid
};

struct OrientSettings {
    OrientMethod method = OrientMethod::outward;
    Nested nested = Nested::cavities;
};

/// A component of the surface: faces connected by edges with two faces.
struct OrientedComponent {
    Index first_face = none;
    std::size_t faces = 0, flipped = 0;
    bool closed = false;    ///< every edge has two faces
    bool orientable = true; ///< if not, it stays unchanged
    bool undecided =
        false;             ///< an open component whose sides are equally visible; it was only made consistent
    std::size_t depth = 0; ///< the number of closed components that contain it, if it is closed itself
    Vec3 conflict;         ///< if not orientable: a position where neighbours cannot agree
};

struct OrientResult {
    Mesh mesh;
    std::vector<OrientedComponent> components; ///< sorted by first face
    std::size_t flipped = 0;
    AttributeChanges changes;
};

/// Reverses faces so that neighbours across edges with two faces agree. With `outward`, the front of each
/// component becomes its outside. For a closed component, two numbers decide: the sign of its volume, and how
/// many other closed components contain it without touching it (exact rays along an axis). For open
/// components, rays from their faces along the axes decide: more rays escape from the outside. Edges with
/// more than two faces separate components. A component that cannot be oriented (a Moebius strip) stays
/// unchanged. Corners are reversed from the second on. Wedge normals that then point against their faces are
/// reversed, as is the handedness of their tangents. O(n log n).
[[nodiscard]] OrientResult orient(Mesh mesh, const OrientSettings& settings);

/// [faces] 1 for the faces that the method `consistent` reverses. The mesh stays unchanged.
[[nodiscard]] std::vector<std::uint8_t> consistent_flips(const Mesh& mesh);

/// Reverses the flagged faces. `orient` documents the changes of attributes.
AttributeChanges flip_faces(Mesh& mesh, const std::vector<std::uint8_t>& flags);

} // namespace facetmill
