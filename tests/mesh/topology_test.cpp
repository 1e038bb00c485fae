#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <map>

using namespace facetmill;

namespace {

/// The table as a map from edges to corners, built the slow way.
std::map<std::pair<Index, Index>, std::vector<Index>> plain_edges(const Mesh& mesh) {
    std::map<std::pair<Index, Index>, std::vector<Index>> edges;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Index a = mesh.vertex(c), b = mesh.vertex(next_corner(mesh, f, c));
            if (a != b) edges[{std::min(a, b), std::max(a, b)}].push_back(c);
        }
    return edges;
}

void check_edges(const Mesh& mesh) {
    const auto table = build_edges(mesh);
    const auto plain = plain_edges(mesh);
    REQUIRE(table.size() == plain.size());
    Index e = 0;
    std::size_t along = 0;
    for (const auto& [edge, corners] : plain) {
        const auto found = table.corners_of(e);
        const bool same = table.edges[e].low == edge.first && table.edges[e].high == edge.second &&
                          std::equal(found.begin(), found.end(), corners.begin(), corners.end());
        if (!same) FAIL("edge " << e << " differs");
        for (const Index c : found)
            if (table.corner_edge[c] != e) FAIL("corner " << c << " has another edge");
        along += corners.size();
        ++e;
    }
    CHECK(table.edge_corners.size() == along);
    const auto self_edges = std::count(table.corner_edge.begin(), table.corner_edge.end(), none);
    CHECK(static_cast<std::size_t>(self_edges) == mesh.corner_count() - along);
}

Mesh random_soup(std::size_t vertices, std::size_t faces) {
    Mesh mesh;
    mesh.positions.resize(vertices);
    for (std::size_t i = 0; i < 3 * faces; ++i)
        mesh.corners.push_back(static_cast<Index>(hashed(3, i) % vertices));
    return mesh;
}

} // namespace

TEST_CASE("the edge table agrees with a map", "[mesh]") {
    check_edges(shapes::tetrahedron());
    check_edges(shapes::quad_cube());
    check_edges(shapes::uv_cube());
    check_edges(shapes::fan3());
    check_edges(shapes::icosphere(4));
    check_edges(random_soup(10, 500));      // many faces at each edge, and self edges
    check_edges(random_soup(20000, 30000)); // more vertices than buckets
    check_edges(Mesh{});
}

TEST_CASE("the edges of a star around one vertex", "[mesh]") { check_edges(shapes::open_cone(5000)); }

TEST_CASE("corners at vertices, ascending", "[mesh]") {
    for (const Mesh& mesh :
         {shapes::quad_cube(), shapes::uv_cube(), shapes::icosphere(4), random_soup(5000, 9000), Mesh{}}) {
        const auto lists = corners_at_vertices(mesh);
        std::vector<std::vector<Index>> plain(mesh.vertex_count());
        for (Index c = 0; c < mesh.corner_count(); ++c) plain[mesh.vertex(c)].push_back(c);
        REQUIRE(lists.offsets.size() == mesh.vertex_count() + 1);
        bool same = true;
        for (Index v = 0; v < mesh.vertex_count(); ++v)
            same =
                same && std::equal(lists.of(v).begin(), lists.of(v).end(), plain[v].begin(), plain[v].end());
        CHECK(same);
    }
}

TEST_CASE("corner_faces of polygons", "[mesh]") {
    CHECK(corner_faces(shapes::bowtie()) == std::vector<Index>{0, 0, 0, 1, 1, 1});
    CHECK(corner_faces(shapes::quad_cube())[23] == 5);
}

TEST_CASE("components through vertices and through edges", "[mesh]") {
    CHECK(face_components(shapes::bowtie()).count == 1);
    CHECK(face_components(shapes::bowtie(), false).count == 2);
    CHECK(face_components(shapes::hourglass(), false).of_face == std::vector<Index>{0, 0, 0, 0, 1, 1, 1, 1});
    CHECK(face_components(shapes::crossing()).of_face == std::vector<Index>{0, 1});
    CHECK(face_components(Mesh{}).count == 0);
    Mesh many = shapes::icosphere(4);
    append(many, shapes::torus(50, 60));
    append(many, shapes::icosphere(3));
    const auto components = face_components(many);
    CHECK(components.count == 3);
    CHECK(components.of_face.front() == 0);
    CHECK(components.of_face.back() == 2);
}
