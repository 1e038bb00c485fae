#include "support/catch.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/model_row/model_row.hpp"
#include "mesh/shapes.hpp"

#include <limits>

using namespace facetmill;

namespace model_row_test {

namespace {

Scene scene_of(Mesh mesh, UpAxis up = UpAxis::z) {
    Scene scene;
    scene.unit = Unit::mm;
    scene.up = up;
    Part part;
    part.mesh = std::move(mesh);
    scene.parts.push_back(std::move(part));
    return scene;
}

std::optional<double> value(const ModelRow& row, std::string_view name) {
    const auto columns = model_columns();
    for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns[i].name == name) return row.values.at(i);
    FAIL("no column " << name);
    return {};
}

/// The unit cube from `low` to `low` + 1 along every axis, turned so that its bottom slopes by this angle.
Mesh turned_cube(double degrees) {
    Mesh mesh = shapes::cube();
    const double angle = degrees * pi / 180;
    for (Vec3& p : mesh.positions)
        p = {p.x * cosine(angle) - p.z * sine(angle), p.y, p.x * sine(angle) + p.z * cosine(angle)};
    return mesh;
}

} // namespace

TEST_CASE("the row of a cube has its analytic measures", "[model_row]") {
    const Mesh cube = shapes::cube();
    const double side = cube.bounds().longest_side();
    const ModelRow row = model_row(scene_of(cube), {});
    CHECK(row.unit == "mm");
    CHECK(value(row, "volume").value() == Approx(side * side * side));
    CHECK(value(row, "area").value() == Approx(6 * side * side));
    CHECK(value(row, "height").value() == Approx(side));
    CHECK(value(row, "wall_thickness").value() == Approx(side));
    CHECK(value(row, "overhang_area") == 0); // its bottom lies on the plate
    CHECK(value(row, "bounds_min_x") == cube.bounds().min.x);
    CHECK(value(row, "bounds_max_z") == cube.bounds().max.z);
    CHECK(value(row, "parts") == 1);
    CHECK(value(row, "components") == 1);
    CHECK(value(row, "triangles") == 12);
    CHECK(value(model_row(scene_of(shapes::quad_cube()), {}), "triangles") == 12);
}

TEST_CASE("a face overhangs if its slope is below the angle", "[model_row]") {
    const double side = shapes::cube().bounds().longest_side();
    const auto overhang = [](double turn, double below) {
        return value(model_row(scene_of(turned_cube(turn)), {below * pi / 180, false}), "overhang_area")
            .value();
    };
    CHECK(overhang(30, 45) == Approx(side * side));
    CHECK(overhang(30, 29) == Approx(0));
    CHECK(overhang(30, 61) == Approx(2 * side * side)); // the other side that looks down slopes by 60 degrees
    CHECK(overhang(30, 90) == Approx(2 * side * side));
}

TEST_CASE("the up axis decides height and overhangs", "[model_row]") {
    Mesh slab = shapes::cube();
    for (Vec3& p : slab.positions) p.y *= 3;
    const double side = shapes::cube().bounds().longest_side();
    CHECK(value(model_row(scene_of(slab, UpAxis::y), {}), "height").value() == Approx(3 * side));
    CHECK(value(model_row(scene_of(slab, UpAxis::unknown), {}), "height").value() == Approx(side));
}

TEST_CASE("a row of an open or empty model has no volume", "[model_row]") {
    Mesh open = shapes::cube();
    open.corners.resize(open.corners.size() - 3);
    const ModelRow row = model_row(scene_of(open), {});
    CHECK_FALSE(value(row, "volume"));
    CHECK(value(row, "triangles") == 11);
    const ModelRow none = model_row(scene_of({}), {});
    CHECK_FALSE(value(none, "height"));
    CHECK_FALSE(value(none, "bounds_min_x"));
    CHECK(value(none, "triangles") == 0);
}

TEST_CASE("the row of a part follows its transform and counts one part", "[model_row]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    const ModelRow both = model_row(scene, {}), one = model_row(scene, scene.parts[1], {});
    CHECK(value(both, "parts") == 2);
    CHECK(value(one, "parts") == 1);
    CHECK(value(both, "volume").value() == Approx(2 * value(one, "volume").value()));
}

} // namespace model_row_test
