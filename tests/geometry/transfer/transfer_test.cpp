#include "geometry/transfer/transfer.hpp"

#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/surface.hpp"

using namespace facetmill;

namespace {

/// A strip of two triangles in z = 0 with the vertex attribute x, and face numbers.
Mesh strip() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.corners = {0, 1, 2, 0, 2, 3};
    mesh.attributes = {{"x", Domain::vertex, Role::generic, 1, false, std::vector<double>{0, 1, 1, 0}},
                       {"number", Domain::face, Role::index, 1, false, std::vector<std::uint32_t>{7, 9}}};
    return mesh;
}

} // namespace

TEST_CASE("transfer: values are interpolated at the nearest points", "[transfer]") {
    const Mesh from = strip();
    const FaceTree tree(surface_of(from), FaceTree::Use::near);
    Mesh to;
    to.positions = {{0.25, 0.5, 2}, {0.75, 0.125, -1}, {5, 0.5, 0}};
    to.corners = {0, 1, 2};
    const NearestSources sources = nearest_sources(from, tree, to);
    CHECK(sources.distances == std::vector<double>{2, 1, 4});
    inherit_attributes(to, from, sources.provenance);
    const Attribute* x = to.find("x", Domain::vertex);
    REQUIRE(x != nullptr);
    CHECK(x->value(0, 0) == Approx(0.25));
    CHECK(x->value(1, 0) == Approx(0.75));
    CHECK(x->value(2, 0) == Approx(1));
    CHECK(to.find("number", Domain::face)->value(0, 0) == 7);
}

TEST_CASE("transfer: wedges get the values of their side of a seam", "[transfer]") {
    Mesh from = strip(); // the two triangles have no wedge in common
    from.wedge_vertex = {0, 1, 2, 0, 2, 3};
    from.corners = {0, 1, 2, 3, 4, 5};
    from.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false,
                               std::vector<float>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}});
    const FaceTree tree(surface_of(from), FaceTree::Use::near);
    Mesh to = from;
    to.attributes.clear();
    const NearestSources sources = nearest_sources(from, tree, to);
    CHECK(faces_across_charts(from, to, sources.provenance) == 0);
    inherit_attributes(to, from, sources.provenance);
    CHECK(to.find("TEXCOORD_0", Domain::wedge)->data == from.find("TEXCOORD_0", Domain::wedge)->data);
}

TEST_CASE("transfer: faces across charts are counted", "[transfer]") {
    const Mesh from = shapes::uv_cube();
    const FaceTree tree(surface_of(from), FaceTree::Use::near);
    Mesh to = shapes::octahedron();
    for (Vec3& p : to.positions) p = p * 0.4 + Vec3{0.5, 0.5, 0.5};
    CHECK(faces_across_charts(from, to, nearest_sources(from, tree, to).provenance) == to.face_count());
}

TEST_CASE("transfer: barycentric weights of triangles without area", "[transfer]") {
    const auto point = barycentric_weights({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {2, 0, 0});
    CHECK(point == std::array<double, 3>{1, 0, 0});
    const auto line = barycentric_weights({{0, 0, 0}, {1, 0, 0}, {4, 0, 0}}, {1, 5, 0});
    CHECK(line[2] == Approx(0.25));
    CHECK(line[0] == Approx(0.75));
}
