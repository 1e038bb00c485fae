#include "support/catch.hpp"

#include "mesh/invariants.hpp"
#include "mesh/position_hash.hpp"
#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

using namespace facetmill;

namespace {

using Strings = std::vector<std::string>;

Mesh polygon(const std::vector<Vec3>& points) {
    Mesh mesh;
    mesh.positions = points;
    std::vector<Index> face(points.size());
    for (Index i = 0; i < face.size(); ++i) face[i] = i;
    add_face(mesh, face);
    return mesh;
}

double area_z(const Mesh& mesh) {
    double sum = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index c = mesh.face_begin(f);
        sum += cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c)).z / 2;
    }
    return sum;
}

double shoelace(const std::vector<Vec3>& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += cross(p[i], p[(i + 1) % p.size()]).z / 2;
    return sum;
}

bool all_turn_left(const Mesh& mesh) {
    for (Index c = 0; c < mesh.corner_count(); c += 3)
        if (cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c)).z <= 0) return false;
    return true;
}

Attribute face_numbers(const char* name, std::vector<std::uint32_t> numbers) {
    return {name, Domain::face, Role::index, 1, false, std::move(numbers)};
}

} // namespace

TEST_CASE("every shape keeps the invariants", "[mesh]") {
    using namespace shapes;
    for (const Mesh& mesh :
         {tetrahedron(), cube(), quad_cube(), uv_cube(), octahedron(), icosphere(2), torus(8, 5), grid(3, 2),
          open_cone(7), bowtie(), fan3(), hourglass(), moebius(9), crossing(), folded_quad()})
        CHECK(broken_invariants(mesh).empty());
}

TEST_CASE("invariants say what is broken", "[mesh]") {
    Mesh mesh = shapes::cube();
    mesh.corners[4] = 99;
    mesh.positions[3].x = NAN;
    mesh.attributes.push_back({"quality", Domain::vertex, Role::generic, 1, false, std::vector<float>(3)});
    CHECK(broken_invariants(mesh) == Strings{"corners that refer to no wedge: 1, first 4",
                                             "positions that are not finite: 1, first 3",
                                             "vertex attribute quality holds 3 numbers, not 8"});
    Mesh offsets = shapes::tetrahedron();
    offsets.face_offsets = {0, 3, 6, 9, 12};
    CHECK(broken_invariants(offsets) == Strings{"face_offsets are stored though all faces are triangles"});
    normalise_offsets(offsets);
    CHECK(broken_invariants(offsets).empty());
}

TEST_CASE("invariants of a scene name the part", "[mesh]") {
    Scene scene;
    scene.parts.push_back({.name = "lid", .mesh = shapes::bowtie()});
    scene.parts[0].mesh.corners.pop_back();
    CHECK(broken_invariants(scene) ==
          Strings{"part 0 (lid): 5 corners of triangles are not a multiple of three"});
}

TEST_CASE("a polygon after triangles makes offsets", "[mesh]") {
    Mesh mesh = shapes::tetrahedron();
    const Index quad[] = {0, 1, 2, 3};
    add_face(mesh, quad);
    CHECK(mesh.face_offsets == std::vector<Index>{0, 3, 6, 9, 12, 16});
    CHECK(broken_invariants(mesh).empty());
}

TEST_CASE("drop_unused drops wedges and vertices with their attributes", "[mesh]") {
    Mesh mesh = shapes::uv_cube();
    mesh.corners.resize(6); // the bottom: wedges 0..3 on vertices 0, 2, 3, 1
    mesh.attributes.push_back(
        {"quality", Domain::vertex, Role::generic, 1, false, std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7}});
    drop_unused(mesh);
    CHECK(broken_invariants(mesh).empty());
    CHECK(mesh.vertex_count() == 4);
    CHECK(mesh.wedge_vertex == std::vector<Index>{0, 2, 3, 1});
    CHECK(std::get<std::vector<float>>(mesh.find("quality", Domain::vertex)->data) ==
          std::vector<float>{0, 1, 2, 3});
    CHECK(mesh.find("TEXCOORD_0", Domain::wedge)->size() == 4);
}

