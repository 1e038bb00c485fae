#include "support/catch.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/quantities/quantities.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/run_stage.hpp"

#include <algorithm>

using namespace facetmill;
using test::scene_of;

namespace {

Part part_of_size(Mesh mesh, double factor) {
    for (Vec3& p : mesh.positions) p = p * factor;
    return scene_of(std::move(mesh)).parts[0];
}

std::vector<double> numbers_of(const char* name, const Part& part, const FaceTree* other = nullptr) {
    return values_of(*quantity_named(name), part, other);
}

void check_numbers(const std::vector<double>& found, double expected, double relative) {
    REQUIRE_FALSE(found.empty());
    const auto [least, most] = std::minmax_element(found.begin(), found.end());
    CHECK(*least == Approx(expected).epsilon(relative));
    CHECK(*most == Approx(expected).epsilon(relative));
}

} // namespace

TEST_CASE("equilateral triangles have angles of 60 degrees, whatever their size", "[geometry]") {
    for (const double size : {1.0, 1e-170, 1e200}) {
        const Part part = part_of_size(shapes::octahedron(), size);
        check_numbers(numbers_of("min_angle", part), 60, 1e-12);
        check_numbers(numbers_of("max_angle", part), 60, 1e-12);
        check_numbers(numbers_of("aspect_ratio", part), 1, 1e-12);
        check_numbers(numbers_of("shortest_edge", part), std::sqrt(2.0) * size, 1e-12);
    }
}

TEST_CASE("the walls of a ball are as thick as it, and its curvature is that of its radius", "[geometry]") {
    constexpr double r = 3;
    const Part ball = part_of_size(shapes::icosphere(4), r);
    check_numbers(numbers_of("wall_thickness", ball), 2 * r, 0.01);
    // Except at the twelve vertices of five faces, where a third of the area is not the nearest region.
    const auto median = [&](const char* name) {
        auto all = numbers_of(name, ball);
        std::nth_element(all.begin(), all.begin() + 1000, all.end());
        return all[1000];
    };
    CHECK(median("mean_curvature") == Approx(1 / r).epsilon(0.01));
    CHECK(median("gaussian_curvature") == Approx(1 / (r * r)).epsilon(0.01));
    // Opposite faces of an octahedron are parallel: twice its inradius.
    check_numbers(numbers_of("wall_thickness", part_of_size(shapes::octahedron(), r)), 2 * r / std::sqrt(3.0),
                  1e-12);
}

TEST_CASE("numbers are those of the world", "[geometry]") {
    Part part = part_of_size(shapes::octahedron(), 1);
    part.transform = {{{2, 0, 0, 5}, {0, 2, 0, 0}, {0, 0, -2, 0}}}; // mirrored
    check_numbers(numbers_of("wall_thickness", part), 4 / std::sqrt(3.0), 1e-12);
    check_numbers(numbers_of("area", part), 2 * std::sqrt(3.0), 1e-12);
}

TEST_CASE("deviation is positive outside, negative inside and 0 on the surface", "[geometry]") {
    const FaceTree ball(surface_of(shapes::icosphere(4)));
    check_numbers(numbers_of("deviation", part_of_size(shapes::icosphere(4), 1.25), &ball), 0.25, 0.01);
    check_numbers(numbers_of("deviation", part_of_size(shapes::icosphere(4), 0.75), &ball), -0.25, 0.01);
    CHECK(numbers_of("deviation", part_of_size(shapes::icosphere(4), 1), &ball) ==
          std::vector<double>(shapes::icosphere(4).vertex_count(), 0.0));
    const FaceTree nothing{Surface{}};
    CHECK(std::isnan(numbers_of("deviation", part_of_size(shapes::cube(), 1), &nothing)[0]));
}

TEST_CASE("what has no number is told", "[geometry]") {
    const Part sheet = part_of_size(shapes::grid(2, 2), 1);
    for (const double x : numbers_of("wall_thickness", sheet)) CHECK(std::isnan(x));
    const auto bends =
        numbers_of("mean_curvature", sheet); // all vertices except the middle are on the boundary
    CHECK(std::count_if(bends.begin(), bends.end(), [](double x) { return std::isnan(x); }) == 8);
    Part flat = part_of_size(shapes::cube(), 1);
    flat.mesh.positions[0] = flat.mesh.positions[1] = flat.mesh.positions[2];
    CHECK(std::isnan(numbers_of("aspect_ratio", flat)[0]));
    Part kept = sheet;
    give_attribute(kept, *quantity_named("wall_thickness"), numbers_of("wall_thickness", sheet), -1);
    CHECK(kept.mesh.find("wall_thickness", Domain::face)->value(3, 0) == -1);
}

TEST_CASE("properties of faces are the least or the most of the numbers of their names", "[geometry]") {
    const Part part = part_of_size(shapes::torus(12, 7), 2);
    std::size_t compared = 0;
    for (const Property& p : property_table()) {
        if (!p.of_faces) continue;
        const Quantity* q = quantity_named(p.name);
        REQUIRE(q);
        auto all = values_of(*q, part);
        std::erase_if(all, [](double x) { return std::isnan(x); }); // no wall opposite, or no gap
        const auto [least, most] = std::minmax_element(all.begin(), all.end());
        INFO(p.name);
        if (all.empty())
            CHECK(!measure(part.mesh, p));
        else
            CHECK(measure(part.mesh, p) == (p.join == Join::least ? *least : *most));
        ++compared;
    }
    CHECK(compared == 10);
}

TEST_CASE("numbers are the same for any number of threads", "[geometry]") {
    const Part part = part_of_size(shapes::icosphere(5), 1.5);
    const FaceTree other(surface_of(shapes::icosphere(3)));
    for (const Quantity& q : quantities()) {
        std::vector<std::vector<double>> found;
        for (const int count : {1, 3}) {
            set_threads(count);
            found.push_back(values_of(q, part, &other));
            for (double& x : found.back())
                if (std::isnan(x)) x = -1; // nan differs from itself
        }
        set_threads(0);
        CAPTURE(q.name);
        CHECK(found[0] == found[1]);
    }
}

TEST_CASE("quantities have names, units, and other names that are no names", "[geometry]") {
    const auto unit = [](const char* name, Unit of) { return unit_of(*quantity_named(name), of); };
    CHECK(unit("min_angle", Unit::mm) == "degrees");
    CHECK(unit("aspect_ratio", Unit::mm).empty());
    CHECK(unit("wall_thickness", Unit::mm) == "mm");
    CHECK(unit("area", Unit::unknown) == "scene units^2");
    CHECK(unit("mean_curvature", Unit::mm) == "1/mm");
    CHECK(unit("gaussian_curvature", Unit::unknown) == "1/scene unit^2");
    CHECK(quantity_called("thickness")->name == "wall_thickness");
    CHECK(quantity_called("smallest_angle")->name == "min_angle");
    CHECK(quantity_called("curvature")->name == "mean_curvature");
    CHECK_FALSE(quantity_called("failed"));
    for (const Quantity& q : quantities())
        for (const auto word : q.other_names) CHECK_FALSE(quantity_named(word));
}
