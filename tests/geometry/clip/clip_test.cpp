#include "geometry/clip/clip.hpp"

#include "base/math/numbers.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include <set>

using namespace facetmill;

namespace {

const Plane x_half{{1, 0, 0}, {0.5, 0, 0}, 0};

Mesh triangle(double a, double b, double c) {
    Mesh mesh;
    mesh.positions = {{a, 0, 0}, {b, 1, 0}, {c, 0, 1}};
    mesh.corners = {0, 1, 2};
    return mesh;
}

ClipSettings at_plane(const Plane& plane, bool cap = false) {
    ClipSettings settings;
    settings.planes = {plane};
    settings.cap = cap;
    return settings;
}

/// Sizes of the faces that stay in front of x = 0 of a triangle whose corners have these x.
std::vector<Index> sizes_in_front(double a, double b, double c) {
    const Mesh mesh = clip(triangle(a, b, c), at_plane({{1, 0, 0}, {}, 0})).front;
    CHECK(broken_invariants(mesh).empty());
    std::vector<Index> sizes;
    for (Index f = 0; f < mesh.face_count(); ++f) sizes.push_back(mesh.face_size(f));
    return sizes;
}

/// The open square from -1 to 1 in n x n cells, with unrounded coordinates.
Mesh computed_grid(int n) {
    Mesh mesh = shapes::grid(n, n);
    for (Vec3& p : mesh.positions) p = {-1 + 2.0 / n * p.x, -1 + 2.0 / n * p.y, 0};
    return mesh;
}

using Sizes = std::vector<Index>;

} // namespace

TEST_CASE("all eight sign cases of a triangle", "[geometry]") {
    CHECK(sizes_in_front(1, 1, 1) == Sizes{3});
    CHECK(sizes_in_front(-1, -1, -1) == Sizes{});
    CHECK(sizes_in_front(1, -1, -1) == Sizes{3});
    CHECK(sizes_in_front(-1, 1, -1) == Sizes{3});
    CHECK(sizes_in_front(-1, -1, 1) == Sizes{3});
    CHECK(sizes_in_front(1, 1, -1) == Sizes{4});
    CHECK(sizes_in_front(1, -1, 1) == Sizes{4});
    CHECK(sizes_in_front(-1, 1, 1) == Sizes{4});
}

TEST_CASE("every case with corners on the plane", "[geometry]") {
    CHECK(sizes_in_front(0, 1, 1) == Sizes{3});
    CHECK(sizes_in_front(0, 0, 1) == Sizes{3});
    CHECK(sizes_in_front(0, -1, -1) == Sizes{});
    CHECK(sizes_in_front(0, 0, -1) == Sizes{});
    CHECK(sizes_in_front(0, 1, -1) == Sizes{3});
    CHECK(sizes_in_front(0, -1, 1) == Sizes{3});
    CHECK(sizes_in_front(1, 0, -1) == Sizes{3});
    CHECK(sizes_in_front(0, 0, 0) == Sizes{3}); // open: kept by default
    ClipSettings drop = at_plane({{1, 0, 0}, {}, 0});
    drop.coplanar = Coplanar::drop;
    CHECK(clip(triangle(0, 0, 0), drop).front.face_count() == 0);
    drop.keep = Keep::both; // neither side keeps dropped faces
    const ClipResult both = clip(triangle(0, 0, 0), drop);
    CHECK(both.front.face_count() + both.back.face_count() == 0);
    drop.coplanar = Coplanar::keep;
    const ClipResult kept = clip(triangle(0, 0, 0), drop);
    CHECK(kept.front.face_count() + kept.back.face_count() == 1);
}

