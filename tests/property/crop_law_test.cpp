// The law of capped crops: closed stays closed, and the two sides add up. Over built meshes, and over real
// and hard ones when FACETMILL_CORPUS names a folder of them.
#include "base/math/portable_math.hpp"
#include "base/math/random.hpp"
#include "geometry/crop/crop.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/float32_ulp.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/corpus.hpp"
#include "support/meshes.hpp"
#include "support/sums.hpp"

#include <algorithm>
#include <iostream>

using namespace facetmill;
namespace fs = std::filesystem;

namespace {

using Rings = std::vector<std::vector<Vec2>>;

double outline_number(std::uint64_t key, std::uint64_t which) {
    return uniform(hashed(hashed(41, key), which));
}

std::vector<Vec2> star(const Vec2& centre, const Vec2& radius, int points, double turn) {
    std::vector<Vec2> ring;
    for (int i = 0; i < 2 * points; ++i) {
        const double angle = pi * i / points + turn, r = i % 2 == 0 ? 1 : 0.45;
        ring.push_back(centre + Vec2{radius.x * r * cosine(angle), radius.y * r * sine(angle)});
    }
    return ring;
}

/// A star with a hole, and an island next to it. Every third has corners on vertices of the mesh. Every
/// third is an axis-aligned rectangle through two vertices, with straight corners on its sides.
Rings some_outline(std::uint64_t key, const Mesh& mesh, const Box& box, std::size_t axis) {
    const Vec2 low = seen_along(axis, box.min), extent = seen_along(axis, box.extent());
    const auto at = [&](double u, double v) { return low + Vec2{u * extent.x, v * extent.y}; };
    const auto vertex = [&](std::uint64_t which) {
        return seen_along(axis, mesh.positions[hashed(hashed(43, key), which) % mesh.vertex_count()]);
    };
    const Vec2 centre = at(0.3 + 0.4 * outline_number(key, 0), 0.3 + 0.4 * outline_number(key, 1));
    if (key % 3 == 2) {
        const Vec2 p = vertex(0), q = vertex(1);
        if (p.x != q.x && p.y != q.y)
            return {
                {p, {p.x + (q.x - p.x) / 3, p.y}, {q.x, p.y}, q, {p.x + (q.x - p.x) * 0.7, q.y}, {p.x, q.y}}};
    }
    Rings rings{star(centre, extent * 0.4, 3 + static_cast<int>(key % 5), outline_number(key, 2)),
                star(centre, extent * 0.12, 3, outline_number(key, 3)),
                star(at(0.05, 0.05), extent * 0.02, 4, 0)};
    if (key % 3 == 1) rings = {{vertex(0), vertex(1), vertex(2)}};
    return rings;
}

struct CropCounts {
    std::size_t files = 0, meshes = 0, crops = 0, caps = 0, refused = 0, skipped = 0, matched = 0;
};

CropResult cropped(const Mesh& mesh, const Footprint& footprint, std::size_t axis, polygon::Keep keep,
                   bool snap) {
    CropSettings settings;
    settings.axis = axis;
    settings.keep = keep;
    settings.cap = true;
    settings.snap = snap;
    return crop(mesh, footprint, settings);
}

/// Whether the reversed walls of the inside are the walls of the outside, except for triangles between
/// coincident points.
bool walls_match(const CropResult& in, const CropResult& out) {
    const auto walls = [](const CropResult& r, bool turned) {
        std::vector<std::array<std::array<double, 3>, 3>> all;
        const std::size_t faces = r.mesh.face_count();
        for (std::size_t f = faces - r.cap_faces; f < faces; ++f) {
            const Index c = r.mesh.face_begin(static_cast<Index>(f));
            std::array<std::array<double, 3>, 3> t{};
            for (Index k = 0; k < 3; ++k) {
                const Vec3& p = r.mesh.point(c + (turned ? 2 - k : k));
                t[k] = {p.x, p.y, p.z};
            }
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
            all.push_back(t);
        }
        std::sort(all.begin(), all.end());
        return all;
    };
    return walls(in, true) == walls(out, false);
}

void check_crop(const Mesh& mesh, const Properties& whole, std::uint64_t key, CropCounts& counts) {
    const std::size_t axis = key / 3 % 3;
    CAPTURE(key, mesh.face_count());
    std::optional<Footprint> footprint;
    try {
        footprint.emplace(some_outline(key, mesh, whole.bounds, axis));
    } catch (const Error&) { // vertices in one line, or a flat mesh
        ++counts.skipped;
        return;
    }
    const CropResult in = cropped(mesh, *footprint, axis, polygon::Keep::inside, key % 2 == 1),
                     out = cropped(mesh, *footprint, axis, polygon::Keep::outside, key % 2 == 1);
    ++counts.crops;
    counts.caps += in.cap_faces > 0;
    const Properties front = inspect(in.mesh), back = inspect(out.mesh);
    CHECK(in.open.empty());
    CHECK(front.closed);
    CHECK(back.closed);
    CHECK(broken_invariants(in.mesh).empty());
    CHECK(broken_invariants(out.mesh).empty());
    counts.matched += walls_match(in, out);
    if (!mesh.all_triangles()) return; // a bent face has no defined volume below it
    const Vec3 o = whole.bounds.centre();
    const double reach = length(whole.bounds.min) + length(whole.bounds.max);
    const auto lost =
        test::volume_about(in.mesh, o) + test::volume_about(out.mesh, o) - test::volume_about(mesh, o);
    // A vertex that snap puts on a wall is at most one float32 ulp off it. The same holds for the ends of an
    // edge on the wall. If the closing joins them, the vertex is at most two ulps off the edge. The
    // triangles made by this stay equally near to the flat face. Both sides together have each face once, so
    // they gain or lose at most that times the area. Without snapping the error is 0.
    const double bent = in.snapped > 0 ? 2 * float32_ulp(whole.bounds) * whole.area : 0;
    CAPTURE(in.snapped, out.snapped);
    CHECK(in.snapped == out.snapped);
    CHECK(std::fabs(static_cast<double>(lost)) <=
          8 * 2.2e-16 * reach * (whole.area + front.area + back.area) + bent);
}

/// A flower that bends little at its corners, where the planes of neighbouring segments meet far from where
/// they should, for rounding.
Rings bent_little(std::uint64_t key) {
    const Vec2 centre{0.6 * outline_number(key, 0) - 0.3, 0.6 * outline_number(key, 1) - 0.3};
    const double radius = 0.3 + 0.4 * outline_number(key, 2);
    std::vector<Vec2> ring;
    for (int i = 0; i < 1000; ++i) {
        const double angle = 2 * pi * i / 1000;
        ring.push_back(centre + Vec2{cosine(angle), sine(angle)} * (radius + 0.05 * sine(9 * angle)));
    }
    return {ring};
}

void check_crop_laws(const Mesh& mesh, std::uint64_t outlines, CropCounts& counts) {
    const Properties whole = inspect(mesh);
    if (!whole.closed || mesh.face_count() == 0) return;
    ++counts.meshes;
    for (std::uint64_t key = 0; key < outlines; ++key) check_crop(mesh, whole, key, counts);
}

void print(const CropCounts& c) {
    std::cout << c.files << " files, " << c.meshes << " closed meshes, " << c.crops << " crops each way, "
              << c.caps << " with walls, all closed, " << c.matched << " with the same walls on both sides, "
              << c.skipped << " outlines that are none\n";
}

} // namespace

