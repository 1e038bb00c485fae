// Checks the detection of faces that cannot bound the result. Compares with distances, and with results for
// solids that pass through themselves without effect.
#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "geometry/boolean/combine.hpp"
#include "geometry/boolean/lost_faces.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"

using namespace facetmill;
using namespace facetmill::test;
using namespace facetmill::clean_steps;

namespace {

constexpr std::array all_operations{CombineOperation::unite, CombineOperation::subtract,
                                    CombineOperation::intersect};

Mesh ball(int level, const Vec3& centre, double radius) {
    Mesh mesh = shapes::icosphere(level);
    for (Vec3& p : mesh.positions) p = centre + p * radius;
    return mesh;
}

Mesh joined(std::vector<Mesh> meshes) {
    Mesh all = std::move(meshes[0]);
    for (std::size_t i = 1; i < meshes.size(); ++i) append(all, meshes[i]);
    return all;
}

struct Pair {
    Mesh both;
    std::vector<std::uint8_t> second;
};
Pair pair_of(const Mesh& a, const Mesh& b) {
    Pair p{a, std::vector<std::uint8_t>(a.face_count(), 0)};
    append(p.both, b);
    p.second.resize(p.both.face_count(), 1);
    return p;
}

Mesh sound_result(const Mesh& a, const Mesh& b, CombineOperation operation) {
    const auto r = combine({a, b}, {operation, operation == CombineOperation::unite ? none : 1});
    INFO(r.failure.value_or(CombineFailure{}).why);
    REQUIRE(!r.failure);
    check_solid(r.mesh);
    return r.mesh;
}

} // namespace

TEST_CASE("faces are lost that go, and nearly all that go", "[geometry][combine][lost]") {
    const Vec3 apart{0.7, 0.2, 0.1};
    const Pair p = pair_of(ball(5, {}, 1), ball(5, apart, 1));
    for (const CombineOperation operation : all_operations) {
        const auto lost = lost_faces(p.both, p.second, operation);
        REQUIRE(lost.size() == p.both.face_count());
        std::size_t going = 0, known = 0;
        for (Index f = 0; f < lost.size(); ++f) {
            const bool second = p.second[f] != 0,
                       within = length(corner_mean(p.both, f) - (second ? Vec3{} : apart)) < 1;
            const bool goes = operation == CombineOperation::unite       ? within
                              : operation == CombineOperation::intersect ? !within
                                                                         : within != second;
            going += goes;
            known += lost[f];
            if (lost[f]) REQUIRE(goes);
        }
        INFO("operation " << int(operation) << ": " << known << " of " << going);
        CHECK(known * 20 >= going * 17);
    }
}

TEST_CASE("pairs of faces that are lost are not looked for", "[geometry][combine][lost]") {
    const Pair p = pair_of(ball(5, {}, 1), ball(5, {0.7, 0.2, 0.1}, 1));
    const auto place = lowest_at_place(p.both);
    const auto all = crossings_and_rings(p.both, place, max_pairs, {});
    const auto lost = lost_faces(p.both, p.second, CombineOperation::intersect);
    const auto some = crossings_and_rings(p.both, place, max_pairs, lost);
    CHECK(some.found.pairs == all.found.pairs); // no pairs within an operand
    CHECK(some.rings == all.rings);
    CHECK(some.found.box_pairs * 2 < all.found.box_pairs);
}

TEST_CASE("nothing is lost of few faces, nor of solids that are about the same",
          "[geometry][combine][lost]") {
    const Pair few = pair_of(ball(3, {}, 1), ball(3, {0.5, 0, 0}, 1));
    CHECK(lost_faces(few.both, few.second, CombineOperation::unite).empty());
    const Pair same = pair_of(ball(4, {}, 1), ball(4, {}, 1));
    CHECK(lost_faces(same.both, same.second, CombineOperation::unite).empty());
    const Pair beside = pair_of(ball(4, {}, 1), ball(4, {5, 0, 0}, 1)); // all of one, or of both
    CHECK(lost_faces(beside.both, beside.second, CombineOperation::unite).empty());
    const auto all = lost_faces(beside.both, beside.second, CombineOperation::intersect);
    CHECK(std::count(all.begin(), all.end(), 1) == std::ptrdiff_t(beside.both.face_count()));
    const auto drill = lost_faces(beside.both, beside.second, CombineOperation::subtract);
    CHECK(std::equal(drill.begin(), drill.end(), beside.second.begin()));
}

TEST_CASE("solids may pass through themselves where they are lost", "[geometry][combine][lost]") {
    // Two balls that overlap, and the same as one solid; another covers where they meet, wholly or in part.
    const Mesh crossing = joined({ball(4, {-0.4, 0, 0}, 0.6), ball(4, {0.4, 0.1, 0}, 0.6)});
    const Mesh solid =
        sound_result(ball(4, {-0.4, 0, 0}, 0.6), ball(4, {0.4, 0.1, 0}, 0.6), CombineOperation::unite);
    for (const double radius : {0.35, 0.8, 1.5})
        for (const double x : {0.0, 0.5}) {
            const Mesh other = ball(4, {x, 0.03, 0.02}, radius);
            INFO("radius " << radius << " at " << x);
            for (const CombineOperation operation : all_operations) {
                INFO("operation " << int(operation));
                CHECK(test::volume(sound_result(crossing, other, operation)) ==
                      Approx(test::volume(sound_result(solid, other, operation))).epsilon(1e-12));
                CHECK(test::volume(sound_result(other, crossing, operation)) ==
                      Approx(test::volume(sound_result(other, solid, operation))).epsilon(1e-12));
            }
        }
}

TEST_CASE("what winds less than zero times takes nothing away from another part",
          "[geometry][combine][lost]") {
    // Below its waist this ball is inverted, so the winding number is -1 there.
    Mesh turned = ball(4, {}, 1);
    for (Vec3& p : turned.positions) p.x *= p.z + 0.63;
    Mesh other = shapes::cube(); // around the lower part
    for (Vec3& p : other.positions) p = Vec3{-1.5, -1.5, -1.64} + Vec3{p.x * 3, p.y * 3, p.z};
    const double upper =
        test::volume(sound_result(turned, ball(1, {9, 0, 0}, 1), CombineOperation::subtract));
    for (const auto& [a, b] : {std::pair{turned, other}, std::pair{other, turned}})
        CHECK(test::volume(sound_result(a, b, CombineOperation::unite)) == Approx(upper + 9).epsilon(1e-9));
}

TEST_CASE("what is lost is the same for any number of threads", "[geometry][combine][lost]") {
    const Pair p = pair_of(ball(5, {}, 1), ball(5, {0.7, 0.2, 0.1}, 1));
    set_threads(1);
    const auto one = lost_faces(p.both, p.second, CombineOperation::subtract);
    set_threads(3);
    CHECK(lost_faces(p.both, p.second, CombineOperation::subtract) == one);
    set_threads(0);
}