TEST_CASE("a quad is cut into what its name says", "[geometry]") {
    Mesh mesh;
    mesh.positions = {{-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.corners = {0, 1, 2, 3};
    mesh.face_offsets = {0, 4};
    const Mesh right = clip(mesh, at_plane({{1, 0, 0}, {}, 0})).front;
    REQUIRE(right.face_count() == 1);
    CHECK(right.face_size(0) == 4);
    CHECK(test::area(right) == 1);
}

TEST_CASE("a concave polygon falls apart into its pieces", "[geometry]") {
    Mesh mesh; // an M: two legs below y = 1
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 2, 0}, {3, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    mesh.corners = {0, 1, 2, 3, 4, 5, 6};
    mesh.face_offsets = {0, 7};
    ClipSettings settings = at_plane({{0, 1, 0}, {0, 1, 0}, 0});
    settings.keep = Keep::both;
    const ClipResult result = clip(mesh, settings);
    CHECK(result.front.face_count() == 1);
    CHECK(result.back.face_count() == 2);
    CHECK(test::area(result.back) == Approx(2.5));
    CHECK(test::area(result.front) + test::area(result.back) == Approx(test::area(mesh)));
}

TEST_CASE("a cube cut in half is closed by its cap", "[geometry]") {
    const ClipResult result = clip(shapes::cube(), at_plane(x_half, true));
    CHECK(broken_invariants(result.front).empty());
    CHECK(test::closed(result.front));
    CHECK(test::edge_manifold(result.front));
    CHECK(test::volume(result.front) == Approx(0.5));
    CHECK(test::area(result.front) == Approx(1 + 1 + 4 * 0.5));
    CHECK(result.open.empty());
    CHECK(result.cut_faces == 8);
}

TEST_CASE("a cube cut without a cap is open", "[geometry]") {
    const ClipResult result = clip(shapes::cube(), at_plane(x_half));
    CHECK_FALSE(test::closed(result.front));
    CHECK(result.cap_faces == 0);
    CHECK(test::area(result.front) == Approx(1 + 4 * 0.5));
}

TEST_CASE("keeping the back keeps the other side, both keeps each", "[geometry]") {
    ClipSettings settings = at_plane({{1, 0, 0}, {0.25, 0, 0}, 0}, true);
    settings.keep = Keep::back;
    CHECK(test::volume(clip(shapes::cube(), settings).back) == Approx(0.25));
    settings.keep = Keep::both;
    const ClipResult both = clip(shapes::cube(), settings);
    CHECK(test::volume(both.front) == Approx(0.75));
    CHECK(test::volume(both.back) == Approx(0.25));
    CHECK(test::closed(both.front));
    CHECK(test::closed(both.back));
}

TEST_CASE("one new vertex per cut edge, exactly on an axis-aligned plane", "[geometry]") {
    const Mesh mesh = clip(shapes::cube(), at_plane({{3, 0, 0}, {0.1, 0, 0}, 0})).front;
    CHECK(mesh.vertex_count() == 4 + 8); // four edges along x, four diagonals
    for (std::size_t v = 4; v < mesh.vertex_count(); ++v) CHECK(mesh.positions[v].x == 0.1);
}

TEST_CASE("a face in the plane of a closed mesh stays only when it looks away", "[geometry]") {
    const Plane floor{{0, 0, 1}, {0, 0, 0}, 0}, roof{{0, 0, 1}, {0, 0, 1}, 0};
    const ClipResult whole = clip(shapes::cube(), at_plane(floor, true));
    CHECK(whole.front.corners == shapes::cube().corners);
    CHECK(clip(shapes::cube(), at_plane(roof, true)).front.face_count() == 0);
    ClipSettings settings = at_plane(roof, true);
    settings.keep = Keep::back;
    CHECK(clip(shapes::cube(), settings).back.face_count() == 12);
}

TEST_CASE("a plane along a diagonal of the cube", "[geometry]") {
    const ClipResult result = clip(shapes::cube(), at_plane({{1, -1, 0}, {0, 0, 0}, 0}, true));
    CHECK(test::closed(result.front));
    CHECK(test::volume(result.front) == Approx(0.5));
    CHECK(result.on_plane == 4);
}

TEST_CASE("a plane that misses keeps everything or nothing", "[geometry]") {
    const ClipResult all = clip(shapes::cube(), at_plane({{1, 0, 0}, {-1, 0, 0}, 0}, true));
    CHECK_FALSE(all.changed);
    CHECK(all.front.corners == shapes::cube().corners);
    const ClipResult nothing = clip(shapes::uv_cube(), at_plane({{1, 0, 0}, {2, 0, 0}, 0}, true));
    CHECK(nothing.changed);
    CHECK(nothing.front.face_count() == 0);
    CHECK(broken_invariants(nothing.front).empty());
    CHECK(nothing.front.find("NORMAL", Domain::wedge));
    CHECK(clip(Mesh{}, at_plane(x_half, true)).front.face_count() == 0);
}

TEST_CASE("a hollow is capped as a ring", "[geometry]") {
    Mesh hollow = shapes::cube(), inner = shapes::cube();
    for (auto& p : inner.positions) p = p * 0.5 + Vec3{0.25, 0.25, 0.25};
    for (std::size_t c = 0; c < inner.corners.size(); c += 3)
        std::swap(inner.corners[c], inner.corners[c + 1]);
    append(hollow, inner);
    const Mesh half = clip(hollow, at_plane({{1, 0, 0}, {0.5, 0, 0}, 0}, true)).front;
    CHECK(test::closed(half));
    CHECK(test::edge_manifold(half));
    CHECK(test::volume(half) == Approx(0.5 - 0.5 * 0.125));
}

TEST_CASE("bodies that cross are capped as often as they cover", "[geometry]") {
    Mesh two = shapes::cube(), other = shapes::cube();
    for (auto& p : other.positions) p += {0, 0.5, 0.25};
    append(two, other);
    const ClipResult result = clip(two, at_plane(x_half, true));
    CHECK(broken_invariants(result.front).empty());
    CHECK(test::closed(result.front));
    CHECK(test::volume(result.front) == Approx(1));
}

TEST_CASE("bodies that touch, unwelded, stay closed", "[geometry]") {
    Mesh two = shapes::cube(), other = shapes::cube();
    for (auto& p : other.positions) p += {0, 1, 0};
    append(two, other);
    const ClipResult result = clip(two, at_plane(x_half, true));
    CHECK(test::closed(result.front));
    CHECK(test::volume(result.front) == Approx(1));
}

TEST_CASE("a doubled surface collapses to nothing and stays closed", "[geometry]") {
    Mesh mesh = triangle(-1, 1, 1);
    mesh.corners.insert(mesh.corners.end(), {0, 2, 1});
    CHECK(test::closed(clip(mesh, at_plane({{1, 0, 0}, {}, 0}, true)).front));
    Mesh apart = triangle(-1, 1, 1);
    append(apart, triangle(-1, 1, 1));
    apart.corners = {0, 1, 2, 3, 5, 4, 0, 2, 5, 0, 5, 3, 2, 1, 4, 2, 4, 5, 1, 0, 3, 1, 3, 4};
    REQUIRE(test::closed(apart));
    const ClipResult result = clip(apart, at_plane({{1, 0, 0}, {}, 0}, true));
    CHECK(test::closed(result.front));
    CHECK(result.front.face_count() > 0);
}

TEST_CASE("an open contour is named and the rest is capped", "[geometry]") {
    Mesh mesh = shapes::cube();
    mesh.corners.erase(mesh.corners.begin(), mesh.corners.begin() + 6); // without the face at z = 0
    Mesh other = shapes::cube();
    for (auto& p : other.positions) p += {0, 5, 0};
    append(mesh, other);
    const ClipResult result = clip(mesh, at_plane(x_half, true));
    REQUIRE(result.open.size() == 1);
    CHECK(result.open[0].edges == 6);
    CHECK(result.open[0].at.z == 0);
    CHECK(result.cap_faces > 0);
    CHECK(test::area(result.front) == Approx(1 + 3 * 0.5 + 0 + 1 + 1 + 4 * 0.5));
}

TEST_CASE("caps have normals, coordinates and a primitive of their own", "[geometry]") {
    ClipSettings settings = at_plane(x_half, true);
    settings.cap_primitive = Primitive{7, {}, {}};
    const ClipResult result = clip(shapes::uv_cube(), settings);
    const Mesh& mesh = result.front;
    CHECK(broken_invariants(mesh).empty());
    CHECK(test::closed(mesh));
    REQUIRE(mesh.primitives.size() == 2);
    CHECK(mesh.primitives[1].material == 7);
    const Attribute *normals = mesh.find("NORMAL", Domain::wedge),
                    *uvs = mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(normals);
    REQUIRE(uvs);
    std::size_t cap_faces = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index c = mesh.face_begin(f);
        const Vec3 n =
            normalised(cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c)));
        cap_faces += mesh.primitive_of(f) == 1;
        CHECK((mesh.primitive_of(f) == 1) == (mesh.point(c).x == 0.5 && n.x < -0.5));
        for (const Index w : mesh.face_wedges(f)) {
            for (int i = 0; i < 3; ++i)
                CHECK(normals->value(w, i) == Approx(n[static_cast<std::size_t>(i)]).margin(1e-7));
            for (int i = 0; i < 2; ++i) CHECK((uvs->value(w, i) >= 0 && uvs->value(w, i) <= 1));
        }
    }
    CHECK(cap_faces == result.cap_faces);
}

