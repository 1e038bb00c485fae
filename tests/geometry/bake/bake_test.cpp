#include "geometry/bake/bake.hpp"

#include "geometry/bake/fill.hpp"
#include "geometry/normals/normals.hpp"
#include "geometry/normals/tangents.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <functional>

using namespace facetmill;

namespace {

/// A rectangle in the xy plane as a grid, with texture coordinates (x, 1 - y).
Mesh sheet(double left, double right, double bottom, double top, int cells,
           const std::function<double(double, double)>& height = {}) {
    Mesh mesh;
    std::vector<float> uv;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double x = left + (right - left) * i / cells, y = bottom + (top - bottom) * j / cells;
            mesh.positions.push_back({x, y, height ? height(x, y) : 0});
            uv.push_back(static_cast<float>(x));
            uv.push_back(static_cast<float>(1 - y));
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto at = static_cast<Index>(j * (cells + 1) + i), up = static_cast<Index>(at + cells + 1);
            for (const Index v : {at, at + 1, up + 1, at, up + 1, up}) mesh.corners.push_back(v);
        }
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uv)});
    return mesh;
}

Mesh target_sheet(int cells = 1) {
    Mesh mesh = sheet(0, 1, 0, 1, cells);
    give_normals(mesh, NormalKind::smooth, 3);
    REQUIRE(give_tangents(mesh, 0).has_value());
    return mesh;
}

BakedMaps baked(BakeSource source, const Mesh& target, BakeSettings settings) {
    prepare_bake_source(source);
    const FaceTree tree(surface_of(source.mesh));
    return bake(source, tree, target, settings);
}

BakeSettings settings_of(int size, double distance) {
    BakeSettings s;
    s.size = size;
    s.distance = distance;
    return s;
}

std::uint8_t noise(std::uint32_t& state) {
    state = state * 1664525 + 1013904223;
    return static_cast<std::uint8_t>(state >> 24);
}

std::size_t at(int size, int x, int y) { return static_cast<std::size_t>(y * size + x); }

} // namespace

TEST_CASE("bake: a textured plane onto itself gives the texture within a level", "[geometry][bake]") {
    constexpr int size = 64;
    std::vector<std::uint8_t> pixels(4 * size * size);
    std::uint32_t state = 7;
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = i % 4 == 3 ? std::uint8_t{255} : noise(state);
    BakeSource source;
    source.mesh = sheet(0, 1, 0, 1, 5);
    source.mesh.primitives.resize(1);
    source.mesh.primitives[0].material = 0;
    source.looks.resize(1);
    source.looks[0].base_texture.image = texture_image(size, size, pixels, true, 4096);
    source.double_sided = {0};
    const BakedMaps maps = baked(source, target_sheet(3), settings_of(size, 0.01));
    CHECK(maps.covered == size * size);
    CHECK(maps.missed == 0);
    CHECK(maps.overlapping_faces == 0);
    CHECK(maps.faces_without_texels == 0);
    int worst = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        worst = std::max(worst, std::abs(int{pixels[i]} - int{maps.base[i]}));
    CHECK(worst <= 1);
}

TEST_CASE("bake: colours of vertices are mixed in linear light", "[geometry][bake]") {
    BakeSource source;
    source.mesh = sheet(0, 1, 0, 1, 1);
    std::vector<float> colours;
    for (const Vec3& p : source.mesh.positions)
        for (int c = 0; c < 3; ++c) colours.push_back(static_cast<float>(p.x));
    source.mesh.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 3, false, std::move(colours)});
    const BakedMaps maps = baked(source, target_sheet(), settings_of(16, 0.01));
    for (int x = 0; x < 16; ++x) {
        const double linear = (x + 0.5) / 16;
        const double encoded =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
        CHECK(std::abs(255 * encoded - maps.base[4 * at(16, x, 9)]) <= 1);
    }
}

TEST_CASE("bake: normals of waves are those of the formula", "[geometry][bake]") {
    constexpr double k = 2 * 3.14159265358979, a = 0.02;
    BakeSource source;
    source.mesh =
        sheet(0, 1, 0, 1, 256, [&](double x, double y) { return a * std::sin(k * x) * std::sin(k * y); });
    constexpr int size = 64;
    BakeSettings settings = settings_of(size, 0.1);
    settings.height = true;
    const BakedMaps maps = baked(source, target_sheet(), settings);
    CHECK(maps.missed == 0);
    double worst = 0, worst_height = 0;
    for (int y = 1; y < size - 1; ++y)
        for (int x = 1; x < size - 1; ++x) {
            const double px = (x + 0.5) / size, py = 1 - (y + 0.5) / size;
            const Vec3 n = normalised({-a * k * std::cos(k * px) * std::sin(k * py),
                                       -a * k * std::sin(k * px) * std::cos(k * py), 1});
            for (std::size_t c = 0; c < 3; ++c) {
                const double found = maps.normal[4 * at(size, x, y) + c] / 127.5 - 1;
                worst = std::max(worst, std::abs(found - n[c]));
            }
            const double height = a * std::sin(k * px) * std::sin(k * py);
            worst_height =
                std::max(worst_height, std::abs(height - static_cast<double>(maps.height[at(size, x, y)])));
        }
    CHECK(worst < 0.008); // two levels of 255
    CHECK(worst_height < 1e-5);
}

