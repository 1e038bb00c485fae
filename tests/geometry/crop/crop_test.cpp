#include "geometry/crop/crop.hpp"

#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "base/math/random.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"

using namespace facetmill;

namespace {

using Rings = std::vector<std::vector<Vec2>>;

const Rings with_hole{{{0.5, 0.5}, {5.5, 0.5}, {5.5, 3.25}, {3, 1.5}, {0.5, 3.25}},
                      {{1.25, 0.75}, {1.75, 0.75}, {1.75, 1.5}, {1.25, 1.5}}};

CropResult cropped(const Mesh& mesh, const Rings& rings, CropBy by = CropBy::cut,
                   polygon::Keep keep = polygon::Keep::inside) {
    CropSettings settings;
    settings.by = by;
    settings.keep = keep;
    CropResult r = crop(mesh, Footprint(rings), settings);
    CHECK(broken_invariants(r.mesh).empty());
    return r;
}

/// Counts boundary edges with ends off the outline, where the crop tore the surface.
std::size_t cracks(const Mesh& mesh, const Rings& rings, const Mesh& before) {
    const Box box = before.bounds();
    std::size_t count = 0;
    for (const auto& [edge, use] : test::edge_uses(mesh)) {
        if (use.second != 1) continue;
        const Vec3 p = mix(mesh.positions[edge.first], mesh.positions[edge.second], 0.5);
        double nearest = std::min({p.x - box.min.x, box.max.x - p.x, p.y - box.min.y, box.max.y - p.y});
        for (const auto& ring : rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()], q{p.x, p.y};
                const double t = std::clamp(dot(q - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
                nearest = std::min(nearest, length(a + (b - a) * t - q));
            }
        count += nearest > 1e-9;
    }
    return count;
}

std::vector<Vec2> star(int points, const Vec2& centre, double radius) {
    std::vector<Vec2> ring;
    for (int i = 0; i < 2 * points; ++i) {
        const double angle = pi * i / points + 0.1, r = i % 2 == 0 ? radius : radius / 2.5;
        ring.push_back(centre + Vec2{cosine(angle), sine(angle)} * r);
    }
    return ring;
}

} // namespace

TEST_CASE("a sheet cut at an outline with a hole has its area", "[geometry]") {
    const Mesh sheet = shapes::grid(6, 4);
    const double area = Footprint(with_hole).area();
    const CropResult in = cropped(sheet, with_hole),
                     out = cropped(sheet, with_hole, CropBy::cut, polygon::Keep::outside);
    CHECK(test::area(in.mesh) == Approx(area).epsilon(1e-13));
    CHECK(test::area(in.mesh) + test::area(out.mesh) == Approx(24).epsilon(1e-13));
    CHECK(in.cut_faces == out.cut_faces);
    CHECK(cracks(in.mesh, with_hole, sheet) == 0);
    CHECK(cracks(out.mesh, with_hole, sheet) == 0);
}

TEST_CASE("outlines along edges and through vertices cut nothing that they need not", "[geometry]") {
    const CropResult r = cropped(shapes::grid(6, 4), {{{1, 1}, {4, 1}, {4, 3}, {1, 3}}});
    CHECK(r.cut_faces == 0);
    CHECK(r.mesh.face_count() == 12);
    CHECK(test::area(r.mesh) == 6);
}

TEST_CASE("stars and islands on a rough surface", "[geometry]") {
    Mesh hill = shapes::grid(24, 20);
    for (Vec3& p : hill.positions) {
        p.x = p.x / 4;
        p.y = p.y / 4;
        p.z = uniform(hashed(5, static_cast<std::uint64_t>(p.x * 64 + p.y * 4096)));
    }
    const Rings rings{star(7, {3, 2.5}, 2.3), star(5, {3, 2.5}, 0.7), {{0.1, 0.1}, {0.9, 0.15}, {0.2, 0.8}}};
    const CropResult in = cropped(hill, rings),
                     out = cropped(hill, rings, CropBy::cut, polygon::Keep::outside);
    CHECK(test::area(in.mesh) + test::area(out.mesh) == Approx(test::area(hill)).epsilon(1e-12));
    Mesh flat = in.mesh;
    for (Vec3& p : flat.positions) p.z = 0;
    CHECK(test::area(flat) == Approx(Footprint(rings).area()).epsilon(1e-12));
    CHECK(cracks(in.mesh, rings, hill) == 0);
    CHECK(cracks(out.mesh, rings, hill) == 0);
}

TEST_CASE("a ring within one face leaves a frame", "[geometry]") {
    const Rings small{{{0.1, 0.1}, {0.3, 0.1}, {0.2, 0.3}}};
    const Mesh sheet = shapes::grid(1, 1);
    CHECK(test::area(cropped(sheet, small).mesh) == Approx(0.02));
    const CropResult out = cropped(sheet, small, CropBy::cut, polygon::Keep::outside);
    CHECK(test::area(out.mesh) == Approx(0.98));
    CHECK(cracks(out.mesh, small, sheet) == 0);
}

TEST_CASE("seams and attributes survive a crop", "[geometry]") {
    const Rings half{{{-1, -1}, {0.3, -1}, {0.6, 2}, {-1, 2}}};
    const CropResult r = cropped(shapes::uv_cube(), half);
    const Attribute* uv = r.mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    CHECK(uv->size() == r.mesh.wedge_count());
    CHECK_FALSE(r.mesh.find("#trace", Domain::vertex));
    CHECK(test::area(r.mesh) == Approx(1 + 2 * 0.45 + 0.4 + 0.5));
    const CropResult rest = cropped(shapes::uv_cube(), half, CropBy::cut, polygon::Keep::outside);
    CHECK(test::area(r.mesh) + test::area(rest.mesh) == Approx(6));
    bool interpolated = false;
    for (const AttributeChange& f : r.changes)
        interpolated |= f.attribute == "TEXCOORD_0" && f.kind == AttributeChange::Kind::interpolated;
    CHECK(interpolated);
}

TEST_CASE("by whole faces, their centroids, or whatever overlaps", "[geometry]") {
    const Mesh sheet = shapes::grid(6, 4);
    const auto faces = [&](CropBy by, polygon::Keep keep = polygon::Keep::inside) {
        return cropped(sheet, {{{0.5, 0.5}, {3.5, 0.5}, {3.5, 2}, {0.5, 2}}}, by, keep).mesh.face_count();
    };
    CHECK(faces(CropBy::whole) == 4);
    CHECK(faces(CropBy::centre) == 9);
    CHECK(faces(CropBy::overlapping) == 15); // one of the 16 touches only at a point
    CHECK(faces(CropBy::whole, polygon::Keep::outside) == 48 - 15);
    CHECK(faces(CropBy::centre, polygon::Keep::outside) == 48 - 9);
    CHECK(faces(CropBy::overlapping, polygon::Keep::outside) == 48 - 4);
}

TEST_CASE("all rules for points inside crop the same", "[geometry]") {
    const Mesh sphere = shapes::icosphere(3);
    const Rings convex{{{-0.5, -0.4}, {0.6, -0.3}, {0.5, 0.7}, {-0.4, 0.5}}};
    CropSettings settings;
    settings.by = CropBy::centre;
    const Mesh expected = crop(sphere, Footprint(convex), settings).mesh;
    REQUIRE(expected.face_count() > 100);
    for (const InsideBy by : {InsideBy::angles, InsideBy::half_planes, InsideBy::angles_3d}) {
        settings.inside_by = by;
        CHECK(crop(sphere, Footprint(convex), settings).mesh.corners == expected.corners);
    }
    settings.inside_by = InsideBy::half_planes;
    CHECK(test::failure([&] { crop(sphere, Footprint(with_hole), settings); }) ==
          "usage [E-FOOTPRINT] this test for points needs a footprint of one convex ring | use inside_by: "
          "crossings, which accepts any footprint");
}

TEST_CASE("crops along other axes and of moved parts", "[geometry]") {
    CropSettings settings;
    settings.axis = 0;
    const Rings square{{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}}};
    CHECK(test::area(crop(shapes::cube(), Footprint(square), settings).mesh) == Approx(0.5));
    settings.axis = 1;
    settings.to_world.m[0][3] = 0.5;
    settings.to_world.m[2][3] = -0.5;
    CHECK(test::area(crop(shapes::cube(), Footprint(square), settings).mesh) ==
          Approx(2 * 0.25 * 0.25 + 0.25 * 2));
}

