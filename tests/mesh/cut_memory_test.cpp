#include "geometry/clip/clip.hpp"

#include "base/random.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/measure.hpp"

using namespace facetmill;

namespace {

const Plane oblique{{1, 0.7, 0.3}, {0.1, 0.2, 0.05}, 0};

ClipSettings capped(const Plane& plane) {
    ClipSettings settings;
    settings.planes = {plane};
    settings.cap = true;
    return settings;
}

std::size_t exactly_on(const Mesh& mesh, const Plane& plane) {
    std::size_t count = 0;
    for (const Vec3& p : mesh.positions) count += side(plane, p) == 0;
    return count;
}

} // namespace

TEST_CASE("a plane that comes again finds its points on it", "[geometry]") {
    const ClipResult first = clip(shapes::icosphere(3), capped(oblique));
    // What the memory is for: the rounded points do not lie on the plane.
    REQUIRE(exactly_on(first.front, oblique) < 10);
    ClipSettings again = capped(oblique);
    again.memory = first.memory;
    const ClipResult second = clip(first.front, again);
    CHECK(second.cut_faces == 0);
    CHECK(second.remembered > 80);
    CHECK(second.front.positions == first.front.positions);
    CHECK(second.front.corners == first.front.corners);
}

TEST_CASE("... however it is written", "[geometry]") {
    const ClipResult first = clip(shapes::icosphere(3), capped(oblique));
    Plane reversed{oblique.normal * -2, oblique.through, 0};
    CHECK(same_plane(oblique, reversed));
    ClipSettings again = capped(reversed);
    again.keep = Keep::back;
    again.memory = first.memory;
    CHECK(clip(first.front, again).cut_faces == 0);
    again.memory = {};
    CHECK(clip(first.front, again).cut_faces > 0); // without memory slivers come off
}

TEST_CASE("the same plane twice in one clip is cut once", "[geometry]") {
    ClipSettings settings = capped(oblique);
    settings.planes.push_back(oblique);
    const ClipResult twice = clip(shapes::torus(40, 30), settings);
    CHECK(twice.front.positions == clip(shapes::torus(40, 30), capped(oblique)).front.positions);
}

TEST_CASE("points of two planes are remembered on both", "[geometry]") {
    const Plane other{{-0.2, 1, 0.4}, {0, 0.1, 0}, 0};
    ClipSettings settings = capped(oblique);
    settings.planes.push_back(other);
    const ClipResult two = clip(shapes::icosphere(3), settings);
    std::size_t on_both = 0;
    const auto *a = two.memory.find(oblique), *b = two.memory.find(other);
    REQUIRE(a);
    REQUIRE(b);
    for (const Vec3& p : two.front.positions) on_both += a->counts_as_on(p) && b->counts_as_on(p);
    CHECK(on_both > 10); // the edge where the caps meet, cut at every diagonal of the first
    for (const Plane& plane : {oblique, other}) {
        ClipSettings again = capped(plane);
        again.memory = two.memory;
        CHECK(clip(two.front, again).cut_faces == 0);
    }
}

TEST_CASE("a point that is moved is forgotten", "[geometry]") {
    const ClipResult first = clip(shapes::icosphere(3), capped(oblique));
    Mesh moved = first.front;
    for (Vec3& p : moved.positions) p.z = std::nextafter(p.z, 10);
    ClipSettings again = capped(oblique);
    again.memory = first.memory;
    CHECK(clip(moved, again).remembered == 0);
}

TEST_CASE("planes are the same exactly or not at all", "[geometry]") {
    const Plane p{{0, 0, 1}, {0, 0, 0.1}, 0};
    CHECK(same_plane(p, {{0, 0, -3}, {5, 7, 0.1}, 0}));
    CHECK(same_plane(p, {{0, 0, 1}, {}, -0.1}));
    CHECK(same_plane(p, {{0, 0, -4}, {}, 0.4}));       // 0.4 is the double 4 * 0.1
    CHECK_FALSE(same_plane(p, {{0, 0, 3}, {}, -0.3})); // 0.3 is not 3 * 0.1
    CHECK_FALSE(same_plane(p, {{0, 1e-300, 1}, {0, 0, 0.1}, 0}));
    CHECK_FALSE(same_plane(p, {{0, 0, 1}, {0, 0, std::nextafter(0.1, 1)}, 0}));
}

