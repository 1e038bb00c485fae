#include "support/catch.hpp"

#include "mesh/provenance.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;

namespace {

using Bytes = std::vector<std::uint8_t>;

/// A mesh of n isolated vertices with one attribute.
Mesh carrier(std::size_t n, Attribute a) {
    Mesh mesh;
    mesh.positions.resize(n);
    mesh.attributes.push_back(std::move(a));
    return mesh;
}

/// All old vertices, then points on the given edges.
Mesh with_edges(const Mesh& from, const std::vector<Provenance::Edge>& edges,
                AttributeChanges* changes = nullptr) {
    MeshProvenance d;
    d.vertices.identity = d.wedges.identity = d.faces_identity = true;
    d.vertices.edges = d.wedges.edges = edges;
    Mesh to;
    to.positions.resize(from.positions.size() + edges.size());
    auto found = inherit_attributes(to, from, d);
    if (changes) *changes = std::move(found);
    return to;
}

/// One new vertex, mixed from the first three.
Mesh mixed_of_three(const Mesh& from, const std::vector<double>& weights) {
    MeshProvenance d;
    d.faces_identity = true;
    d.vertices.mix_offsets = {0, 3};
    d.vertices.mix_sources = {0, 1, 2};
    d.vertices.mix_weights = weights;
    d.wedges = d.vertices;
    Mesh to;
    to.positions.resize(1);
    inherit_attributes(to, from, d);
    return to;
}

} // namespace

TEST_CASE("numbers are mixed linearly, integers rounded with ties up", "[mesh]") {
    const Mesh real =
        with_edges(carrier(2, {"q", Domain::vertex, Role::generic, 1, false, std::vector<double>{1, 3}}),
                   {{0, 1, 0.25}});
    CHECK(std::get<std::vector<double>>(real.attributes[0].data) == std::vector<double>{1, 3, 1.5});
    const Mesh whole =
        with_edges(carrier(2, {"c", Domain::vertex, Role::colour, 1, true, Bytes{10, 255}}), {{0, 1, 0.5}});
    CHECK(std::get<Bytes>(whole.attributes[0].data) == Bytes{10, 255, 133});
    const Mesh negative = with_edges(
        carrier(2, {"c", Domain::vertex, Role::generic, 1, false, std::vector<std::int8_t>{-3, 0}}),
        {{0, 1, 0.5}});
    CHECK(std::get<std::vector<std::int8_t>>(negative.attributes[0].data).back() == -1);
}

TEST_CASE("copies, then edges, then mixes", "[mesh]") {
    const Mesh from = carrier(3, {"q", Domain::vertex, Role::generic, 1, false, std::vector<float>{1, 2, 6}});
    MeshProvenance d;
    d.vertices.copies = {2};
    d.vertices.edges = {{0, 1, 0.5}};
    d.vertices.mix_offsets = {0, 3};
    d.vertices.mix_sources = {0, 1, 2};
    d.vertices.mix_weights = {0.25, 0.25, 0.5};
    d.wedges = d.vertices;
    Mesh to;
    to.positions.resize(3);
    const AttributeChanges changes = inherit_attributes(to, from, d);
    CHECK(std::get<std::vector<float>>(to.attributes[0].data) == std::vector<float>{6, 1.5, 3.75});
    CHECK(changes == AttributeChanges{{"q", Domain::vertex, AttributeChange::Kind::interpolated,
                                       "mixed at new elements"}});
}

TEST_CASE("normals are renormalised, opposite ones take the first parent's", "[mesh]") {
    const std::vector<float> normals{1, 0, 0, 0, 1, 0, -1, 0, 0};
    const Mesh to = with_edges(carrier(3, {"NORMAL", Domain::wedge, Role::normal, 3, false, normals}),
                               {{0, 1, 0.5}, {0, 2, 0.5}});
    CHECK(to.attributes[0].value(3, 0) == Approx(std::sqrt(0.5)));
    CHECK(to.attributes[0].value(3, 1) == Approx(std::sqrt(0.5)));
    CHECK(to.attributes[0].value(4, 0) == 1);
}

TEST_CASE("quantised normals keep unit length", "[mesh]") {
    const std::vector<std::int8_t> normals{127, 0, 0, 0, 127, 0};
    const Mesh to =
        with_edges(carrier(2, {"NORMAL", Domain::wedge, Role::normal, 3, true, normals}), {{0, 1, 0.5}});
    CHECK(std::get<std::vector<std::int8_t>>(to.attributes[0].data) ==
          std::vector<std::int8_t>{127, 0, 0, 0, 127, 0, 90, 90, 0});
}

TEST_CASE("the sign of a tangent is its first parent's", "[mesh]") {
    const std::vector<float> tangents{1, 0, 0, -1, 0, 1, 0, 1};
    const Mesh to =
        with_edges(carrier(2, {"TANGENT", Domain::wedge, Role::tangent, 4, false, tangents}), {{0, 1, 0.5}});
    CHECK(to.attributes[0].value(2, 3) == -1);
    CHECK(to.attributes[0].value(2, 0) == Approx(std::sqrt(0.5)));
}

TEST_CASE("identifiers are never mixed", "[mesh]") {
    AttributeChanges changes;
    const std::vector<std::int32_t> ids{7, 9};
    const Mesh to =
        with_edges(carrier(2, {"id", Domain::vertex, Role::index, 1, false, ids}), {{1, 0, 0.5}}, &changes);
    CHECK(std::get<std::vector<std::int32_t>>(to.attributes[0].data) == std::vector<std::int32_t>{7, 9, 9});
    CHECK(changes[0].kind == AttributeChange::Kind::kept);
}