TEST_CASE("walls along the outline go with what they bound", "[geometry]") {
    const Rings around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    CHECK(cropped(shapes::cube(), around).mesh.face_count() == 12);
    CHECK(cropped(shapes::cube(), around, CropBy::cut, polygon::Keep::outside).mesh.face_count() == 0);
    const Rings beside{{{1, 0}, {2, 0}, {2, 1}, {1, 1}}};
    CHECK(cropped(shapes::cube(), beside).mesh.face_count() == 0);
}

TEST_CASE("footprints that are none are refused", "[geometry]") {
    const auto refusal = [](Rings rings) { return test::failure([&] { Footprint{rings}; }); };
    CHECK(refusal({}) == "usage [E-FOOTPRINT] the footprint has no rings");
    CHECK(refusal({{{0, 0}, {1, 0}, {0, 0}}}) ==
          "usage [E-FOOTPRINT] ring 1 of the footprint has 2 corners, and a ring needs three | give the "
          "corners in order; the last one is joined to the first");
    CHECK(refusal({{{0, 0}, {1, 0}, {2, 0}}}) ==
          "usage [E-FOOTPRINT] ring 1 of the footprint has no area | its corners are on one line");
    CHECK(refusal({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}) ==
          "usage [E-FOOTPRINT] the footprint intersects itself near (1, 1): the segments from (0, 0) to (2, "
          "2) and from (2, 0) to (0, 2) | repair the outline, or crop by each of its simple parts in turn");
    CHECK(refusal({{{0, 0}, {NAN, 2}, {2, 0}}}) ==
          "usage [E-FOOTPRINT] ring 1 of the footprint has a corner that is not finite");
}

