#include "support/catch.hpp"

#include "base/random.hpp"
#include "geometry/polygon/certain_delaunay.hpp"

#include <algorithm>

using namespace facetmill;
using namespace facetmill::polygon;

namespace {

using Triangles = std::vector<std::array<Index, 3>>;

/// A triangle, with corners where its sides 0 and 1, 2 and 0, ... meet.
CutTriangle plain() { return {{{0, 0}, {4, 0}, {0, 3}}, {0b101, 0b011, 0b110}, {}}; }

Index add(CutTriangle& cut, const Vec2& p, unsigned side = 0) {
    cut.points.push_back(p);
    cut.sides.push_back(static_cast<std::uint8_t>(side));
    return static_cast<Index>(cut.points.size() - 1);
}

Triangles in_order(Triangles triangles) {
    for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

double area(const CutTriangle& cut, const std::array<Index, 3>& t) {
    return cross(cut.points[t[1]] - cut.points[t[0]], cut.points[t[2]] - cut.points[t[0]]) / 2;
}

bool has_edge(const Triangles& triangles, Index a, Index b) {
    return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
        return std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2;
    });
}

} // namespace

TEST_CASE("a triangle without anything in it stays", "[geometry]") {
    const auto triangles = certain_delaunay(plain());
    REQUIRE(triangles);
    CHECK(in_order(*triangles) == Triangles{{0, 1, 2}});
}

TEST_CASE("a line across a triangle cuts it, and the rest is Delaunay", "[geometry]") {
    CutTriangle cut = plain();
    const Index a = add(cut, {1, 0}, 1), b = add(cut, {0, 1.5}, 4);
    cut.lines.push_back({a, b});
    const auto triangles = certain_delaunay(cut);
    REQUIRE(triangles);
    CHECK(in_order(*triangles) == Triangles{{0, 3, 4}, {1, 2, 4}, {1, 4, 3}});
}

TEST_CASE("a line is an edge although Delaunay would not have it", "[geometry]") {
    CutTriangle cut = plain();
    const Index a = add(cut, {0.1, 0}, 1), b = add(cut, {0.125, 2.75});
    const Index c = add(cut, {0.0625, 1}), d = add(cut, {0.25, 1.25});
    CHECK(!has_edge(*certain_delaunay(cut), a, b));
    cut.lines.push_back({a, b});
    const auto triangles = certain_delaunay(cut);
    REQUIRE(triangles);
    CHECK(has_edge(*triangles, a, b));
    CHECK(!has_edge(*triangles, c, d));
}

TEST_CASE("what is not sure to be the only triangulation is not told", "[geometry]") {
    CutTriangle cocircular = plain();
    const Index a = add(cocircular, {1, 0}, 1), b = add(cocircular, {1, 1}), c = add(cocircular, {0, 1}, 4);
    CHECK(!certain_delaunay(cocircular)); // a square at the corner
    cocircular.lines = {{a, c}};
    CHECK(certain_delaunay(cocircular)); // of which this line is the diagonal
    cocircular.lines = {{0, b}, {a, c}};
    CHECK(!certain_delaunay(cocircular)); // which cross

    CutTriangle on_line = plain();
    on_line.lines.push_back({add(on_line, {0.5, 0.5}), add(on_line, {1.5, 0.5})});
    CHECK(certain_delaunay(on_line));
    add(on_line, {1, 0.5});
    CHECK(!certain_delaunay(on_line));

    CutTriangle on_side = plain();
    add(on_side, {1, 0}); // it seems, but is not said
    CHECK(!certain_delaunay(on_side));

    CutTriangle far = plain();
    for (Vec2& p : far.points) p = p + Vec2{1e15, 1e15};
    add(far, {1e15 + 1, 1e15 + 0.5});
    CHECK(!certain_delaunay(far));

    CutTriangle crowded = plain();
    for (int i = 0; i < 30; ++i) add(crowded, {0.1 + 0.03 * i, 0.1 + 0.001 * i * i});
    CHECK(!certain_delaunay(crowded));
}

TEST_CASE("triangulations of random points cover the triangle and have empty circles", "[geometry]") {
    std::size_t told = 0, wrong = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        CutTriangle cut = plain();
        const auto random = [&](std::uint64_t k) {
            return 0x1p-53 * static_cast<double>(hashed(seed, k) >> 11);
        };
        for (std::uint64_t i = 0; i < hashed(seed, 99) % 15; ++i) {
            const double s = random(2 * i), t = random(2 * i + 1);
            add(cut, s + t < 1 ? Vec2{4 * s, 3 * t} : Vec2{4 - 4 * s, 3 - 3 * t});
        }
        add(cut, {4 * random(50), 0}, 1);
        const auto triangles = certain_delaunay(cut);
        if (!triangles) continue;
        ++told;
        double sum = 0;
        for (const auto& t : *triangles) {
            sum += area(cut, t);
            wrong += !(area(cut, t) > 0);
            const Vec2 &p = cut.points[t[0]], u = cut.points[t[1]] - p, v = cut.points[t[2]] - p;
            const double d = 2 * cross(u, v);
            const Vec2 middle{(v.y * dot(u, u) - u.y * dot(v, v)) / d,
                              (u.x * dot(v, v) - v.x * dot(u, u)) / d};
            for (const Vec2& q : cut.points) // in the circle, but for rounding
                wrong += length(q - p - middle) < length(middle) * (1 - 1e-9);
        }
        wrong += std::abs(sum - 6) > 1e-12;
    }
    CHECK(wrong == 0);
    CHECK(told > 490);
}