TEST_CASE("drop_unused without seams", "[mesh]") {
    Mesh mesh = shapes::grid(1, 1);
    mesh.positions.insert(mesh.positions.begin(), {9, 9, 9});
    for (Index& c : mesh.corners) ++c;
    drop_unused(mesh);
    CHECK(mesh.positions == shapes::grid(1, 1).positions);
    CHECK(mesh.corners == shapes::grid(1, 1).corners);
}

TEST_CASE("weld_exact joins vertices in the order of their first occurrence", "[mesh]") {
    const Mesh cube = shapes::cube();
    Mesh soup;
    for (const Index c : cube.corners) {
        soup.corners.push_back(static_cast<Index>(soup.positions.size()));
        soup.positions.push_back(cube.positions[c]);
    }
    soup.positions[0].x = -0.0;
    CHECK(weld_exact(soup) == 28);
    CHECK(soup.vertex_count() == 8);
    CHECK_FALSE(soup.has_seams());
    CHECK(soup.corners[0] == 0);
    for (Index c = 0; c < 36; ++c) CHECK(soup.point(c) == cube.point(c));
    CHECK(weld_exact(soup) == 0);
}

TEST_CASE("number_places counts by first occurrence, for any number of threads and any guess", "[mesh]") {
    // 30,000 positions in a permuted order, then all of them repeatedly. Every second point repeats a recent
    // position.
    const std::size_t places = 30000;
    const auto place_of = [&](std::size_t i) {
        return i < places ? i : (i % 2 == 0 ? i : i / 32 * 32) * 7919 % places;
    };
    const auto point = [&](std::size_t i) {
        const auto k = static_cast<std::uint32_t>(place_of(i));
        return FloatBits{k, k / 2, 7};
    };
    for (const int count : {1, 2, 3})
        for (const std::size_t guess : {std::size_t{1}, places}) {
            set_threads(count);
            std::vector<Index> number(5 * places), first(places);
            const auto found = number_places(
                number, guess, point, [&](std::size_t n) { return n == places; },
                [&](Index place, std::size_t i, const FloatBits& key) {
                    first[place] = key == point(i) ? static_cast<Index>(i) : none;
                });
            bool same = found == places;
            for (std::size_t i = 0; i < number.size(); ++i) same &= number[i] == place_of(i);
            for (std::size_t i = 0; i < places; ++i) same &= first[i] == i;
            CHECK(same);
        }
    set_threads(0);
}

TEST_CASE("weld_exact finds what is equal among many, few of them or most", "[mesh]") {
    const std::size_t n = 50000;
    for (const std::size_t places : {n, n - 3, n / 2, std::size_t{7}})
        for (const int count : {1, 2, 3}) {
            set_threads(count);
            Mesh mesh;
            std::vector<std::size_t> place(n);
            for (std::size_t v = 0; v < n; ++v) {
                place[v] = v < places ? v : (v - places) * 7919 % places;
                const auto x = static_cast<double>(place[v]);
                mesh.positions.push_back({x / 3, v % 2 == 0 ? -0.0 : 0.0, -x});
                mesh.corners.push_back(static_cast<Index>(v));
            }
            CHECK(weld_exact(mesh) == n - places);
            REQUIRE(mesh.vertex_count() == places);
            bool same = true;
            for (std::size_t v = 0; v < n; ++v) same &= mesh.corners[v] == place[v];
            CHECK(same);
        }
    set_threads(0);
}

TEST_CASE("weld_exact keeps wedges with attributes apart", "[mesh]") {
    const Mesh mesh = shapes::uv_cube();
    Mesh split;
    split.corners = mesh.corners;
    split.attributes = mesh.attributes;
    for (const Index v : mesh.wedge_vertex) split.positions.push_back(mesh.positions[v]);
    CHECK(weld_exact(split) == 16);
    CHECK(split.wedge_count() == 24);
    CHECK(broken_invariants(split).empty());
    CHECK(build_edges(split).size() == 18);
}

TEST_CASE("positions that are not numbers are never welded", "[mesh]") {
    Mesh mesh = shapes::bowtie();
    mesh.positions[1] = mesh.positions[2] = {NAN, 0, 0};
    CHECK(weld_exact(mesh) == 0);
}