TEST_CASE("snap takes float32 positions beside the plane as on it", "[geometry]") {
    Mesh cube = shapes::cube(); // as an STL has it: the floats of 0 and 0.1
    for (Vec3& p : cube.positions)
        for (std::size_t i = 0; i < 3; ++i) p[i] = static_cast<float>(p[i] * 0.1);
    const Plane roof{{0, 0, 1}, {0, 0, 0.1}, 0};
    REQUIRE(cube.bounds().max.z != 0.1);
    ClipSettings settings = capped(roof);
    CHECK(clip(cube, settings).front.face_count() > 0); // pure: a sliver is cut off
    settings.snap = true;
    const ClipResult snapped = clip(cube, settings);
    CHECK(snapped.snapped == 4);
    CHECK(snapped.cut_faces == 0);
    CHECK(snapped.front.face_count() == 0);
    settings.keep = Keep::back;
    CHECK(test::volume(clip(cube, settings).back) == test::volume(cube));
    // One float32 ulp of the bounds, and no more.
    settings.planes[0].through.z = 0.1 - 3e-8;
    CHECK(clip(cube, settings).cut_faces > 0);
}

TEST_CASE("snap leaves positions alone that no float32 has", "[geometry]") {
    Mesh cube = shapes::cube();
    for (Vec3& p : cube.positions) p = p * 0.1;
    ClipSettings settings = capped({{0, 0, 1}, {0, 0, 0.1 - 1e-9}, 0});
    settings.snap = true;
    CHECK(clip(cube, settings).snapped == 0);
    CHECK(clip(cube, settings).front.face_count() > 0);
}

TEST_CASE("snapped and remembered meshes stay closed with a huge or a tiny normal", "[geometry]") {
    for (const double scale : {1e-150, 1.0, 1e150}) {
        ClipSettings settings = capped({oblique.normal * scale, oblique.through, 0});
        settings.snap = true;
        settings.planes.push_back({{0, scale, 0}, {}, 0});
        const ClipResult r = clip(shapes::icosphere(2), settings);
        CHECK(broken_invariants(r.front).empty());
        CHECK(test::closed(r.front));
        CHECK(test::volume(r.front) > 0.5);
    }
}

namespace {

/// Many planes along and across each other, some twice and written otherwise, each with points on it and some
/// beside it.
std::vector<CutMemory::Entry> many_entries() {
    std::vector<CutMemory::Entry> entries;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const auto number = [&](std::uint64_t k) { return uniform(hashed(i % 200, k)) * 2 - 1; };
        Plane plane{
            {number(0), number(1), i % 200 % 3 == 0 ? 0 : number(2)}, {number(3), number(4), number(5)}, 0};
        if (i % 5 == 0) plane = {{0, 0, 1}, {0, 0, static_cast<double>(i % 40)}, 0};
        const Vec3 along = cross(plane.normal, Vec3{0.3, 0.2, 0.9});
        const Vec3 at = plane.through + along * number(6);
        if (i >= 200) plane.normal = plane.normal * -4;
        entries.push_back({plane, 0, {at, plane.through, at + along}});
    }
    return entries;
}

} // namespace

TEST_CASE("many planes are remembered at once as they are one by one", "[geometry]") {
    CutMemory one_by_one, at_once;
    std::size_t i = 0;
    for (const auto& e : many_entries()) {
        one_by_one.add(e.plane, e.points);
        if (++i == 10) at_once = one_by_one; // some are known before
    }
    auto rest = many_entries();
    rest.erase(rest.begin(), rest.begin() + 10);
    at_once.add_all(std::move(rest));
    REQUIRE(at_once.entries.size() == one_by_one.entries.size());
    CHECK(at_once.entries.size() <= 200); // those after the 200th are known
    for (std::size_t e = 0; e < at_once.entries.size(); ++e) {
        CHECK(at_once.entries[e].plane == one_by_one.entries[e].plane);
        CHECK(at_once.entries[e].points == one_by_one.entries[e].points);
        CHECK(at_once.entries[e].reach == one_by_one.entries[e].reach);
    }
}

TEST_CASE("the planes that points count as on are found among many", "[geometry]") {
    CutMemory memory;
    memory.add_all(many_entries());
    std::vector<Vec3> points;
    for (const auto& e : many_entries()) points.insert(points.end(), e.points.begin(), e.points.end());
    for (std::uint64_t k = 0; k < 100; ++k)
        points.push_back({uniform(hashed(7, k)), uniform(hashed(8, k)), 0});
    const auto found = memory.entries_at(points);
    REQUIRE(found.size() == points.size());
    std::size_t pairs = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t e = 0; e < memory.entries.size(); ++e)
            if (memory.entries[e].counts_as_on(points[p])) expected.push_back(e);
        CHECK(found[p] == expected);
        pairs += expected.size();
    }
    CHECK(pairs >= 900);
}
