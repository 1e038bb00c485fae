// Compares the contacts of rings with tests of all pairs of their edges.
#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/polygon/polygon.hpp"
#include "support/polygons.hpp"

#include <algorithm>
#include <array>

using namespace facetmill;
using namespace facetmill::polygon;
using namespace facetmill::test;

namespace {

using Points = std::vector<Vec2>;
using Many = std::vector<Points>;

struct Piece {
    Vec2 a, b;
    std::size_t next, previous;
};

int turn_of(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double area = cross(b - a, c - a); // small integers: exact
    return (area > 0) - (area < 0);
}

bool lies_on(const Vec2& p, const Vec2& a, const Vec2& b) {
    return turn_of(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
           std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

/// f follows e and runs back along it.
bool back(const Piece& e, const Piece& f) {
    return turn_of(e.a, e.b, f.b) == 0 && dot(e.b - e.a, f.b - f.a) < 0;
}

/// Tests all pairs, by the definition of Contact.
Contact contact_by_pairs(const Many& rings) {
    std::vector<Piece> pieces;
    for (const Points& ring : rings) {
        const std::size_t first = pieces.size(), n = ring.size();
        for (std::size_t i = 0; i < n; ++i)
            pieces.push_back({ring[i], ring[(i + 1) % n], first + (i + 1) % n, first + (i + n - 1) % n});
    }
    Contact worst = Contact::none;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t j = i + 1; j < pieces.size(); ++j) {
            const Piece &e = pieces[i], &f = pieces[j];
            if (turn_of(e.a, e.b, f.a) * turn_of(e.a, e.b, f.b) < 0 &&
                turn_of(f.a, f.b, e.a) * turn_of(f.a, f.b, e.b) < 0)
                return Contact::crossing;
            const bool after = e.next == j, before = e.previous == j;
            const bool touch = lies_on(e.a, f.a, f.b) || lies_on(e.b, f.a, f.b) || lies_on(f.a, e.a, e.b) ||
                               lies_on(f.b, e.a, e.b);
            if (after || before ? (after && back(e, f)) || (before && back(f, e)) : touch)
                worst = Contact::touching;
        }
    return worst;
}

/// Small whole numbers, the same for the same seed.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}
    int below(int n) { return static_cast<int>(hashed(seed_, count_++) % static_cast<std::uint64_t>(n)); }
    Vec2 point(int side) {
        const int x = below(side);
        return {static_cast<double>(x), static_cast<double>(below(side))};
    }

  private:
    std::uint64_t seed_, count_ = 0;
};

Points scattered(Dice& dice, int corners, int side) {
    Points ring(static_cast<std::size_t>(corners));
    for (Vec2& p : ring) p = dice.point(side);
    return ring;
}

/// Corners sorted by direction from the centre, alternately near and far.
Points rough_star(Dice& dice) {
    const int spikes = 3 + dice.below(6), side = 4 + dice.below(20);
    Points ring;
    for (int i = 0; i < 2 * spikes; ++i) {
        const double angle = M_PI * i / spikes, far = i % 2 == 0 ? side : dice.below(side);
        ring.push_back({std::round(far * std::cos(angle)), std::round(far * std::sin(angle))});
    }
    return ring;
}

/// Teeth that lean, on a back.
Points rough_comb(Dice& dice) {
    const int teeth = 2 + dice.below(6), high = 1 + dice.below(12), lean = dice.below(9);
    Points ring;
    for (int i = 0; i < teeth; ++i)
        for (const int up : {0, 1, 1, 0}) {
            const int width = ring.size() % 4 < 2 ? 0 : 1 + dice.below(2);
            ring.push_back({3.0 * i + up * lean + width, static_cast<double>(up * high)});
        }
    ring.push_back({3.0 * teeth, -1.0 - dice.below(2)});
    ring.push_back({0, -1});
    return ring;
}

/// Some corners twice, some edges with a corner on them, some corners moved onto others.
void spoil(Dice& dice, Points& ring) {
    for (int round = dice.below(4); round > 0; --round) {
        const auto at = static_cast<std::size_t>(dice.below(static_cast<int>(ring.size())));
        const Vec2 p = ring[at], q = ring[(at + 1) % ring.size()];
        const auto where = ring.begin() + static_cast<std::ptrdiff_t>(at);
        switch (dice.below(4)) {
        case 0:
            ring.insert(where, p);
            break;
        case 1:
            ring.insert(where + 1, {p.x + std::trunc((q.x - p.x) / 2), p.y + std::trunc((q.y - p.y) / 2)});
            break;
        case 2:
            *where = ring[static_cast<std::size_t>(dice.below(static_cast<int>(ring.size())))];
            break;
        default:
            ring.insert(where + 1, {q.x + (q.x - p.x), q.y + (q.y - p.y)});
            break; // and back
        }
    }
}

Many drawn(std::uint64_t seed) {
    Dice dice(seed);
    Many rings;
    const int count = 1 + (dice.below(4) == 0) + (dice.below(8) == 0);
    for (int i = 0; i < count; ++i) {
        const int kind = dice.below(6);
        rings.push_back(kind == 0   ? rough_star(dice)
                        : kind == 1 ? rough_comb(dice)
                        : kind == 2 ? scattered(dice, 3 + dice.below(10), 30)
                                    : scattered(dice, 1 + dice.below(8), 2 + dice.below(6)));
        spoil(dice, rings.back());
    }
    return rings;
}

Contact contact_of_ring(const Points& ring) {
    const Ring one = ring;
    return contact(std::span(&one, 1));
}

} // namespace