TEST_CASE("a footprint finds points as the plain rule does", "[geometry]") {
    const Rings rings{star(9, {0, 0}, 2), star(6, {0, 0}, 0.6), {{3, 0}, {4, 0}, {4, 1}, {3, 1}}};
    const Footprint footprint(rings);
    const auto spans = footprint.spans();
    for (std::uint64_t i = 0; i < 4000; ++i) {
        const Vec2 p{uniform(hashed(1, i)) * 7 - 2.5, uniform(hashed(2, i)) * 5 - 2.5};
        const auto place = footprint.locate(p);
        CHECK(place == polygon::locate(p, spans));
        CHECK((place == polygon::PointLocation::inside) == polygon::inside_by_angles(p, spans));
    }
    CHECK(footprint.locate({3, 0}) == polygon::PointLocation::on_vertex);
    CHECK(footprint.locate({3.5, 1}) == polygon::PointLocation::on_edge);
    CHECK(footprint.locate({4, 0.25}) == polygon::PointLocation::on_edge);
}

namespace {

CropResult walled(const Mesh& mesh, const Rings& rings, polygon::Keep keep = polygon::Keep::inside,
                  const Transform& to_world = {}) {
    CropSettings settings;
    settings.keep = keep;
    settings.to_world = to_world;
    settings.cap = settings.cap_numbers = true;
    settings.cap_primitive = Primitive{3, {}, {}};
    CropResult r = crop(mesh, Footprint(rings), settings);
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(r.open.empty());
    return r;
}

std::size_t faces_with(const Mesh& mesh, std::string_view name, double number) {
    const Attribute* a = mesh.find(name, Domain::face);
    std::size_t count = 0;
    for (Index f = 0; a && f < mesh.face_count(); ++f) count += a->value(f, 0) == number;
    return count;
}

const Rings notched{{{0.25, 0.25}, {2, 0.25}, {2, 0.75}, {0.5, 0.5}, {0.25, 0.875}},
                    {{0.5, 0.3125}, {0.75, 0.3125}, {0.75, 0.4375}, {0.5, 0.4375}}};

} // namespace

