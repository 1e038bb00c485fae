// Faces that cross themselves, against the sum of the angles that their edges subtend.
#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/polygon/polygon.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/measure.hpp"
#include "support/polygons.hpp"

using namespace facetmill;

namespace {

/// The ring as a face, in the plane z = 1.
Mesh face_of(const std::vector<Vec2>& ring) {
    Mesh mesh;
    std::vector<Index> all;
    for (const Vec2& p : ring) {
        all.push_back(static_cast<Index>(mesh.positions.size()));
        mesh.positions.push_back({p.x, p.y, 1});
    }
    add_face(mesh, all);
    return mesh;
}

/// Floor, roof and a wall along each edge of the ring.
Mesh prism_of(const std::vector<Vec2>& ring) {
    Mesh mesh;
    const auto n = static_cast<Index>(ring.size());
    std::vector<Index> floor, roof;
    for (const double z : {0.0, 1.0})
        for (const Vec2& p : ring) mesh.positions.push_back({p.x, p.y, z});
    for (Index i = 0; i < n; ++i) {
        floor.push_back(n - 1 - i);
        roof.push_back(n + i);
    }
    add_face(mesh, floor);
    add_face(mesh, roof);
    for (Index i = 0; i < n; ++i) add_face(mesh, std::vector<Index>{i, (i + 1) % n, n + (i + 1) % n, n + i});
    return mesh;
}

/// The number of triangles around the point in projection along z: anticlockwise if `up`, otherwise
/// clockwise.
int covers(const Mesh& mesh, const Vec2& p, bool up) {
    int count = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        int left = 0;
        for (Index k = 0; k < 3; ++k) {
            const Vec3 &a = mesh.point(3 * f + k), &b = mesh.point(3 * f + (k + 1) % 3);
            left += cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{p.x - a.x, p.y - a.y}) > 0;
        }
        count += left == (up ? 3 : 0);
    }
    return count;
}

int winding_by_angles(const Vec2& p, const std::vector<Vec2>& ring) {
    return static_cast<int>(std::lround(polygon::angle_sum(p, ring) / (2 * M_PI)));
}

} // namespace

TEST_CASE("a face that crosses itself covers what it winds around, once", "[geometry]") {
    int crossing = 0, fans = 0;
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        std::vector<Vec2> ring;
        for (std::uint64_t i = 0; i < 4 + seed % 5; ++i)
            ring.push_back({static_cast<double>(hashed(seed, 2 * i) % 7),
                            static_cast<double>(hashed(seed, 2 * i + 1) % 7)});
        const polygon::Kind kind = polygon::classify(ring);
        if (kind == polygon::Kind::degenerate) continue;
        INFO("ring " << seed);
        const auto filled = fill_crossing_faces(face_of(ring));
        crossing += kind == polygon::Kind::self_intersecting;
        CHECK((filled.mesh || kind != polygon::Kind::self_intersecting));
        if (!filled.mesh) continue;
        const Mesh& mesh = *filled.mesh;
        CHECK(broken_invariants(mesh).empty());
        CHECK(filled.overlapping == 0); // it has no neighbours
        fans += filled.filled == 0;
        if (filled.filled == 0) continue;
        REQUIRE(mesh.all_triangles());
        for (double x = 0.2370913; x < 6; x += 0.71031) // on no line through lattice points
            for (double y = 0.1190377; y < 6; y += 0.67093) {
                const int wanted = winding_by_angles({x, y}, ring);
                const int up = covers(mesh, {x, y}, true), down = covers(mesh, {x, y}, false);
                CHECK(up + down == (wanted != 0));
                if (wanted != 0) CHECK((up > 0) == (wanted > 0));
            }
    }
    CHECK(crossing > 200);
    CHECK(fans == 0);
}

