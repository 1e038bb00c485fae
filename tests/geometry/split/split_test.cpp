#include "geometry/split/split.hpp"

#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"

using namespace facetmill;

namespace {

/// Every method that keeps the surface, in an order in which results can be split again.
constexpr SplitMethod every_method[] = {SplitMethod::midpoint, SplitMethod::bisect,   SplitMethod::centroid,
                                        SplitMethod::grid,     SplitMethod::quads,    SplitMethod::varignon,
                                        SplitMethod::core,     SplitMethod::diagonal, SplitMethod::halve,
                                        SplitMethod::fan,      SplitMethod::notch};
Mesh triangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
    mesh.corners = {0, 1, 2};
    return mesh;
}

Mesh square() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.corners = {0, 1, 2, 3};
    mesh.face_offsets = {0, 4};
    return mesh;
}

std::size_t faces_of(const Mesh& mesh, SplitMethod method, int n = 2) {
    const SplitResult result = split(mesh, {method, 1, n});
    CHECK(broken_invariants(result.mesh).empty());
    CHECK(result.added == result.mesh.face_count() - mesh.face_count());
    return result.mesh.face_count();
}

} // namespace

TEST_CASE("a triangle becomes as many faces as Bourke's Splitting facets says", "[geometry]") {
    CHECK(faces_of(triangle(), SplitMethod::midpoint) == 4);
    CHECK(faces_of(triangle(), SplitMethod::bisect) == 2);
    CHECK(faces_of(triangle(), SplitMethod::centroid) == 3);
    CHECK(faces_of(triangle(), SplitMethod::core) == 4);
    CHECK(faces_of(triangle(), SplitMethod::quads) == 3);
    CHECK(faces_of(triangle(), SplitMethod::notch) == 2);
    CHECK(faces_of(triangle(), SplitMethod::diagonal) == 1);
    CHECK(faces_of(triangle(), SplitMethod::fan) == 1);
    CHECK(faces_of(triangle(), SplitMethod::loop) == 4);
    CHECK(faces_of(triangle(), SplitMethod::butterfly) == 4);
    CHECK(faces_of(triangle(), SplitMethod::sqrt3) == 3);
    CHECK(faces_of(triangle(), SplitMethod::catmull_clark) == 3);
    for (int n = 1; n <= 6; ++n)
        CHECK(faces_of(triangle(), SplitMethod::grid, n) == static_cast<std::size_t>(n * n));
}

TEST_CASE("a quad becomes as many faces as Bourke's Splitting facets says", "[geometry]") {
    CHECK(faces_of(square(), SplitMethod::midpoint) == 4);
    CHECK(faces_of(square(), SplitMethod::varignon) == 5);
    CHECK(faces_of(square(), SplitMethod::centroid) == 4);
    CHECK(faces_of(square(), SplitMethod::halve) == 2);
    CHECK(faces_of(square(), SplitMethod::fan) == 4);
    CHECK(faces_of(square(), SplitMethod::quads) == 4);
    CHECK(faces_of(square(), SplitMethod::core) == 5);
    CHECK(faces_of(square(), SplitMethod::catmull_clark) == 4);
    CHECK(faces_of(square(), SplitMethod::diagonal) == 2);
    for (int n = 1; n <= 6; ++n)
        CHECK(faces_of(square(), SplitMethod::grid, n) == static_cast<std::size_t>(n * n));
}

TEST_CASE("midpoint halves the edges of a triangle", "[geometry]") {
    const Mesh mesh = split(triangle(), {}).mesh;
    CHECK(mesh.positions ==
          std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {2, 0, 0}, {0, 1.5, 0}, {2, 1.5, 0}});
    CHECK(mesh.corners == std::vector<Index>{0, 3, 4, 3, 5, 4, 3, 1, 5, 4, 5, 2});
    CHECK(mesh.all_triangles());
}

TEST_CASE("bisect cuts across the longest edge", "[geometry]") {
    const Mesh mesh = split(triangle(), {SplitMethod::bisect, 1, 2}).mesh;
    REQUIRE(mesh.vertex_count() == 4);
    CHECK(mesh.positions[3] == Vec3{2, 1.5, 0});
}

TEST_CASE("bisect cuts a face where its neighbours cut it", "[geometry]") {
    Mesh mesh = triangle(); // a larger triangle on its edge (0, 0) - (4, 0)
    mesh.positions.push_back({2, -10, 0});
    mesh.corners.insert(mesh.corners.end(), {1, 0, 3});
    const Mesh once = split(mesh, {SplitMethod::bisect, 1, 2}).mesh;
    CHECK(once.face_count() == 4);
    CHECK(test::edge_manifold(once));
    CHECK(test::euler(once) == 1);
}