TEST_CASE("a crop with walls is a solid over the footprint, its holes open", "[geometry]") {
    // Within the unit square: a pentagon whose slanted side rises from (1/2, 1/2) by 1/12, less the hole.
    const double area = 0.25 * 0.4375 + 0.5 * (0.25 + 0.25 + 1.0 / 12) / 2 - 0.25 * 0.125;
    for (const Mesh& cube : {shapes::cube(), shapes::quad_cube(), shapes::uv_cube()}) {
        const CropResult in = walled(cube, notched), out = walled(cube, notched, polygon::Keep::outside);
        CHECK(inspect(in.mesh).closed);
        CHECK(inspect(in.mesh).edge_manifold);
        CHECK(inspect(out.mesh).closed);
        CHECK(test::volume(in.mesh) == Approx(area).epsilon(1e-14));
        CHECK(test::volume(out.mesh) == Approx(1 - area).epsilon(1e-14));
        CHECK(in.cap_faces == out.cap_faces);
    }
}

TEST_CASE("walls have numbers, a primitive, normals and coordinates of their own", "[geometry]") {
    const Rings square_with_hole{{{0.5, 0.125}, {0.875, 0.125}, {0.875, 0.375}, {0.5, 0.375}},
                                 {{0.625, 0.1875}, {0.75, 0.1875}, {0.75, 0.3125}, {0.625, 0.3125}}};
    const CropResult r = walled(shapes::uv_cube(), square_with_hole);
    for (int wall = 1; wall <= 8; ++wall) CHECK(faces_with(r.mesh, "cut_id", wall) >= 2);
    CHECK(faces_with(r.mesh, "group", 1) >= 8);
    CHECK(faces_with(r.mesh, "group", 2) == 8);
    CHECK(faces_with(r.mesh, "group", 1) + faces_with(r.mesh, "group", 2) == r.cap_faces);
    const Attribute *normals = r.mesh.find("NORMAL", Domain::wedge),
                    *uvs = r.mesh.find("TEXCOORD_0", Domain::wedge);
    for (auto f = static_cast<Index>(r.mesh.face_count() - r.cap_faces); f < r.mesh.face_count(); ++f) {
        const auto w = r.mesh.face_wedges(f);
        const Vec3 normal = normalised(cross(
            r.mesh.positions[r.mesh.vertex_of_wedge(w[1])] - r.mesh.positions[r.mesh.vertex_of_wedge(w[0])],
            r.mesh.positions[r.mesh.vertex_of_wedge(w[2])] - r.mesh.positions[r.mesh.vertex_of_wedge(w[0])]));
        CHECK(r.mesh.primitives.at(r.mesh.primitive_of(f)).material == 3);
        for (const Index corner : w) {
            const Vec3 own{normals->value(corner, 0), normals->value(corner, 1), normals->value(corner, 2)};
            CHECK(own == normal);
            CHECK(std::max(uvs->value(corner, 0), uvs->value(corner, 1)) <= 1);
            CHECK(std::min(uvs->value(corner, 0), uvs->value(corner, 1)) >= 0);
        }
    }
}

TEST_CASE("walls on faces of the part, through its vertices, past straight corners", "[geometry]") {
    const Rings half{{{0, 0}, {0.5, 0}, {1, 0}, {1, 0.5}, {0.25, 0.5}, {0, 0.5}}};
    for (const auto keep : {polygon::Keep::inside, polygon::Keep::outside}) {
        const CropResult r = walled(shapes::cube(), half, keep);
        CHECK(inspect(r.mesh).closed);
        CHECK(test::volume(r.mesh) == 0.5);
        CHECK(r.cap_faces == 8); // the one new wall, past a corner in its middle: 2 contours of 10 points
    }
    const Rings diagonal{{{0, 0}, {1, 0}, {1, 1}}};
    CHECK(test::volume(walled(shapes::cube(), diagonal).mesh) == 0.5);
    const Rings touching{{{0.25, 0.25}, {0.5, 0.25}, {0.5, 0.5}, {0.25, 0.5}},
                         {{0.5, 0.5}, {0.75, 0.5}, {0.75, 0.75}, {0.5, 0.75}},
                         {{0.5, 0.25}, {0.75, 0.25}, {0.75, 0.375}, {0.5, 0.375}}};
    const CropResult joined = walled(shapes::cube(), touching);
    CHECK(inspect(joined.mesh).closed);
    CHECK(test::volume(joined.mesh) == 2 * 0.0625 + 0.03125);
}