TEST_CASE("triangulated cuts quads along the shorter diagonal, ties at the first corner", "[mesh]") {
    CHECK(triangulated(polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})).corners ==
          std::vector<Index>{0, 1, 2, 0, 2, 3});
    CHECK(triangulated(polygon({{0, 0, 0}, {1, 0, 0}, {3, 1, 0}, {0, 1, 0}})).corners ==
          std::vector<Index>{1, 2, 3, 1, 3, 0});
}

TEST_CASE("triangulated cuts a concave quad inside", "[mesh]") {
    CHECK(all_turn_left(triangulated(polygon({{0, 0, 0}, {2, -1, 0}, {0.1, 0.1, 0}, {-1, 2, 0}}))));
    CHECK(all_turn_left(triangulated(polygon({{2, -1, 0}, {0.1, 0.1, 0}, {-1, 2, 0}, {0, 0, 0}}))));
}

TEST_CASE("triangulated cuts concave polygons by ears", "[mesh]") {
    const Mesh comb = polygon({{0, 0, 0},
                               {9, 0, 0},
                               {9, 5, 0},
                               {8, 1, 0},
                               {7, 5, 0},
                               {6, 1, 0},
                               {5, 5, 0},
                               {4, 1, 0},
                               {3, 5, 0},
                               {2, 1, 0},
                               {0, 5, 0}});
    const Mesh cut = triangulated(comb);
    CHECK(cut.face_count() == 9);
    CHECK(all_turn_left(cut));
    CHECK(area_z(cut) == Approx(shoelace(comb.positions)).epsilon(1e-14));
}

TEST_CASE("triangulated ends on a polygon that crosses itself", "[mesh]") {
    const Mesh cut =
        triangulated(polygon({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {1, 3, 0}, {-1, 1, 0}}));
    CHECK(cut.face_count() == 4);
    CHECK(broken_invariants(cut).empty());
}

TEST_CASE("triangulated keeps a closed polygon mesh closed, and copies face attributes", "[mesh]") {
    Mesh mesh = shapes::quad_cube();
    mesh.attributes.push_back(face_numbers("group", {0, 1, 2, 3, 4, 5}));
    const Mesh cut = triangulated(mesh);
    CHECK(broken_invariants(cut).empty());
    CHECK(build_edges(cut).size() == 18);
    CHECK(std::get<std::vector<std::uint32_t>>(cut.attributes[0].data) ==
          std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5});
}

TEST_CASE("append joins polygons with triangles and seams with none", "[mesh]") {
    Mesh a = shapes::quad_cube();
    append(a, shapes::uv_cube());
    CHECK(broken_invariants(a).empty());
    CHECK(a.face_count() == 18);
    CHECK(a.wedge_count() == 32);
    CHECK(a.find("NORMAL", Domain::wedge)->value(0, 2) == Approx(-1 / std::sqrt(3.0)));
    CHECK(a.find("TEXCOORD_0", Domain::wedge)->value(0, 0) == 0);
    CHECK(a.find("NORMAL", Domain::wedge)->value(8, 2) == -1);
    CHECK(a.primitives.size() == 2);
    CHECK(a.primitive_of(5) == 0);
    CHECK(a.primitive_of(6) == 1);
}

TEST_CASE("what has no attributes looks as before beside what has some", "[mesh]") {
    Mesh coloured = shapes::cube();
    coloured.attributes.push_back(
        {"COLOR_0", Domain::wedge, Role::colour, 4, true, std::vector<std::uint8_t>(32, 7)});
    for (const bool first : {true, false}) {
        Mesh a = first ? shapes::cube() : coloured;
        append(a, first ? coloured : shapes::cube());
        CHECK(broken_invariants(a).empty());
        const auto& colours = std::get<std::vector<std::uint8_t>>(a.find("COLOR_0", Domain::wedge)->data);
        const std::size_t plain = first ? 0 : 32;
        CHECK(std::vector(colours.begin() + plain, colours.begin() + plain + 32) ==
              std::vector<std::uint8_t>(32, 255));
        CHECK(colours[32 - plain] == 7);
        const Index face = first ? 0 : 12;
        CHECK(a.primitives.at(a.primitive_of(face)).attributes == std::vector<std::string>{"POSITION"});
        CHECK(a.primitives.at(a.primitive_of(12 - face)).attributes == std::vector<std::string>{"COLOR_0"});
    }
}