TEST_CASE("bake: occlusion beside a wall is that of the formula", "[geometry][bake]") {
    // A point at distance x from an endless wall of height h sees a share (1 + x / sqrt(x^2 + h^2)) / 2 of
    // the sky, weighted by the cosine: J. Howell, "A Catalog of Radiation Heat Transfer Configuration
    // Factors".
    constexpr double h = 0.5;
    BakeSource source;
    source.mesh = sheet(0, 1, 0, 1, 1);
    source.mesh.attributes.clear();
    const auto first = static_cast<Index>(source.mesh.positions.size());
    for (const Vec3& p : {Vec3{0, -60, 0}, Vec3{0, 60, 0}, Vec3{0, 60, h}, Vec3{0, -60, h}})
        source.mesh.positions.push_back(p);
    for (const Index v : {0, 1, 2, 0, 2, 3}) source.mesh.corners.push_back(first + v);
    constexpr int size = 64;
    BakeSettings settings = settings_of(size, 0.01);
    settings.occlusion_rays = 1024;
    const BakedMaps maps = baked(source, target_sheet(), settings);
    double worst = 0;
    for (int y = 4; y < size - 4; y += 7)
        for (int x = 4; x < size - 4; ++x) {
            const double d = (x + 1.0) / size; // the middle of the 4 x 4 texels
            const double open = (1 + d / std::sqrt(d * d + h * h)) / 2;
            worst = std::max(worst, std::abs(maps.surface[4 * at(size, x, y)] / 255.0 - open));
        }
    CHECK(worst < 0.01);
}

TEST_CASE("bake: texels without a hit have the nearest value, and are counted", "[geometry][bake]") {
    BakeSource source;
    source.mesh = sheet(0, 0.5, 0, 1, 1);
    std::vector<float> colours;
    for (const Vec3& p : source.mesh.positions)
        for (const double c : {p.x * 2, 0.0, 0.0}) colours.push_back(static_cast<float>(c));
    source.mesh.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 3, false, std::move(colours)});
    const BakedMaps maps = baked(source, target_sheet(), settings_of(32, 0.01));
    CHECK(maps.covered == 32 * 32);
    CHECK(maps.missed == 32 * 16);
    CHECK(maps.base[4 * at(32, 31, 5)] == 255);
}

TEST_CASE("bake: faces that share texels or have none are counted", "[geometry][bake]") {
    Mesh target = target_sheet();
    Mesh small = sheet(0.25, 0.5, 0.25, 0.5, 1), tiny = sheet(0.5001, 0.5002, 0.5001, 0.5002, 1);
    for (Mesh* mesh : {&small, &tiny}) {
        give_normals(*mesh, NormalKind::smooth, 3);
        REQUIRE(give_tangents(*mesh, 0).has_value());
        append(target, *mesh);
    }
    BakeSource source;
    source.mesh = sheet(0, 1, 0, 1, 1);
    const BakedMaps maps = baked(source, target, settings_of(16, 0.01));
    CHECK(maps.overlapping_faces == 4);
    CHECK(maps.faces_without_texels == 2);
    target = sheet(0, 1.5, 0, 1, 3);
    CHECK(faces_outside_texture(target) == 6);
}

TEST_CASE("bake: faces that look away are hit only with any_side", "[geometry][bake]") {
    BakeSource source;
    source.mesh = sheet(0, 1, 0, 1, 1);
    for (std::size_t c = 0; c < source.mesh.corners.size(); c += 3)
        std::swap(source.mesh.corners[c], source.mesh.corners[c + 1]);
    BakeSettings settings = settings_of(16, 0.01);
    CHECK(baked(source, target_sheet(), settings).missed == 256);
    settings.any_side = true;
    const BakedMaps maps = baked(source, target_sheet(), settings);
    CHECK(maps.missed == 0);
    CHECK(maps.normal[2] == 255);
    const FaceTree tree(surface_of(source.mesh));
    const BakeGap gap = bake_gap(source.mesh, tree, target_sheet());
    CHECK(gap.agreeing == 0);
    CHECK(gap.farthest < 1e-12); // rounding
}

TEST_CASE("bake: dilation takes the nearest covered texel", "[geometry][bake]") {
    constexpr int size = 24, reach = 5;
    std::vector<std::uint8_t> covered(size * size);
    std::uint32_t state = 3;
    for (auto& c : covered) c = noise(state) < 8;
    const auto sources = baking::nearest_covered(covered, size, reach);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            int best = reach * reach + 1;
            for (int j = 0; j < size; ++j)
                for (int i = 0; i < size; ++i)
                    if (covered[at(size, i, j)]) best = std::min(best, (i - x) * (i - x) + (j - y) * (j - y));
            const std::uint32_t from = sources[at(size, x, y)];
            if (best > reach * reach) {
                CHECK(from == UINT32_MAX);
                continue;
            }
            const int i = static_cast<int>(from % size), j = static_cast<int>(from / size);
            CHECK(covered[from]);
            CHECK((i - x) * (i - x) + (j - y) * (j - y) == best);
        }
}