TEST_CASE("float32 vertices beside the outline by their rounding are on it", "[geometry]") {
    Mesh cube = shapes::cube(); // reaches to 0.1f, which is more than 0.1
    for (Vec3& p : cube.positions) p = p * static_cast<double>(0.1F);
    const Rings square{{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}};
    CropSettings settings;
    settings.cap = settings.snap = true;
    const CropResult in = crop(cube, Footprint(square), settings);
    CHECK(in.mesh.face_count() == 12);
    CHECK(in.cap_faces == 0);
    CHECK(in.snapped == 6);
    settings.keep = polygon::Keep::outside;
    CHECK(crop(cube, Footprint(square), settings).mesh.face_count() == 0);
    settings.snap = false;
    CHECK(crop(cube, Footprint(square), settings).mesh.face_count() > 0);
}

TEST_CASE("outlines of many segments", "[geometry]") {
    Rings wave(1);
    for (int i = 0; i < 500; ++i) {
        const double angle = 2 * pi * i / 500, r = 0.55 + 0.05 * sine(9 * angle);
        wave[0].push_back(Vec2{0.01, 0.02} + Vec2{cosine(angle), sine(angle)} * r);
    }
    const Mesh ball = shapes::icosphere(3), box = shapes::uv_cube();
    for (const Mesh* mesh : {&ball, &box}) {
        CropSettings settings;
        settings.cap = true;
        const CropResult in = crop(*mesh, Footprint(wave), settings);
        settings.keep = polygon::Keep::outside;
        const CropResult out = crop(*mesh, Footprint(wave), settings);
        for (const CropResult* r : {&in, &out}) {
            CHECK(broken_invariants(r->mesh).empty());
            CHECK(inspect(r->mesh).closed);
            CHECK(inspect(r->mesh).edge_manifold);
            CHECK(std::none_of(r->changes.begin(), r->changes.end(),
                               [](const AttributeChange& f) { return f.attribute.starts_with('#'); }));
        }
        CHECK(*inspect(in.mesh).volume + *inspect(out.mesh).volume == Approx(*inspect(*mesh).volume));
        CHECK(cracks(cropped(*mesh, wave).mesh, wave, *mesh) == 0);
    }
}

TEST_CASE("a face that many segments cross is cut as often as there are segments", "[geometry]") {
    const Mesh square = shapes::grid(1, 1); // two triangles
    std::vector<Vec2> circle, comb;
    constexpr int n = 2000;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * pi * i / n + 0.1;
        circle.push_back(Vec2{0.51, 0.49} + Vec2{cosine(angle), sine(angle)} * 0.4);
    }
    const Footprint round({circle});
    const auto sides = crop_both(square, round, {});
    // Both parts of the disc, and the faces that a cut leaves outside, for each segment and each crossing of
    // the diagonal.
    CHECK(sides[0].mesh.face_count() == 2);
    CHECK(sides[1].mesh.face_count() < n + 10);
    CHECK(test::area(sides[0].mesh) == Approx(round.area()).epsilon(1e-12));
    CHECK(test::area(sides[0].mesh) + test::area(sides[1].mesh) == Approx(1).epsilon(1e-12));
    for (int i = 0; i < 50; ++i) // teeth whose flanks, and whose tips and roots, are on one line each
        for (const Vec2 p : {Vec2{0, 0.75}, Vec2{0.25, 0.75}, Vec2{0.5, 0.75}, Vec2{0.5, 0.25}})
            comb.push_back({(i + p.x) / 64 + 0.125, p.y});
    comb.push_back({0.9375, 0.25});
    comb.push_back({0.9375, 0.125});
    comb.push_back({0.125, 0.125});
    const Rings rings{
        comb, {{0.25, 0.15}, {0.3, 0.15}, {0.3, 0.2}, {0.25, 0.2}}, {{0.125, 0.75}, {0.1, 0.9}, {0, 0.8}}};
    const Footprint toothed(rings);
    const auto parts = crop_both(square, toothed, {});
    CHECK(test::area(parts[0].mesh) == Approx(toothed.area()).epsilon(1e-12));
    CHECK(test::area(parts[0].mesh) + test::area(parts[1].mesh) == Approx(1).epsilon(1e-12));
    for (const CropResult& r : parts) {
        CHECK(broken_invariants(r.mesh).empty());
        CHECK(cracks(r.mesh, rings, square) == 0);
        CHECK(r.mesh.face_count() < 800);
    }
}