TEST_CASE("a bow-tie has the area of its two triangles", "[geometry]") {
    const auto filled = fill_crossing_faces(face_of({{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
    REQUIRE(filled.mesh);
    CHECK(filled.filled == 1);
    CHECK(filled.mesh->vertex_count() == 5);
    CHECK(filled.mesh->face_count() == 2);
    CHECK(test::area(*filled.mesh) == 0.5);
    CHECK(test::area(triangles_of(face_of({{0, 0}, {4, 0}, {3, 4}, {1, 4}}))) == Approx(12)); // no crossing
    CHECK(test::area(triangles_of(face_of({{0, 0}, {6, 0}, {2, 4}, {4, 4}}))) == Approx(9 + 1));
    const double middle = 2.5 * std::sin(2 * M_PI / 5) * std::pow((3 - std::sqrt(5.0)) / 2, 2); // wound twice
    CHECK(test::area(triangles_of(face_of(test::pentagram()))) ==
          Approx(polygon::signed_area(test::pentagram()) - middle));
}

TEST_CASE("prisms over rings that cross themselves stay closed", "[geometry]") {
    for (const auto& ring :
         {std::vector<Vec2>{{0, 0}, {6, 0}, {2, 4}, {4, 4}}, test::pentagram(), test::figure_eight()}) {
        const Mesh prism = prism_of(ring);
        REQUIRE(inspect(prism).closed);
        const auto filled = fill_crossing_faces(prism);
        REQUIRE(filled.mesh);
        CHECK(filled.filled == 2);
        CHECK(filled.overlapping == (ring.size() == 5 ? 2 : 0)); // a pentagram's middle is wound around twice
        for (const Mesh& mesh : {*filled.mesh, triangles_of(prism)}) {
            CHECK(broken_invariants(mesh).empty());
            CHECK(inspect(mesh).closed);
            CHECK(test::volume(mesh) == Approx(polygon::signed_area(ring)).margin(1e-12));
        }
    }
}

TEST_CASE("attributes are interpolated where a face crosses itself", "[geometry]") {
    Mesh prism = prism_of({{0, 0}, {6, 0}, {2, 4}, {4, 4}});
    std::vector<double> values;
    for (const Vec3& p : prism.positions) values.push_back(p.x + 10 * p.y + 100 * p.z);
    prism.attributes.push_back({"heat", Domain::vertex, Role::generic, 1, false, values});
    prism.attributes.push_back({"COLOR", Domain::wedge, Role::generic, 1, false, values});
    const Mesh cut = triangles_of(prism);
    REQUIRE(cut.vertex_count() == prism.vertex_count() + 2);
    for (const char* name : {"heat", "COLOR"}) {
        const Domain domain = name[0] == 'h' ? Domain::vertex : Domain::wedge;
        const Attribute& a = *cut.find(name, domain);
        for (std::size_t i = 0; i < a.size(); ++i) {
            const auto v =
                domain == Domain::vertex ? static_cast<Index>(i) : cut.vertex_of_wedge(static_cast<Index>(i));
            const Vec3& p = cut.positions[v];
            CHECK(a.value(i, 0) == Approx(p.x + 10 * p.y + 100 * p.z));
        }
    }
}

TEST_CASE("faces that cross themselves in no plane, or not at all, are left alone", "[geometry]") {
    Mesh skew = face_of({{0, 0}, {1, 0}, {0, 1}, {1, 1}});
    skew.positions[2].z = 3;
    CHECK_FALSE(fill_crossing_faces(skew).mesh);
    Mesh two = face_of({{0, 0}, {6, 0}, {2, 4}, {4, 4}}); // triangles that share a diagonal cannot overlap
    two.positions[2].z = 0.25;
    CHECK_FALSE(fill_crossing_faces(two).mesh);
    CHECK(fill_crossing_faces(two).fans == 0);
    Mesh bent = face_of({{0, 0}, {3, 0}, {6, 0}, {2, 4}, {4, 4}});
    bent.positions[3].z = 0.25;
    CHECK_FALSE(fill_crossing_faces(bent).mesh);
    CHECK(fill_crossing_faces(bent).fans == 1);
    CHECK(count_fans(bent) == 1);
    CHECK_FALSE(fill_crossing_faces(shapes::quad_cube()).mesh);
    CHECK_FALSE(fill_crossing_faces(face_of(test::keyhole())).mesh);
    CHECK_FALSE(fill_crossing_faces(face_of({{0, 0}, {1, 1}, {3, 3}, {2, 2}})).mesh);
    const Mesh cube = shapes::quad_cube();
    CHECK(triangles_of(cube).corners == triangulated(cube).corners);
}