TEST_CASE("append keeps equal primitives once", "[mesh]") {
    Mesh a = shapes::cube(), b = shapes::cube();
    a.primitives = {{0, {}, ""}};
    b.primitives = {{1, {}, ""}, {0, {}, ""}};
    b.attributes.push_back(face_numbers("primitive", {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
    append(a, b);
    CHECK(broken_invariants(a).empty());
    CHECK(a.primitives.size() == 2);
    CHECK(a.primitives[a.primitive_of(12)].material == 1);
    CHECK(a.primitives[a.primitive_of(23)].material == 0);
    CHECK(a.primitive_of(0) == a.primitive_of(23));
}

TEST_CASE("append of several plain primitives to one leaves no numbers of them", "[mesh]") {
    Mesh a = shapes::cube(), b = shapes::cube();
    b.primitives = {{}, {}};
    b.attributes.push_back(face_numbers("primitive", {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
    append(a, b);
    CHECK(broken_invariants(a).empty());
    CHECK(a.primitive_of(23) == 0);
}

TEST_CASE("append to itself and to nothing", "[mesh]") {
    Mesh a = shapes::cube(), empty;
    append(a, a);
    CHECK(a.face_count() == 24);
    CHECK(face_components(a).count == 2);
    append(empty, a);
    CHECK(empty.corners == a.corners);
}

TEST_CASE("append widens attributes of different types", "[mesh]") {
    Mesh a = shapes::bowtie(), b = shapes::bowtie();
    a.attributes.push_back({"q", Domain::face, Role::generic, 1, true, std::vector<std::uint8_t>{255, 0}});
    b.attributes.push_back({"q", Domain::face, Role::generic, 2, false, std::vector<float>{1, 2, 3, 4}});
    append(a, b);
    CHECK(broken_invariants(a).empty());
    CHECK(std::get<std::vector<double>>(a.attributes[0].data) == std::vector<double>{1, 0, 0, 0, 1, 2, 3, 4});
}

TEST_CASE("recompute_normals keeps the seams of normals", "[mesh]") {
    Mesh mesh = shapes::uv_cube();
    const Mesh before = mesh;
    for (auto& p : mesh.positions) p.x *= 2;
    const auto change = recompute_normals(mesh);
    REQUIRE(change);
    CHECK(change->kind == AttributeChange::Kind::recomputed);
    CHECK(mesh.find("NORMAL", Domain::wedge)->data == before.find("NORMAL", Domain::wedge)->data);
    Mesh without = shapes::cube();
    CHECK_FALSE(recompute_normals(without));
}

TEST_CASE("apply moves normals as planes move, and turns faces when it mirrors", "[mesh]") {
    Mesh mesh = shapes::uv_cube();
    Transform t;
    t.m[0][0] = -2;
    t.m[0][1] = 1;
    t.m[1][3] = 5;
    apply(mesh, t);
    CHECK(broken_invariants(mesh).empty());
    Mesh expected = mesh;
    recompute_normals(expected);
    const auto &found = *mesh.find("NORMAL", Domain::wedge), &right = *expected.find("NORMAL", Domain::wedge);
    for (std::size_t w = 0; w < mesh.wedge_count(); ++w)
        for (int c = 0; c < 3; ++c) CHECK(found.value(w, c) == Approx(right.value(w, c)).margin(1e-6));
}

TEST_CASE("units are spelled and named", "[mesh]") {
    for (const Unit u :
         {Unit::unknown, Unit::um, Unit::mm, Unit::cm, Unit::m, Unit::km, Unit::inch, Unit::foot})
        CHECK(unit_named(to_string(u)) == u);
    CHECK(metres(Unit::inch) == 0.0254);
    CHECK(metres(Unit::unknown) == 0);
    CHECK_FALSE(unit_named("parsec"));
}

TEST_CASE("the bounds of a scene are in world space", "[mesh]") {
    Scene scene;
    scene.parts.push_back({.name = "a", .mesh = shapes::cube()});
    scene.parts.push_back({.name = "b", .mesh = shapes::cube()});
    scene.parts[1].transform.m[0][3] = 5;
    CHECK(scene.bounds().max == Vec3{6, 1, 1});
    CHECK(scene.bounds().min == Vec3{0, 0, 0});
    CHECK(scene.face_count() == 24);
}