TEST_CASE("vertices on one segment that snap takes as on another as well are counted", "[geometry]") {
    Mesh cube = shapes::cube();
    for (Vec3& p : cube.positions) p = p * static_cast<double>(0.1F);
    // The vertices at (0.1F, 0) are exactly on the outline, and next to the upright side of its hole.
    const Rings touched{{{0, 0}, {0.2, 0}, {0.2, 0.2}, {0, 0.2}}, {{0.1, 0}, {0.15, 0.05}, {0.1, 0.05}}};
    CropSettings settings;
    settings.cap = settings.snap = true;
    CHECK(crop(cube, Footprint(touched), settings).snapped == 2);
    settings.keep = polygon::Keep::outside;
    CHECK(crop(cube, Footprint(touched), settings).snapped == 2);
    settings.snap = false;
    CHECK(crop(cube, Footprint(touched), settings).snapped == 0);
}

TEST_CASE("a convex prism cropped by its own outline is all inside", "[geometry]") {
    std::vector<Vec2> ring;
    for (int i = 0; i < 40; ++i) {
        const double angle = 2 * pi * i / 40;
        ring.push_back(Vec2{cosine(angle), sine(angle)} * 1.1);
    }
    Mesh prism;
    prism.face_offsets.push_back(0);
    for (const double z : {0.0, 1.0})
        for (const Vec2& p : ring) prism.positions.push_back({p.x, p.y, z});
    for (Index i = 0; i < 40; ++i) prism.corners.push_back(39 - i);
    for (Index i = 0; i < 40; ++i) prism.corners.push_back(40 + i);
    prism.face_offsets.insert(prism.face_offsets.end(), {40, 80});
    for (Index i = 0; i < 40; ++i) {
        const Index next = (i + 1) % 40;
        for (const Index v : {i, next, next + 40, i + 40}) prism.corners.push_back(v);
        prism.face_offsets.push_back(static_cast<Index>(prism.corners.size()));
    }
    REQUIRE(inspect(prism).closed);
    CropSettings settings;
    settings.cap = true;
    for (const bool snap : {false, true}) {
        settings.snap = snap;
        const auto sides = crop_both(prism, Footprint({ring}), settings);
        CHECK(inspect(sides[0].mesh).closed);
        CHECK(*inspect(sides[0].mesh).volume == Approx(*inspect(prism).volume));
        CHECK(sides[1].mesh.face_count() == 0);
    }
}