TEST_CASE("joints are united, the strongest kept, ties by index, weights renormalised", "[mesh]") {
    Mesh from =
        carrier(2, {"JOINTS_0", Domain::wedge, Role::joints, 4, false, Bytes{1, 2, 3, 4, 5, 6, 1, 0}});
    from.attributes.push_back({"WEIGHTS_0", Domain::wedge, Role::weights, 4, false,
                               std::vector<float>{0.5f, 0.25f, 0.125f, 0.125f, 0.5f, 0.25f, 0.25f, 0}});
    const Mesh to = with_edges(from, {{0, 1, 0.5}});
    // United: 1: .375, 5: .25, 2: .125, 6: .125, 3 and 4: .0625. The first four sum to .875.
    const auto& joints = std::get<Bytes>(to.attributes[0].data);
    CHECK(Bytes(joints.begin() + 8, joints.end()) == Bytes{1, 5, 2, 6});
    const Attribute& weights = to.attributes[1];
    CHECK(weights.value(2, 0) == Approx(0.375 / 0.875));
    CHECK(weights.value(2, 3) == Approx(0.125 / 0.875));
    CHECK(weights.value(2, 0) + weights.value(2, 1) + weights.value(2, 2) + weights.value(2, 3) == Approx(1));
}

TEST_CASE("weights in bytes sum to one exactly", "[mesh]") {
    Mesh from = carrier(
        3, {"JOINTS_0", Domain::wedge, Role::joints, 4, false, Bytes{1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0}});
    from.attributes.push_back({"WEIGHTS_0", Domain::wedge, Role::weights, 4, true,
                               Bytes{255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}});
    const Mesh to = mixed_of_three(from, {0.25, 0.25, 0.5}); // 63.75 + 63.75 + 127.5: rounded, 256
    CHECK(std::get<Bytes>(to.attributes[0].data) == Bytes{3, 1, 2, 0});
    CHECK(std::get<Bytes>(to.attributes[1].data) == Bytes{127, 64, 64, 0});
}

TEST_CASE("face attributes are copied by their parents", "[mesh]") {
    Mesh from = shapes::grid(1, 1);
    from.attributes.push_back(
        {"group", Domain::face, Role::index, 1, false, std::vector<std::int32_t>{5, 6}});
    MeshProvenance d;
    d.vertices.identity = d.wedges.identity = true;
    d.faces = {1, 1, 0};
    Mesh to = from;
    to.corners.insert(to.corners.end(), {0, 1, 2});
    CHECK(inherit_attributes(to, from, d) ==
          AttributeChanges{{"group", Domain::face, AttributeChange::Kind::kept, ""}});
    CHECK(std::get<std::vector<std::int32_t>>(to.attributes[0].data) == std::vector<std::int32_t>{6, 6, 5});
}

TEST_CASE("a lineage of the wrong size is a bug", "[mesh]") {
    Mesh from = shapes::cube();
    Mesh to = from;
    MeshProvenance d;
    d.vertices.identity = d.wedges.identity = true;
    SECTION("of faces without attributes nothing need be said") {
        CHECK(inherit_attributes(to, from, d).empty());
    }
    SECTION("of faces with attributes it must") {
        from.attributes.push_back(
            {"group", Domain::face, Role::index, 1, false, std::vector<std::int32_t>(from.face_count())});
        CHECK_THROWS_WITH(inherit_attributes(to, from, d),
                          "[E-BUG] the provenance of the face domain has 0 elements, but the mesh has 12");
    }
    SECTION("of vertices always") {
        to.positions.emplace_back();
        CHECK_THROWS_WITH(inherit_attributes(to, from, d),
                          "[E-BUG] the provenance of the vertex domain has 8 elements, but the mesh has 9");
    }
}

TEST_CASE("wedges without seams descend as their vertices do", "[mesh]") {
    const Mesh from = carrier(2, {"uv", Domain::wedge, Role::uv, 2, false, std::vector<float>{0, 1, 4, 3}});
    MeshProvenance d;
    d.vertices.identity = d.wedges_as_vertices = d.faces_identity = true;
    d.vertices.edges = {{0, 1, 0.25}};
    Mesh to;
    to.positions.resize(3);
    inherit_attributes(to, from, d);
    CHECK(std::get<std::vector<float>>(to.attributes[0].data) == std::vector<float>{0, 1, 4, 3, 1, 1.5});
}

TEST_CASE("points on edges between points that were made before", "[mesh]") {
    Mesh from = carrier(2, {"q", Domain::vertex, Role::generic, 1, false, std::vector<float>{0, 8}});
    from.attributes.push_back({"c", Domain::wedge, Role::colour, 1, true, Bytes{0, 255}});
    from.attributes.push_back({"JOINTS_0", Domain::wedge, Role::joints, 1, false, Bytes{3, 3}});
    from.attributes.push_back(
        {"WEIGHTS_0", Domain::wedge, Role::weights, 1, false, std::vector<float>{1, 1}});
    MeshProvenance d;
    d.vertices.identity = d.vertices.chained = d.wedges_as_vertices = d.faces_identity = true;
    d.vertices.edges = {{0, 1, 0.5}, {2, 1, 0.5}, {3, 0, 0.25}};
    Mesh to;
    to.positions.resize(5);
    inherit_attributes(to, from, d);
    CHECK(std::get<std::vector<float>>(to.attributes[0].data) == std::vector<float>{0, 8, 4, 6, 4.5});
    CHECK(std::get<Bytes>(to.attributes[1].data) ==
          Bytes{0, 255, 128, 192, 144}); // each is rounded separately
    CHECK(std::get<Bytes>(to.attributes[2].data) == Bytes{3, 3, 3, 3, 3});
    CHECK(std::get<std::vector<float>>(to.attributes[3].data) == std::vector<float>{1, 1, 1, 1, 1});
}
