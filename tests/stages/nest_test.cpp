#include "mesh/placement.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"

#include <algorithm>

using namespace facetmill;
using test::run_stage;

namespace {

struct Footprint {
    std::size_t plate;
    double x, y, width, depth;
};

void check_footprints(const std::vector<Footprint>& all, double width, double depth, double spacing) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Footprint& a = all[i];
        CHECK(a.x >= 0);
        CHECK(a.y >= 0);
        CHECK(a.x + a.width <= width + 1e-6);
        CHECK(a.y + a.depth <= depth + 1e-6);
        for (std::size_t k = 0; k < i; ++k) {
            const Footprint& b = all[k];
            const double dx = std::max(a.x - (b.x + b.width), b.x - (a.x + a.width));
            const double dy = std::max(a.y - (b.y + b.depth), b.y - (a.y + a.depth));
            CHECK((a.plate != b.plate || std::max(dx, dy) >= spacing - 1e-6));
        }
    }
}

} // namespace

TEST_CASE("nest moves parts to their places on the ground", "[bed]") {
    for (const UpAxis up : {UpAxis::z, UpAxis::y}) {
        Scene scene;
        scene.up = up;
        for (int i = 0; i < 7; ++i) {
            Part& part = scene.parts.emplace_back();
            part.name = "p" + std::to_string(i);
            part.mesh = shapes::cube();
            for (Vec3& p : part.mesh.positions) p = {p.x * (10 + i), p.y * (40 - 3 * i), p.z * (5 + 4 * i)};
            part.transform.m[0][3] = -50 * i;
            part.transform.m[2][3] = 13;
        }
        const auto run = run_stage("nest", "{plate: [60, 50, 60], spacing: 2}", scene);
        const std::size_t axis = up == UpAxis::y ? 1 : 2;
        std::vector<Footprint> all;
        for (std::size_t i = 0; i < run.scene.parts.size(); ++i) {
            const Box box = box_of(in_world(run.scene.parts[i]).positions);
            CHECK(box.min[axis] == Approx(0).margin(1e-9));
            const Json& entry = run.record.result["parts"][i];
            const std::size_t plate = entry["plate"].get<std::size_t>() - 1;
            const double x = box.min.x - static_cast<double>(plate) * 72;
            const double y = up == UpAxis::y ? -box.max.z : box.min.y;
            CHECK(entry["at"][0].get<double>() == Approx(x).margin(1e-9));
            CHECK(entry["at"][1].get<double>() == Approx(y).margin(1e-9));
            all.push_back({plate, x + 1e-9, y + 1e-9, box.extent().x,
                           up == UpAxis::y ? box.extent().z : box.extent().y});
            CHECK(run.scene.parts[i].transform.determinant() == Approx(1));
        }
        check_footprints(all, 60, 50, 2);
    }
}

TEST_CASE("nest names all parts without a place", "[bed]") {
    Scene scene = test::scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "long";
    scene.parts[1].transform.m[0][0] = 300;
    scene.parts[2].name = "tall";
    scene.parts[2].transform.m[2][2] = 300;
    CHECK(test::failure([&] {
              run_stage("nest", "{plate: [200, 200, 200]}", scene);
          }).starts_with("stage [E-NEST] nest: 2 parts have no place: 'long', 'tall'"));
    CHECK(test::problems_of("nest", test::options({{"plate", "-1"}})) ==
          "E-NEST nest: the lengths of plate must be above 0, found -1 | write, for example, plate: [250mm, "
          "210mm]");
}
