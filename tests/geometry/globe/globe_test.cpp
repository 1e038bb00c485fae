#include "support/catch.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/globe/globe.hpp"

#include <cmath>

using namespace facetmill;

namespace globe_test {

namespace {

Geodetic degrees(double latitude, double longitude, double height) {
    return {latitude * pi / 180, longitude * pi / 180, height};
}

/// Within a hundredth of a millimetre.
void check_near(const Vec3& a, const Vec3& b) { CHECK(length(a - b) < 1e-5); }

} // namespace

TEST_CASE("geodetic places have the geocentric coordinates that PROJ gives", "[geometry]") {
    check_near(geocentric(degrees(0, 0, 0)), {6378137, 0, 0});
    check_near(geocentric(degrees(90, 0, 0)), {0, 0, 6356752.314245});
    check_near(geocentric(degrees(48.8584, 2.2945, 330)), {4201152.758655, 168331.794517, 4780461.560653});
    check_near(geocentric(degrees(-33.8568, 151.2153, 5)),
               {-4646972.276464, 2553078.919527, -3533269.913086});
    check_near(geocentric(degrees(78.2232, 15.6267, 12)), {1257701.590394, 351788.457605, 6222081.793025});
    check_near(geocentric(degrees(27.9881, 86.925, 8848.86)),
               {302769.934269, 5636026.225470, 2979493.490937});
}

TEST_CASE("a local frame is east, north and up, turned clockwise by its heading", "[geometry]") {
    const Geodetic place = degrees(48.8584, 2.2945, 330);
    const Transform t = local_frame(place);
    CHECK(t.determinant() == Approx(1));
    check_near(t.point({0, 0, 10}), geocentric(degrees(48.8584, 2.2945, 340)));
    const Vec3 north = normalised(geocentric(degrees(48.85841, 2.2945, 330)) - geocentric(place));
    const Vec3 east = normalised(geocentric(degrees(48.8584, 2.29451, 330)) - geocentric(place));
    CHECK(dot(t.vector({0, 1, 0}), north) == Approx(1));
    CHECK(dot(t.vector({1, 0, 0}), east) == Approx(1));
    const Transform turned = local_frame(place, pi / 2);
    CHECK(dot(turned.vector({0, 1, 0}), east) == Approx(1));
    CHECK(dot(turned.vector({1, 0, 0}), north) == Approx(-1));
}

TEST_CASE("projected coordinates have the geocentric coordinates that PROJ gives", "[geometry]") {
    const auto at = [](const char* name, const Vec3& p) {
        const auto system = ProjectedSystem::named(name);
        REQUIRE(system);
        CHECK(system->may_hold(p));
        return system->geocentric(p);
    };
    check_near(at("EPSG:32632", {500608, 5200512, 384}), {4307561.681367, 682866.608201, 4638870.171784});
    check_near(at("epsg:32632", {123456.7, 9000000, 10}), {1039239.920876, -216350.703108, 6268105.238257});
    check_near(at("EPSG:32756", {334786, 6252080, 50}), {-4646847.166618, 2553145.029770, -3533466.670944});
    check_near(at("EPSG:32756", {900000, 9990000, 0}), {-5853218.442295, 2533843.937836, -9984.208262});
    check_near(at("EPSG:3857", {1821000, 6141000, 200}), {4086493.955809, 1199491.133237, 4732235.326025});
    // ETRS89 is taken as WGS84, whose ellipsoid differs by a tenth of a millimetre.
    CHECK(length(at("EPSG:25833", {390000, 5820000, 35}) -
                 Vec3{3783763.806575, 899941.151720, 5038178.845579}) < 2e-4);
    for (const char* name : {"EPSG:4326", "EPSG:32600", "EPSG:32661", "25832", "utm", "EPSG:", ""})
        CHECK_FALSE(ProjectedSystem::named(name));
}

TEST_CASE("the frame at a projected point follows the grid", "[geometry]") {
    const auto system = ProjectedSystem::named("EPSG:32632");
    REQUIRE(system);
    const Vec3 p{700000, 5200000, 100};
    const Transform t = system->frame_at(p);
    CHECK(t.determinant() == Approx(1));
    check_near(t.point({}), system->geocentric(p));
    const Vec3 east = normalised(system->geocentric(p + Vec3{1, 0, 0}) - system->geocentric(p));
    CHECK(dot(t.vector({1, 0, 0}), east) == Approx(1));
    CHECK(dot(t.vector({0, 0, 1}),
              normalised(system->geocentric(p + Vec3{0, 0, 1}) - system->geocentric(p))) == Approx(1));
    CHECK_FALSE(system->may_hold({-2e6, 46.9, 0}));
    CHECK_FALSE(system->may_hold({NAN, 0, 0}));
}

} // namespace globe_test
