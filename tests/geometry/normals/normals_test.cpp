#include "geometry/normals/normals.hpp"

#include "base/math/portable_math.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/surface.hpp"

using namespace facetmill;

namespace {

Vec3 normal_of(const Mesh& m, Index w) {
    const Attribute& a = *m.find("NORMAL", Domain::wedge);
    return {a.value(w, 0), a.value(w, 1), a.value(w, 2)};
}

/// The largest distance between a corner's normal and its face's normal.
double worst_against_faces(const Mesh& m) {
    double worst = 0;
    for (Index f = 0; f < m.face_count(); ++f) {
        const Index c = m.face_begin(f);
        const Vec3 n = normalised(cross(m.point(c + 1) - m.point(c), m.point(c + 2) - m.point(c)));
        for (const Index w : m.face_wedges(f)) worst = std::max(worst, length(normal_of(m, w) - n));
    }
    return worst;
}

/// A cube around the origin.
Mesh centred_cube() {
    Mesh m = shapes::cube();
    for (Vec3& p : m.positions) p -= Vec3{0.5, 0.5, 0.5};
    return m;
}

} // namespace

TEST_CASE("smooth normals do not depend on how flat areas are cut", "[geometry]") {
    Mesh m = centred_cube();
    const AttributeChanges changes = give_normals(m, NormalKind::smooth, pi);
    REQUIRE(changes.size() == 1);
    CHECK(changes[0].kind == AttributeChange::Kind::recomputed);
    CHECK_FALSE(m.has_seams());
    CHECK(broken_invariants(m).empty());
    // Corners have 4 or 5 triangles in 3 planes, and by angle each plane counts the same.
    for (Index v = 0; v < 8; ++v) CHECK(length(normal_of(m, v) - normalised(m.positions[v])) < 1e-7);
}

TEST_CASE("feature edges stay sharp", "[geometry]") {
    Mesh m = centred_cube();
    give_normals(m, NormalKind::smooth, 40 * pi / 180);
    CHECK(m.wedge_count() == 24);
    CHECK(m.vertex_count() == 8);
    CHECK(broken_invariants(m).empty());
    CHECK(worst_against_faces(m) < 1e-7);
    give_normals(m, NormalKind::smooth, 91 * pi / 180);
    CHECK(m.wedge_count() == 8);
    CHECK_FALSE(m.has_seams());
    Mesh flat = centred_cube();
    give_normals(flat, NormalKind::flat, 0);
    CHECK(flat.wedge_count() == 24);
    CHECK(worst_against_faces(flat) < 1e-7);
    CHECK(give_normals(flat, NormalKind::none, 0)[0].kind == AttributeChange::Kind::dropped);
    CHECK(flat.find("NORMAL", Domain::wedge) == nullptr);
    CHECK(flat.corners == centred_cube().corners);
    CHECK(give_normals(flat, NormalKind::keep, 0).empty());
}

TEST_CASE("the normals of a sphere point away from its centre", "[geometry]") {
    Mesh m = shapes::icosphere(5);
    give_normals(m, NormalKind::smooth, pi);
    double worst = 0;
    for (Index v = 0; v < m.vertex_count(); ++v)
        worst = std::max(worst, length(normal_of(m, v) - normalised(m.positions[v])));
    CHECK(worst < 2e-3); // edges are 0.035 long
    CHECK(test::same_for_any_threads([] {
        Mesh again = shapes::icosphere(5);
        give_normals(again, NormalKind::smooth, 2 * pi / 180); // some edges are sharper
        return again;
    }));
}

TEST_CASE("seams of other attributes stay, with one normal on both sides", "[geometry]") {
    Mesh m = centred_cube();
    // Every corner has its own texture point.
    std::vector<Index> vertices;
    std::vector<float> uvs;
    for (Index c = 0; c < m.corner_count(); ++c) {
        vertices.push_back(m.vertex(c));
        uvs.push_back(static_cast<float>(c));
        uvs.push_back(0.5f);
    }
    for (Index c = 0; c < m.corner_count(); ++c) m.corners[c] = c;
    m.wedge_vertex = vertices;
    m.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, uvs});
    m.primitives.push_back({none, {"TEXCOORD_0"}, {}});
    give_normals(m, NormalKind::smooth, pi);
    CHECK(broken_invariants(m).empty());
    CHECK(m.wedge_count() == 36);
    CHECK(m.primitives[0].attributes == std::vector<std::string>{"NORMAL", "TEXCOORD_0"});
    for (Index c = 0; c < m.corner_count(); ++c) {
        CHECK(m.find("TEXCOORD_0", Domain::wedge)->value(m.corners[c], 0) == c);
        CHECK(length(normal_of(m, m.corners[c]) - normalised(m.point(c))) < 1e-7);
    }
}

TEST_CASE("what needs normals goes with them", "[geometry]") {
    Mesh m = shapes::cube();
    give_normals(m, NormalKind::smooth, pi);
    m.attributes.push_back({"TANGENT", Domain::wedge, Role::tangent, 4, false, std::vector<float>(32)});
    for (const char* name : {"TARGET_0_POSITION", "TARGET_0_NORMAL", "TARGET_1_TANGENT"})
        m.attributes.push_back({name, Domain::wedge, Role::morph_vector, 3, false, std::vector<float>(24)});
    m.primitives.push_back({none, {"TANGENT", "NORMAL", "TARGET_0_POSITION"}, {}});
    CHECK(give_normals(m, NormalKind::none, 0).size() == 4);
    REQUIRE(m.attributes.size() == 1);
    CHECK(m.attributes[0].name == "TARGET_0_POSITION");
    CHECK(m.primitives[0].attributes == std::vector<std::string>{"TARGET_0_POSITION"});
}

TEST_CASE("normals of what is no surface", "[geometry]") {
    // Two triangles that do not agree about the outside share an edge but no normal.
    Mesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {9, 9, 9}};
    m.corners = {0, 1, 2, 1, 2, 3};
    give_normals(m, NormalKind::smooth, pi);
    CHECK(broken_invariants(m).empty());
    CHECK(m.wedge_count() == 6);
    CHECK(normal_of(m, m.corners[0]) == Vec3{0, 0, 1});
    CHECK(normal_of(m, m.corners[3]) == Vec3{0, 0, -1});
    Mesh thin; // without area
    thin.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    thin.corners = {0, 1, 2};
    give_normals(thin, NormalKind::smooth, pi);
    CHECK(normal_of(thin, 0) == Vec3{});
    give_normals(thin, NormalKind::flat, pi);
    Mesh empty;
    give_normals(empty, NormalKind::smooth, pi);
    CHECK(empty.face_count() == 0);
}