TEST_CASE("closed meshes that are cropped with walls stay closed and their sides add up", "[property]") {
    CropCounts counts;
    for (const Mesh& mesh : {shapes::cube(), shapes::uv_cube(), shapes::icosphere(3), shapes::torus(24, 12)})
        check_crop_laws(mesh, 30, counts);
    CHECK(counts.caps > 50);
    CHECK(counts.matched == counts.crops);
}

TEST_CASE("manifold meshes stay manifold where an outline hardly bends", "[property]") {
    struct Trial {
        std::uint64_t key;
        Vec3 by;
    };
    const Vec3 far{5e5, 6.85e5, 12.5}; // as in a map's coordinates
    for (const Trial& trial : {Trial{1, {}}, Trial{2, {}}, Trial{47, {}}, Trial{65, {}}, Trial{101, {}},
                               Trial{119, {}}, Trial{137, {}}, Trial{1, far}, Trial{8, far},
                               Trial{11, far}}) { // most have corners that had two points
        CAPTURE(trial.key, trial.by.x);
        const Mesh mesh = test::moved(shapes::torus(24, 12), trial.by);
        Rings rings = bent_little(trial.key);
        for (Vec2& p : rings.front()) p = p + Vec2{trial.by.x, trial.by.y};
        const Footprint footprint(rings);
        const CropResult in = cropped(mesh, footprint, 2, polygon::Keep::inside, false),
                         out = cropped(mesh, footprint, 2, polygon::Keep::outside, false);
        CHECK(walls_match(in, out));
        for (const CropResult* side : {&in, &out}) {
            const Properties is = inspect(side->mesh);
            CHECK(is.closed);
            CHECK(is.edge_manifold);
        }
    }
}

TEST_CASE("closed meshes of the corpus that are cropped with walls stay closed", "[property]") {
    const auto folder = test::corpus();
    if (!folder) return;
    CropCounts counts;
    counts.files = test::check_corpus(
        *folder, [&](const Mesh& mesh, std::uint64_t outlines) { check_crop_laws(mesh, outlines, counts); });
    print(counts);
}