TEST_CASE("midpoint makes quads of a pentagon", "[geometry]") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {-1, 1, 0}};
    mesh.corners = {0, 1, 2, 3, 4};
    mesh.face_offsets = {0, 5};
    const Mesh halved = split(mesh, {}).mesh;
    REQUIRE(halved.face_count() == 5);
    for (Index f = 0; f < 5; ++f) CHECK(halved.face_size(f) == 4);
    CHECK(test::area(halved) == Approx(test::area(mesh)));
}

TEST_CASE("grid gives shared edges the same points", "[geometry]") {
    const Mesh mesh = grid_split(shapes::cube(), 5).mesh;
    CHECK(mesh.face_count() == 12 * 25);
    CHECK(mesh.vertex_count() == 6 * 25 + 2);
    CHECK(test::closed(mesh));
}

TEST_CASE("every method keeps a closed mesh closed, its Euler number and its volume", "[geometry]") {
    for (const auto method : every_method)
        for (const Mesh& mesh : {shapes::cube(), shapes::tetrahedron(), shapes::uv_cube(),
                                 shapes::torus(7, 5), shapes::hourglass()}) {
            const Mesh finer = split(mesh, {method, 2, 3}).mesh;
            CAPTURE(static_cast<int>(method), mesh.face_count());
            CHECK(broken_invariants(finer).empty());
            CHECK(test::closed(finer));
            CHECK(test::euler(finer) == test::euler(mesh));
            CHECK(test::volume(finer) == Approx(test::volume(mesh)).epsilon(1e-13));
            CHECK(test::area(finer) == Approx(test::area(mesh)).epsilon(1e-13));
        }
}

TEST_CASE("every method splits open and non-manifold meshes without cracks", "[geometry]") {
    for (const auto method : every_method)
        for (const Mesh& mesh :
             {shapes::grid(3, 2), shapes::fan3(), shapes::bowtie(), shapes::open_cone(6)}) {
            const Mesh finer = split(mesh, {method, 1, 3}).mesh;
            CAPTURE(static_cast<int>(method), mesh.face_count());
            CHECK(broken_invariants(finer).empty());
            CHECK(test::euler(finer) == test::euler(mesh));
            CHECK(test::area(finer) == Approx(test::area(mesh)).epsilon(1e-13));
        }
}

TEST_CASE("a seam stays a seam: one new wedge per edge and pair of wedges", "[geometry]") {
    const Mesh mesh = split(shapes::uv_cube(), {}).mesh;
    CHECK(mesh.vertex_count() == 8 + 18);
    CHECK(mesh.wedge_count() == 24 + 12 * 2 + 6);
    const Attribute* normals = mesh.find("NORMAL", Domain::wedge);
    REQUIRE(normals);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index c = mesh.face_begin(f);
        const Vec3 n =
            normalised(cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c)));
        for (const Index w : mesh.face_wedges(f))
            for (int i = 0; i < 3; ++i)
                CHECK(normals->value(w, i) == Approx(n[static_cast<std::size_t>(i)]).margin(1e-7));
    }
}

TEST_CASE("degenerate faces split too", "[geometry]") {
    Mesh mesh = shapes::tetrahedron();
    mesh.corners.insert(mesh.corners.end(), {0, 0, 1, 2, 2, 2});
    for (const auto method : every_method) {
        const Mesh finer = split(mesh, {method, 1, 3}).mesh;
        CHECK(broken_invariants(finer).empty());
        CHECK(test::closed(finer));
    }
}

TEST_CASE("an empty mesh and no passes give back what came", "[geometry]") {
    CHECK(split(Mesh{}, {}).mesh.face_count() == 0);
    CHECK(split(shapes::cube(), {SplitMethod::midpoint, 0, 2}).mesh.corners == shapes::cube().corners);
    CHECK(grid_split(shapes::cube(), 1).mesh.corners == shapes::cube().corners);
}

TEST_CASE("a result beyond 2^31 corners is refused before it is built", "[geometry]") {
    CHECK(test::failure([] {
              split(shapes::cube(), {SplitMethod::midpoint, 14, 2});
          }) == "limit [E-LIMIT] split: the result would have about 9.66e+09 corners, but at most 2147483648 "
                "are possible | use fewer passes, a coarser grid or a longer max_edge");
}

TEST_CASE("faces that a method does not know are refused by name", "[geometry]") {
    CHECK(test::failure([] {
              split(square(), {SplitMethod::bisect, 1, 2});
          }) == "stage [E-POLYGON] split: bisect takes faces of at most 3 corners, face 0 has 4 | use "
                "triangulate first to make triangles of every face");
}