TEST_CASE("a second cap uses the same primitive", "[geometry]") {
    ClipSettings settings = at_plane(x_half, true);
    settings.planes.push_back({{0, 1, 1}, {0.5, 0.5, 0.5}, 0});
    settings.cap_primitive = Primitive{7, {}, {}};
    CHECK(clip(shapes::cube(), settings).front.primitives.size() == 2);
}

TEST_CASE("triangulated on request", "[geometry]") {
    ClipSettings settings = at_plane({{1, 2, 3}, {0.5, 0.5, 0.5}, 0}, true);
    CHECK_FALSE(clip(shapes::cube(), settings).front.all_triangles());
    settings.triangulate = true;
    const Mesh mesh = clip(shapes::cube(), settings).front;
    CHECK(mesh.all_triangles());
    CHECK(test::closed(mesh));
}

TEST_CASE("both sides of several planes are refused", "[geometry]") {
    ClipSettings settings = at_plane(x_half);
    settings.planes.push_back(x_half);
    settings.keep = Keep::both;
    CHECK(
        test::failure([&] { clip(shapes::cube(), settings); }) ==
        "usage [E-CONFLICT] clip: 'keep: both' takes exactly one plane | clip once for every plane, or keep "
        "the front "
        "or the back");
}

TEST_CASE("skin weights sum to one after a cut, of no more joints than before", "[geometry]") {
    Mesh skinned = shapes::icosphere(3);
    std::vector<std::uint8_t> joints;
    std::vector<double> weights;
    for (Index w = 0; w < skinned.wedge_count(); ++w) // ends of an edge share some joints and not others
        for (int k = 0; k < 4; ++k) {
            joints.push_back(static_cast<std::uint8_t>((w % 7 + 3 * k) % 20));
            weights.push_back((k + 1) / 10.0);
        }
    skinned.attributes.push_back({"JOINTS_0", Domain::wedge, Role::joints, 4, false, joints});
    skinned.attributes.push_back({"WEIGHTS_0", Domain::wedge, Role::weights, 4, false, weights});
    ClipSettings settings = at_plane({{1, 0.7, 0.3}, {0.1, 0.2, 0.05}, 0}, true);
    settings.keep = Keep::both;
    const ClipResult r = clip(skinned, settings);
    std::size_t mixed = 0;
    for (const Mesh* mesh : {&r.front, &r.back}) {
        const Attribute &joint = *mesh->find("JOINTS_0", Domain::wedge),
                        &weight = *mesh->find("WEIGHTS_0", Domain::wedge);
        REQUIRE(joint.components == 4);
        for (Index w = 0; w < mesh->wedge_count(); ++w) {
            double sum = 0;
            std::set<double> given;
            for (int k = 0; k < 4; ++k) {
                CHECK(weight.value(w, k) >= 0);
                sum += weight.value(w, k);
                if (weight.value(w, k) > 0) given.insert(joint.value(w, k));
            }
            CHECK(sum == Approx(1).epsilon(1e-12));
            CHECK(given.size() == 4); // no joint twice
            mixed += weight.value(w, 0) != 0.1;
        }
    }
    CHECK(mixed > 100);
}

