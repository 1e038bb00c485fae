#include "cells/process/border_closure.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/topology.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

#include <algorithm>

using namespace facetmill;
using namespace facetmill::cells;

namespace {

/// Faces of the mesh: which have a vertex of these.
std::vector<std::uint8_t> faces_with(const Mesh& mesh, const std::vector<std::uint8_t>& vertices) {
    std::vector<std::uint8_t> faces(mesh.face_count(), 0);
    for (Index c = 0; c < mesh.corner_count(); ++c) faces[c / 3] |= vertices[mesh.vertex(c)];
    return faces;
}

/// The input of border_closure_of: a part, the faces around it, and the components of the rest.
struct PartOfMesh {
    Mesh mesh;
    std::vector<std::uint8_t> part;
    std::vector<std::uint32_t> sheet;
};

PartOfMesh part_at(const Mesh& whole, const std::vector<std::uint8_t>& vertices) {
    const std::vector<std::uint8_t> in_part = faces_with(whole, vertices);
    std::vector<std::uint8_t> around(whole.vertex_count(), 0);
    Mesh rest;
    rest.positions = whole.positions;
    std::vector<Index> number(whole.face_count(), none); // of the rest
    for (Index f = 0; f < whole.face_count(); ++f)
        for (const Index v : whole.face_wedges(f)) {
            around[v] |= in_part[f];
            if (in_part[f]) continue;
            number[f] = static_cast<Index>(rest.corners.size() / 3);
            rest.corners.push_back(v);
        }
    const Components sheets = face_components(rest, false);
    const std::vector<std::uint8_t> near = faces_with(whole, around);
    PartOfMesh some;
    some.mesh.positions = whole.positions;
    for (Index f = 0; f < whole.face_count(); ++f) {
        if (!near[f]) continue;
        for (const Index v : whole.face_wedges(f)) some.mesh.corners.push_back(v);
        some.part.push_back(in_part[f]);
        some.sheet.push_back(in_part[f] ? 0 : sheets.of_face[number[f]]);
    }
    return some;
}

Mesh with_border_closure(const PartOfMesh& some) {
    const Collar border_closure = border_closure_of(some.mesh, some.part, some.sheet);
    Mesh closed;
    closed.positions = some.mesh.positions;
    closed.positions.insert(closed.positions.end(), border_closure.points.begin(),
                            border_closure.points.end());
    for (Index f = 0; f < some.part.size(); ++f)
        for (const Index v : some.mesh.face_wedges(f))
            if (some.part[f]) closed.corners.push_back(v);
    closed.corners.insert(closed.corners.end(), border_closure.corners.begin(), border_closure.corners.end());
    drop_unused(closed);
    return closed;
}

} // namespace

TEST_CASE("a part with its collar hangs together as the whole does", "[cells]") {
    const Mesh sphere = test::noisy_icosphere(3, 0.01, 4);
    unsigned state = 1;
    for (const unsigned rarely : {2U, 5U, 30U, 200U}) {
        CAPTURE(rarely);
        std::vector<std::uint8_t> vertices(sphere.vertex_count());
        for (auto& one : vertices) one = (state = state * 1664525 + 1013904223) / 65536 % rarely == 0;
        vertices[5] = 1;
        const PartOfMesh some = part_at(sphere, vertices);
        const auto part = std::count(some.part.begin(), some.part.end(), 1);
        CHECK(part > 0);
        CHECK(static_cast<std::size_t>(part) < sphere.face_count());
        const Properties p = inspect(with_border_closure(some));
        CHECK(p.closed);
        CHECK(p.edge_manifold);
        CHECK(p.vertex_manifold);
        CHECK(p.oriented);
        CHECK(p.components == 1); // through the rest, where the part alone does not hang together
        CHECK(p.degenerate_faces == 0);
        CHECK(p.duplicate_faces == 0);
    }
}

TEST_CASE("where nothing meets a part its collar stands apart, closed", "[cells]") {
    const Mesh sphere = test::noisy_icosphere(1, 0.01, 4);
    const PartOfMesh all = part_at(sphere, std::vector<std::uint8_t>(sphere.vertex_count(), 1));
    const Properties p = inspect(with_border_closure(all));
    CHECK(p.closed);
    CHECK(p.components == 2);
    CHECK(p.faces == static_cast<std::int64_t>(sphere.face_count()) + 4);
}
