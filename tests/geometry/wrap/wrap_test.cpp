#include "geometry/inspect/inspect.hpp"
#include "geometry/wrap/wrap.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"

using namespace facetmill;
using test::failure;

namespace {

Properties checked(const Mesh& mesh) {
    InspectSettings settings;
    settings.self_intersections = true;
    return inspect(mesh, settings);
}

/// Closed, manifold, oriented and without self-intersections; wrap itself tests that it encloses the input.
void check_sound(const WrapResult& r) {
    const Properties p = checked(r.mesh);
    CHECK(p.closed);
    CHECK(p.edge_manifold);
    CHECK(p.vertex_manifold);
    CHECK(p.oriented);
    CHECK(p.self_intersections == 0);
    CHECK(p.volume.value_or(0) > 0);
}

} // namespace

TEST_CASE("wrap: a cube gets a slightly larger closed surface", "[geometry]") {
    const WrapResult r = wrap(shapes::cube(), {0.3, 0.01});
    check_sound(r);
    const double volume = checked(r.mesh).volume.value_or(0);
    CHECK(volume > 1);
    CHECK(volume < 1.02 * 1.02 * 1.02);
    CHECK(r.components == 1);
}

TEST_CASE("wrap: soup, sheets, crossings, duplicates and points", "[geometry]") {
    Mesh soup = shapes::torus(16, 8);
    append(soup, shapes::cube());
    append(soup, shapes::cube());
    append(soup, shapes::moebius(9));
    append(soup, shapes::fan3());
    append(soup, shapes::crossing());
    Mesh needle;
    needle.positions = {{2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 5, 5}};
    needle.corners = {0, 1, 2, 3, 3, 3};
    append(soup, needle);
    check_sound(wrap(soup, {0.3, 0.03}));
    check_sound(wrap(shapes::grid(3, 3), {0.5, 0.05}));
    check_sound(wrap(needle, {0.3, 0.1}));
    Mesh cloud;
    cloud.positions = shapes::icosphere(2).positions;
    check_sound(wrap(cloud, {0.8, 0.05}));
    Mesh point;
    point.positions = {{1, 2, 3}};
    check_sound(wrap(point, {0.5, 0.1}));
    Mesh lines;
    lines.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    lines.lines = {0, 1, 1, 2};
    check_sound(wrap(lines, {0.5, 0.1}));
}

TEST_CASE("wrap: a gap narrower than alpha stays closed, a wider one opens", "[geometry]") {
    Mesh box = shapes::cube(); // without the two faces at the top
    std::vector<Index> corners;
    for (Index f = 0; f < box.face_count(); ++f) {
        bool top = true;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) top = top && box.point(c).z == 1;
        if (!top)
            corners.insert(corners.end(),
                           {box.corners[3 * f], box.corners[3 * f + 1], box.corners[3 * f + 2]});
    }
    REQUIRE(corners.size() == 30);
    box.corners = corners;
    CHECK(checked(wrap(box, {2, 0.01}).mesh).volume.value_or(0) > 0.9);
    CHECK(checked(wrap(box, {0.2, 0.01}).mesh).volume.value_or(0) < 0.3);
}

TEST_CASE("wrap: coordinates of any size, and the same bytes again", "[geometry]") {
    Mesh mesh = shapes::torus(16, 8);
    const WrapResult r = wrap(mesh, {0.25, 0.02});
    CHECK(wrap(mesh, {0.25, 0.02}).mesh.positions == r.mesh.positions);
    for (Vec3& p : mesh.positions) p *= std::ldexp(1, 600);
    const WrapResult large = wrap(mesh, {std::ldexp(0.25, 600), std::ldexp(0.02, 600)});
    CHECK(large.mesh.corners == r.mesh.corners);
    CHECK(large.mesh.positions[7] == r.mesh.positions[7] * std::ldexp(1, 600));
}

TEST_CASE("wrap: refuses nothing, and too many faces", "[geometry]") {
    CHECK(failure([] { (void)wrap(Mesh{}, {1, 1}); }).find("no points to wrap") != std::string::npos);
    CHECK(failure([] {
              (void)wrap(shapes::cube(), {1e-7, 1e-9});
          }).find("would have about") != std::string::npos);
    CHECK(failure([] {
              (void)wrap(shapes::cube(), {0.1, 0.01, 100});
          }).find("max_faces") != std::string::npos);
    CHECK(failure([] { (void)wrap(shapes::cube(), {0, 0.01}); }).find("above 0") != std::string::npos);
}

TEST_CASE("wrap: takes attributes from the nearest point", "[geometry]") {
    Mesh mesh = shapes::uv_cube();
    std::vector<float> colours;
    for (Index w = 0; w < mesh.wedge_count(); ++w) {
        const Vec3& p = mesh.positions[mesh.vertex_of_wedge(w)];
        for (std::size_t k = 0; k < 3; ++k) colours.push_back(static_cast<float>(p[k]));
    }
    mesh.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 3, false, colours});
    std::vector<std::uint32_t> group;
    for (Index f = 0; f < mesh.face_count(); ++f)
        group.push_back(mesh.point(3 * f).z == 1 && mesh.point(3 * f + 1).z == 1 &&
                        mesh.point(3 * f + 2).z == 1);
    mesh.attributes.push_back({"group", Domain::face, Role::index, 1, false, group});
    const WrapResult r = wrap(mesh, {0.3, 0.01, 5000000, true});
    const Attribute* colour = r.mesh.find("COLOR_0", Domain::wedge);
    REQUIRE(colour);
    for (Index v = 0; v < r.mesh.vertex_count(); ++v)
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(colour->value(v, static_cast<int>(k)) ==
                  Approx(std::clamp(r.mesh.positions[v][k], 0.0, 1.0)).margin(1e-5));
    const Attribute* of_face = r.mesh.find("group", Domain::face);
    REQUIRE(of_face);
    for (Index f = 0; f < r.mesh.face_count(); ++f) {
        double low = 2;
        Vec3 middle;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) {
            low = std::min(low, r.mesh.point(c).z);
            middle += r.mesh.point(c) / 3;
        }
        const bool above = middle.x > 0 && middle.x < 1 && middle.y > 0 && middle.y < 1;
        if (low > 1 && above) CHECK(of_face->value(f, 0) == 1);
        if (low < 0.5) CHECK(of_face->value(f, 0) == 0);
    }
    CHECK(!r.mesh.find("TEXCOORD_0", Domain::wedge));
    CHECK(!r.mesh.find("NORMAL", Domain::wedge));
}