TEST_CASE("numbers that no rounding has made are not snapped, however far apart floats are there",
          "[geometry]") {
    Mesh strip; // at whole metres in UTM, where floats have steps of half a metre
    for (Index i = 0; i < 40; ++i) {
        strip.positions.push_back({0, 5400000.0 + 2.0 * i, 0});
        strip.positions.push_back({2, 5400000.0 + 2.0 * i, 0});
    }
    for (Index i = 0; i + 3 < strip.positions.size(); i += 2)
        for (const Index v : {i, i + 1, i + 3, i, i + 3, i + 2}) strip.corners.push_back(v);
    ClipSettings settings = at_plane({{0, 1, 0}, {0, 5400010.3, 0}, 0});
    settings.snap = true;
    const ClipResult cut = clip(strip, settings);
    CHECK(cut.snapped == 0);
    CHECK(cut.front.bounds().min.y == 5400010.3);
}

TEST_CASE("the rounding of floats counts along the plane's normal", "[geometry]") {
    Mesh building = shapes::cube();
    for (Vec3& p : building.positions) p = Vec3{20 * p.x, 10 * p.y, 3 * p.z} + Vec3{500000, 4649770, 0};
    const auto below = [](const Mesh& mesh, const Vec3& normal, double at) {
        ClipSettings settings = at_plane({normal, normal * at, 0});
        settings.keep = Keep::back;
        settings.cap = settings.snap = true;
        return clip(mesh, settings);
    };
    CHECK(test::volume(test::moved(below(building, {0, 0, 1}, 2.9).back, {-500000, -4649770, 0})) ==
          Approx(580));
    CHECK(test::volume(test::moved(below(building, {0, 0, 1}, 0.3).back, {-500000, -4649770, 0})) ==
          Approx(60));
    CHECK(below(building, {0, 1, 0}, 4649770.2).snapped == 0); // whole metres were not rounded
    Mesh rounded = shapes::cube();
    for (Vec3& p : rounded.positions) p = as_float32(p * 10.3 + Vec3{450000, 5400000, 0});
    CHECK(below(rounded, {0, 1, 0}, 5400010.3).snapped == 4);
    CHECK(below(rounded, {0, 1, 0}, 5400010.2).snapped == 0); // floats are rounded by 0.25 there
    CHECK(below(rounded, {1, 0, 0}, 450010.3).snapped == 4);
    CHECK(below(rounded, {1, 0, 0}, 450010.2).snapped == 0);
    CHECK(below(rounded, {0, 0, 1}, 10.3).snapped == 4);
    CHECK(below(rounded, {0, 0, 1}, 10.29).snapped == 0);
}