TEST_CASE("a terrain in UTM is cut where the outline is", "[geometry]") {
    // A raster of 2 m, and a raster of whole metres in the south, where floats have steps of a metre.
    constexpr Index side = 41;
    const auto place = GENERATE(std::pair{5400000.0, 2.0}, std::pair{9400001.0, 1.0});
    const double north = place.first, step = place.second;
    const Vec3 corner{450000, north, 0};
    const auto at = [&](double x, double y) { return Vec2{450000 + x * step, north + y * step}; };
    const Rings outline{{at(0.65, 1.85), at(35.05, 5.1), at(31.25, 32.75), at(5.1, 30.45)}};
    const double wanted =
        0.5 * std::fabs(cross(outline[0][2] - outline[0][0], outline[0][3] - outline[0][1]));
    for (const double height : {0.0, 1.0 / 3}) { // exact in float32, and not exact
        INFO(height);
        Mesh terrain;
        for (Index i = 0; i < side * side; ++i)
            terrain.positions.push_back(corner + Vec3{step * (i / side), step * (i % side), height});
        for (Index x = 0; x + 1 < side; ++x)
            for (Index y = 0; y + 1 < side; ++y) {
                const Index a = x * side + y, b = a + side;
                for (const Index v : {a, b, b + 1, a, b + 1, a + 1}) terrain.corners.push_back(v);
            }
        CropSettings settings;
        settings.snap = true;
        const CropResult in = crop(terrain, Footprint(outline), settings);
        CHECK(in.snapped == 0);
        CHECK(std::fabs(test::area(in.mesh) - wanted) < 1e-5);
        settings.keep = polygon::Keep::outside;
        const double all = step * step * (side - 1) * (side - 1);
        CHECK(std::fabs(test::area(crop(terrain, Footprint(outline), settings).mesh) - (all - wanted)) <
              1e-5);
    }
    // At northern coordinates, float32 has steps of half a metre, so vertices may have been elsewhere.
    Mesh rounded = shapes::cube();
    for (Vec3& p : rounded.positions) p = as_float32(p * 10.3 + Vec3{450000, 5400000, 0}); // y: 5400010.5
    CropSettings settings;
    settings.snap = true;
    const auto up_to = [](double x, double y) {
        return Footprint({{{449990, 5399990}, {x, 5399990}, {x, y}, {449990, y}}});
    };
    CHECK(crop(rounded, up_to(450030, 5400010.3), settings).snapped == 4);
    CHECK(crop(rounded, up_to(450010.35, 5400030), settings).snapped == 0); // in x, floats are finer
}

TEST_CASE("positions in doubles are not snapped", "[geometry]") {
    Mesh cube = shapes::cube(); // reaches to 0.1, which is not a float
    for (Vec3& p : cube.positions) p = p * 0.1;
    const double side = 0.1 - 2e-9; // closer than a float's rounding
    CropSettings settings;
    settings.cap = settings.snap = true;
    settings.keep = polygon::Keep::outside;
    const CropResult out = crop(cube, Footprint({{{-1, -1}, {side, -1}, {side, 1}, {-1, 1}}}), settings);
    CHECK(out.snapped == 0);
    const Properties slice = inspect(out.mesh);
    CHECK(slice.closed);
    CHECK(slice.bounds.max.x == 0.1);
    CHECK(*slice.volume == Approx(2e-11).epsilon(1e-6));
}

TEST_CASE("large coordinates are cropped as small ones", "[geometry]") {
    const Rings triangle{{{-0.25, -0.25}, {0.25, -0.125}, {0.125, 0.375}}};
    CropSettings settings;
    settings.cap = true;
    const std::size_t faces = crop(shapes::icosphere(2), Footprint(triangle), settings).mesh.face_count();
    for (const int power : {-300, 300, 400}) { // of two, so that rounding is the same
        Mesh sphere = shapes::icosphere(2);
        for (Vec3& p : sphere.positions) p = p * std::ldexp(1.0, power);
        Rings rings = triangle;
        for (Vec2& p : rings[0]) p = p * std::ldexp(1.0, power);
        const CropResult r = crop(sphere, Footprint(rings), settings);
        CHECK(inspect(r.mesh).closed);
        CHECK(r.mesh.face_count() == faces);
        CHECK(r.memory.entries.size() == 3);
    }
}