TEST_CASE("how rings meet is what all pairs of their edges say", "[geometry]") {
    std::array<int, 3> seen{};
    for (std::uint64_t seed = 0; seed < 30'000; ++seed) {
        const Many rings = drawn(seed);
        const Contact wanted = contact_by_pairs(rings);
        INFO(seed);
        REQUIRE(contact(rings_of(rings)) == wanted);
        Many more = rings; // too many edges to test all pairs
        more.push_back(moved(regular(20, 10), {-1000, 0}));
        REQUIRE(contact(rings_of(more)) == wanted);
        ++seen[static_cast<std::size_t>(wanted)];
    }
    for (const int count : seen) CHECK(count > 2000);
}

TEST_CASE("how large stars and combs meet themselves, one corner moved", "[geometry]") {
    // Whole numbers, so that contact_by_pairs is exact; moved far enough to cross a spike, and onto another
    // corner.
    Points star, comb;
    for (int i = 0; i < 400; ++i) {
        const double angle = M_PI * i / 200, radius = i % 2 == 0 ? 1e6 : 1e4;
        star.push_back({std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle))});
    }
    for (int i = 0; i < 100; ++i)
        for (const Vec2 p : {Vec2{0, 0}, Vec2{20000, 20000}, Vec2{20004, 20000}, Vec2{4, 0}})
            comb.push_back(p + Vec2{10.0 * i, 0});
    comb.insert(comb.end(), {{1000, -10}, {0, -10}});
    for (const Points& ring : {star, comb}) {
        std::array<int, 3> seen{};
        for (std::size_t moved = 0; moved < ring.size(); moved += 37)
            for (const Vec2& by :
                 {Vec2{0, 0}, Vec2{300, -450}, ring[(moved + 3) % ring.size()] - ring[moved]}) {
                Points bent = ring;
                bent[moved] = bent[moved] + by;
                const Contact wanted = contact_by_pairs({bent});
                CHECK(contact_of_ring(bent) == wanted);
                ++seen[static_cast<std::size_t>(wanted)];
            }
        CHECK(seen[0] > 0);
        CHECK(seen[2] > 0);
    }
}

// The boxes of nearly all pairs of edges overlap.
TEST_CASE("a star and a comb of 100,000 corners are seen through at once", "[geometry]") {
    Points star, comb;
    for (int i = 0; i < 100'000; ++i) {
        const double angle = M_PI * i / 50'000, radius = i % 2 == 0 ? 1 : 0.01;
        star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    for (int i = 0; i < 25'000; ++i)
        for (const Vec2 p : {Vec2{0, 0}, Vec2{250'000, 250'000}, Vec2{250'004, 250'000}, Vec2{4, 0}})
            comb.push_back(p + Vec2{10.0 * i, 0});
    comb.insert(comb.end(), {{250'000, -10}, {0, -10}});
    CHECK(contact_of_ring(star) == Contact::none);
    CHECK(contact_of_ring(comb) == Contact::none);
    std::swap(star[50'000], star[50'002]);
    CHECK(contact_of_ring(star) == Contact::crossing);
}

TEST_CASE("rings that run over few places, or along one line, many times are seen through at once",
          "[geometry]") {
    Points three, line;
    for (int i = 0; i < 200'001; ++i) {
        three.push_back(i % 3 == 0 ? Vec2{0, 0} : i % 3 == 1 ? Vec2{1, 0} : Vec2{0, 1});
        line.push_back({static_cast<double>(i % 2 == 0 ? i : 400'000 - i), 0});
    }
    CHECK(contact_of_ring(three) == Contact::touching);
    CHECK(contact_of_ring(line) == Contact::touching);
    line.insert(line.end(), {{150'000, 1}, {150'000.5, -1}}); // across all of it
    CHECK(contact_of_ring(line) == Contact::crossing);
}

TEST_CASE("edges that run back are seen, however short", "[geometry]") {
    const double tiny = 1e-200; // whose square is no double
    CHECK(contact_of_ring({{0, 0}, {tiny, 0}, {2 * tiny, 0}, {tiny, 0}, {0, tiny}}) == Contact::touching);
    CHECK(contact_of_ring({{0, 0}, {3 * tiny, 0}, {tiny, 0}, {0, tiny}}) == Contact::touching);
    CHECK(contact_of_ring({{0, 0}, {tiny, 0}, {3 * tiny, 0}, {0, tiny}}) == Contact::none);
}
