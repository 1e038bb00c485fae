#include "geometry/normals/normals.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/simplify/simplify.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using SeamShading = NormalSeams::Shading;

namespace {

const double thirty = 30 * pi / 180;

/// Gives every corner a separate wedge with the face's normal.
Mesh flat_shaded(Mesh m) {
    Attribute normals{"NORMAL", Domain::wedge, Role::normal, 3, false, {}};
    std::vector<float> data;
    std::vector<Index> vertices;
    for (Index c = 0; c < m.corner_count(); ++c) {
        const Index f = c / 3;
        const Vec3 n =
            normalised(cross(m.point(3 * f + 1) - m.point(3 * f), m.point(3 * f + 2) - m.point(3 * f)));
        for (std::size_t i = 0; i < 3; ++i) data.push_back(static_cast<float>(n[i]));
        vertices.push_back(m.vertex(c));
    }
    for (Index c = 0; c < m.corner_count(); ++c) m.corners[c] = c;
    m.wedge_vertex = std::move(vertices);
    normals.data = std::move(data);
    m.attributes.push_back(std::move(normals));
    return m;
}

/// The cosine of the largest angle between the normal of a corner and its face.
double worst_facing(const Mesh& m) {
    const Attribute& a = *m.find("NORMAL", Domain::wedge);
    double worst = 1;
    for (Index f = 0; f < m.face_count(); ++f) {
        const Vec3 n =
            normalised(cross(m.point(3 * f + 1) - m.point(3 * f), m.point(3 * f + 2) - m.point(3 * f)));
        for (const Index w : m.face_wedges(f))
            worst = std::min(worst, dot(n, Vec3{a.value(w, 0), a.value(w, 1), a.value(w, 2)}));
    }
    return worst;
}

/// A prism around the z axis, open at both ends; smooth all around except for a seam at every edge.
Mesh prism(int sides, double turn_of_normals) {
    Mesh m;
    for (int i = 0; i < sides; ++i)
        for (const double z : {0.0, 1.0})
            m.positions.push_back({cosine(2 * pi * i / sides), sine(2 * pi * i / sides), z});
    for (int i = 0; i < sides; ++i) {
        const auto a = static_cast<Index>(2 * i), b = static_cast<Index>(2 * ((i + 1) % sides));
        add_face(m, std::array<Index, 3>{a, b, b + 1});
        add_face(m, std::array<Index, 3>{a, b + 1, a + 1});
    }
    m = flat_shaded(std::move(m));
    Attribute& n = *m.find("NORMAL", Domain::wedge); // rotated, so that it differs from flat shading
    for (Index w = 0; w < m.wedge_count(); ++w) {
        const double x = n.value(w, 0), y = n.value(w, 1), c = cosine(turn_of_normals),
                     s = sine(turn_of_normals);
        n.set_value(w, 0, c * x - s * y);
        n.set_value(w, 1, s * x + c * y);
    }
    return m;
}

} // namespace

TEST_CASE("a flat-shaded mesh is one surface, and flat-shaded again afterwards", "[geometry]") {
    Mesh m = flat_shaded(shapes::icosphere(2));
    CHECK(m.wedge_count() == 960);
    const auto seams = merge_normal_seams(m, thirty);
    CHECK(seams.shading == SeamShading::faceted);
    CHECK(seams.merged == 960 - 162);
    CHECK_FALSE(m.has_seams());
    CHECK(broken_invariants(m).empty());
    set_facet_normals(m);
    CHECK(m.wedge_count() == 960);
    CHECK(worst_facing(m) > 0.999999);
    CHECK(broken_invariants(m).empty());
}

TEST_CASE("facets in one plane share their wedges", "[geometry]") {
    Mesh m = flat_shaded(shapes::cube());
    CHECK(merge_normal_seams(m, thirty).merged == 36 - 8);
    set_facet_normals(m);
    CHECK(m.wedge_count() == 24);
    CHECK(m.face_count() == 12);
    CHECK(worst_facing(m) > 0.999999);
}

TEST_CASE("normal seams go where faces meet at less than the feature angle", "[geometry]") {
    const double turn = 10 * pi / 180;
    Mesh round = prism(24, turn); // 15 degrees at every edge
    const auto merged = merge_normal_seams(round, thirty);
    CHECK(merged.shading == SeamShading::smoothed);
    CHECK_FALSE(round.has_seams());
    const Attribute& n = *round.find("NORMAL", Domain::wedge);
    for (Index w = 0; w < round.wedge_count(); ++w) { // outward, as the faces around are
        const Vec3& p = round.positions[w];
        CHECK(n.value(w, 0) * p.x + n.value(w, 1) * p.y > 0.99);
    }
    Mesh hexagon = prism(6, turn);                           // 60 degrees
    CHECK(merge_normal_seams(hexagon, thirty).merged == 12); // the two faces of each side
    CHECK(hexagon.wedge_count() == 24);
    Mesh kept = prism(24, turn);
    CHECK(merge_normal_seams(kept, 0).merged == 0);
    CHECK(test::same(kept, prism(24, turn)));
}

TEST_CASE("seams of texture coordinates stay when normals are merged", "[geometry]") {
    Mesh m = shapes::uv_cube();
    const auto wedges = m.wedge_count();
    CHECK(merge_normal_seams(m, thirty).merged < wedges - 8);
    const Attribute& uv = *m.find("TEXCOORD_0", Domain::wedge);
    const Mesh given = shapes::uv_cube();
    const Attribute& old = *given.find("TEXCOORD_0", Domain::wedge);
    for (Index c = 0; c < m.corner_count(); ++c)
        for (int i = 0; i < 2; ++i) CHECK(uv.value(m.corners[c], i) == old.value(given.corners[c], i));
}

TEST_CASE("a flat-shaded sphere simplifies like any other", "[geometry]") {
    const auto r = simplify(flat_shaded(shapes::icosphere(3)), {.ratio = 0.1});
    CHECK(r.stop == SimplifyResult::Stop::ratio);
    CHECK(r.shading == SeamShading::faceted);
    CHECK(test::sound(r.mesh, 2));
    CHECK(worst_facing(r.mesh) > 0.9999);
    REQUIRE(r.changes.size() == 1);
    CHECK(r.changes[0].kind == AttributeChange::Kind::recomputed);
    CHECK(r.changes[0].why == "flat shading: the normals of the new faces");
    CHECK(simplify(flat_shaded(shapes::icosphere(3)), {.feature_angle = 0, .ratio = 0.1}).stop ==
          SimplifyResult::Stop::stuck);
}