namespace {

void check_capped(const Mesh& mesh) {
    CHECK(test::closed(mesh));
    CHECK(test::edge_manifold(mesh));
    CHECK(inspect(mesh).vertex_manifold);
    CHECK(find_self_intersections(mesh, {.separate_touching = true}).count == 0);
}

} // namespace

TEST_CASE("a vertex that lies on the plane from one side becomes a corner of the cap", "[geometry]") {
    Mesh grid = shapes::grid(4, 4);
    for (Vec3& p : grid.positions) p.z = p.x == 2 && p.y == 2 ? 1 : 2;
    ClipSettings settings = at_plane({{0, 0, 1}, {0, 0, 1}, 0});
    settings.cap = true;
    const ClipResult pit = clip(test::solid_below(grid), settings);
    check_capped(pit.front);
    CHECK(test::volume(pit.front) == Approx(15)); // the pit is a cone of height 1 over six half squares
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        Mesh terrain = shapes::grid(8, 8);
        for (std::size_t v = 0; v < terrain.positions.size(); ++v)
            terrain.positions[v].z = std::floor(test::between(1, 6, seed, v));
        const Mesh solid = test::solid_below(terrain);
        settings.planes = {{{0, 0, 1}, {0, 0, 3}, 0}};
        settings.keep = Keep::both;
        const ClipResult cut = clip(solid, settings);
        check_capped(cut.front);
        check_capped(cut.back);
        CHECK(test::volume(cut.front) + test::volume(cut.back) == Approx(test::volume(solid)));
    }
}

TEST_CASE("a plane through computed vertices cuts no slivers off at them", "[geometry]") {
    const Mesh grid = computed_grid(10);
    ClipSettings settings = at_plane({{1, 1, 0}, {0.2, 0, 0}, 0});
    const ClipResult pure = clip(grid, settings);
    REQUIRE(pure.cut_faces > 18); // vertices are slightly off the plane because of rounding
    settings.snap = true;
    const ClipResult snapped = clip(grid, settings);
    CHECK(snapped.snapped > 0);
    CHECK(snapped.cut_faces == 18); // nine cells, from corner to corner, across their diagonals
    CHECK(inspect(snapped.front).degenerate_faces == 0);
    settings.planes[0].through = {0.2 + 1e-12, 0, 0}; // too far for rounding
    CHECK(clip(grid, settings).snapped == 0);
}