TEST_CASE("walls close beside each other, with straight corners, keep apart", "[geometry]") {
    for (const double thick : {0.01, 1e-6, 1e-12}) {
        const Rings strip{
            {{0.1, 0.5}, {0.3, 0.5}, {0.9, 0.5}, {0.9, 0.5 + thick}, {0.7, 0.5 + thick}, {0.1, 0.5 + thick}}};
        CAPTURE(thick);
        for (const auto keep : {polygon::Keep::inside, polygon::Keep::outside}) {
            const Mesh& mesh = walled(shapes::quad_cube(), strip, keep).mesh;
            CHECK(inspect(mesh).closed);
            const double volume = Footprint(strip).area();
            CHECK(test::volume(mesh) ==
                  Approx(keep == polygon::Keep::inside ? volume : 1 - volume).epsilon(1e-14).margin(1e-15));
        }
    }
}

TEST_CASE("an edge that passes a corner of the outline is cut there once", "[geometry]") {
    const CropResult r = walled(shapes::cube(), {{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}}});
    CHECK(r.mesh.vertex_count() == 8);
    CHECK(r.cap_faces == 8);
    CHECK(inspect(r.mesh).edge_manifold);
}

TEST_CASE("a face seen edge-on is cut along every segment that may enter it", "[geometry]") {
    Mesh wall;
    wall.positions = {{0, 0, 0}, {10, 10, 0}, {10, 10, 5}, {0, 0, 5}};
    wall.corners = {0, 1, 2, 3};
    wall.face_offsets = {0, 4};
    // The longest segment runs almost along the wall, and another segment next to it is within its box.
    const CropResult out =
        cropped(wall, {{{1, 0}, {8, 2}, {7, 2.2}, {9, 10}}}, CropBy::cut, polygon::Keep::outside);
    CHECK(out.mesh.face_count() == 3);
    std::vector<double> ends;
    for (const Vec3& p : out.mesh.positions)
        if (p.z == 0) ends.push_back(p.x);
    std::sort(ends.begin(), ends.end());
    REQUIRE(ends.size() == 5);
    CHECK(ends[1] == Approx(3)); // on the line of that segment
    CHECK(ends[2] == Approx(5));
}

TEST_CASE("walls of moved, turned and mirrored parts stand in the world", "[geometry]") {
    Transform mirrored; // x -> 2 - x, y and z swapped
    mirrored.m[0][0] = -1;
    mirrored.m[0][3] = 2;
    mirrored.m[1][1] = 0;
    mirrored.m[1][2] = 1;
    mirrored.m[2][2] = 0;
    mirrored.m[2][1] = 1;
    const Rings corner{{{1.5, 0.5}, {3, 0.5}, {3, 3}, {1.5, 3}}};
    const CropResult r = walled(shapes::cube(), corner, polygon::Keep::inside, mirrored);
    CHECK(inspect(r.mesh).closed);
    CHECK(test::volume(r.mesh) == 0.25);
}

TEST_CASE("what covers a place twice has its wall twice", "[geometry]") {
    Mesh two = shapes::cube(), other = shapes::cube();
    for (Vec3& p : other.positions) p += Vec3{0.3, 0.2, 0.25};
    append(two, other);
    const Rings square{{{0.1, 0.1}, {0.8, 0.1}, {0.8, 0.9}, {0.1, 0.9}}};
    const CropResult r = walled(two, square);
    CHECK(inspect(r.mesh).closed);
    CHECK(test::volume(r.mesh) == Approx(0.7 * 0.8 + 0.5 * 0.7).epsilon(1e-13));
}

TEST_CASE("open parts get walls where their contours close, and the others are named", "[geometry]") {
    Mesh mixed = shapes::grid(2, 2), cube = shapes::cube();
    for (Vec3& p : mixed.positions) p.z = 3;
    append(mixed, cube);
    CropSettings settings;
    settings.cap = true;
    const CropResult r = crop(mixed, Footprint({{{-1, -1}, {0.5, -1}, {0.5, 3}, {-1, 3}}}), settings);
    REQUIRE(r.open.size() == 1);
    CHECK(r.open[0].edges == 4);
    CHECK(r.cap_faces == 6); // an octagon: the cube's faces have diagonals
}
