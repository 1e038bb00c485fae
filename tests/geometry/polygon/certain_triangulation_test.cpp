#include "support/catch.hpp"

#include "base/math/predicates.hpp"
#include "base/math/random.hpp"
#include "geometry/polygon/certain_triangulation.hpp"

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
    const auto triangles = certain_triangulation(plain());
    REQUIRE(triangles);
    CHECK(in_order(*triangles) == Triangles{{0, 1, 2}});
}

TEST_CASE("a line across a triangle cuts it, and the rest is Delaunay", "[geometry]") {
    CutTriangle cut = plain();
    const Index a = add(cut, {1, 0}, 1), b = add(cut, {0, 1.5}, 4);
    cut.lines.push_back({a, b});
    const auto triangles = certain_triangulation(cut);
    REQUIRE(triangles);
    CHECK(in_order(*triangles) == Triangles{{0, 3, 4}, {1, 2, 4}, {1, 4, 3}});
}

TEST_CASE("a line is an edge although Delaunay would not have it", "[geometry]") {
    CutTriangle cut = plain();
    const Index a = add(cut, {0.1, 0}, 1), b = add(cut, {0.125, 2.75});
    const Index c = add(cut, {0.0625, 1}), d = add(cut, {0.25, 1.25});
    CHECK(!has_edge(*certain_triangulation(cut), a, b));
    cut.lines.push_back({a, b});
    const auto triangles = certain_triangulation(cut);
    REQUIRE(triangles);
    CHECK(has_edge(*triangles, a, b));
    CHECK(!has_edge(*triangles, c, d));
}

TEST_CASE("of points on one circle any triangulation is told, of lines that cross none", "[geometry]") {
    CutTriangle cocircular = plain();
    const Index a = add(cocircular, {1, 0}, 1), b = add(cocircular, {1, 1}), c = add(cocircular, {0, 1}, 4);
    const auto either = certain_triangulation(cocircular); // a square at the corner
    REQUIRE(either);
    CHECK(has_edge(*either, 0, b) != has_edge(*either, a, c));
    cocircular.lines = {{a, c}};
    CHECK(has_edge(*certain_triangulation(cocircular), a, c));
    cocircular.lines = {{0, b}};
    CHECK(has_edge(*certain_triangulation(cocircular), 0, b));
    cocircular.lines = {{0, b}, {a, c}};
    CHECK(!certain_triangulation(cocircular)); // the lines cross

    CutTriangle lattice = {{{0, 0}, {8, 0}, {0, 8}}, {0b101, 0b011, 0b110}, {}};
    for (int i = 1; i < 5; ++i)
        for (int j = 1; i + j < 7; ++j) add(lattice, {double(i), double(j)});
    const auto squares = certain_triangulation(lattice);
    REQUIRE(squares);
    double sum = 0;
    for (const auto& t : *squares) sum += area(lattice, t);
    CHECK(sum == 32);
}

TEST_CASE("what is not sure to be a triangulation is not told", "[geometry]") {
    CutTriangle on_line = plain();
    on_line.lines.push_back({add(on_line, {0.5, 0.5}), add(on_line, {1.5, 0.5})});
    CHECK(certain_triangulation(on_line));
    add(on_line, {1, 0.5});
    CHECK(!certain_triangulation(on_line));

    CutTriangle on_side = plain();
    add(on_side, {1, 0}); // it seems, but is not said
    CHECK(!certain_triangulation(on_side));

    CutTriangle far = plain();
    for (Vec2& p : far.points) p = p + Vec2{1e15, 1e15};
    add(far, {1e15 + 1, 1e15 + 0.5});
    CHECK(!certain_triangulation(far));

    CutTriangle crowded = plain();
    for (int i = 0; i < 50; ++i) add(crowded, {0.1 + 0.02 * i, 0.1 + 0.0005 * i * i});
    CHECK(!certain_triangulation(crowded));
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
        const auto triangles = certain_triangulation(cut);
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
            for (const Vec2& q : cut.points) // on the circle, except for rounding
                wrong += length(q - p - middle) < length(middle) * (1 - 1e-9);
        }
        wrong += std::abs(sum - 6) > 1e-12;
    }
    CHECK(wrong == 0);
    CHECK(told > 490);
}

TEST_CASE("lines that cross are told where that is sure", "[geometry]") {
    using Pairs = std::vector<std::array<Index, 2>>;
    CutTriangle cut = plain();
    const Index a = add(cut, {0.5, 0.5}), b = add(cut, {1.5, 1.5}), c = add(cut, {0.5, 1.5}),
                d = add(cut, {1.5, 0.5}), e = add(cut, {2.5, 0.5});
    cut.lines = {{a, b}, {c, d}, {d, e}};
    CHECK(certain_crossings(cut) == Pairs{{0, 1}}); // lines 1 and 2 end in one point
    const Index on = add(cut, {1.25, 1.25});
    cut.lines.push_back({on, e}); // ends on line 0 within the accuracy of doubles
    CHECK(!certain_crossings(cut));
    cut.lines.back() = {add(cut, {1.25, 1.0}), e};
    CHECK(certain_crossings(cut) == Pairs{{0, 1}});
    cut.lines.back() = {add(cut, {1.25, 2.0}), e};
    CHECK(certain_crossings(cut) == Pairs{{0, 1}});
    cut.lines.back() = {add(cut, {0.5, 1.0}), e};
    CHECK(certain_crossings(cut) == Pairs{{0, 1}, {0, 3}, {1, 3}});
    cut.lines = {{add(cut, {1, 0}, 1), add(cut, {3, 0}, 1)}, {add(cut, {2, 0}, 1), c}};
    CHECK(certain_crossings(cut) == Pairs{}); // the first is along a side
}

TEST_CASE("the border is the sides in the order of their points, where that is sure", "[geometry]") {
    CutTriangle cut = plain();
    const Index far = add(cut, {3, 0}, 1), near = add(cut, {1, 0}, 1), slope = add(cut, {2, 1.5}, 2);
    add(cut, {1, 1});
    const auto border = certain_border(cut);
    REQUIRE(border);
    CHECK(*border == std::vector<std::array<Index, 2>>{
                         {0, near}, {near, far}, {far, 1}, {1, slope}, {slope, 2}, {2, 0}});
    add(cut, {std::nextafter(3.0, 4.0), 0}, 1);
    CHECK(!certain_border(cut));
}

TEST_CASE("of many lines those cross that do, and lines that touch are not sure", "[geometry]") {
    const auto coordinate = [](std::uint64_t key) { return 0.1 + 1.2 * uniform(hashed(7, key)); };
    CutTriangle cut = plain();
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Vec2 p{coordinate(4 * i), coordinate(4 * i + 1)};
        const Vec2 by = {0.2 * (coordinate(4 * i + 2) - 0.7), 0.2 * (coordinate(4 * i + 3) - 0.7)};
        cut.lines.push_back({add(cut, p), add(cut, p + by)});
    }
    const auto side = [&](Index a, Index b, Index c) {
        const Vec2 &p = cut.points[a], &q = cut.points[b], &r = cut.points[c];
        return orientation_2d(p.x, p.y, q.x, q.y, r.x, r.y);
    };
    std::vector<std::array<Index, 2>> wanted;
    for (Index i = 0; i < cut.lines.size(); ++i)
        for (Index j = i + 1; j < cut.lines.size(); ++j) {
            const auto& [a, b] = cut.lines[i];
            const auto& [c, d] = cut.lines[j];
            if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0)
                wanted.push_back({i, j});
        }
    CHECK(wanted.size() > 50);
    CHECK(certain_crossings(cut) == wanted);
    const Vec2 middle = (cut.points[cut.lines[0][0]] + cut.points[cut.lines[0][1]]) * 0.5;
    cut.lines.push_back({add(cut, middle), add(cut, middle + Vec2{0.1, 0.3})});
    CHECK(!certain_crossings(cut));
}
