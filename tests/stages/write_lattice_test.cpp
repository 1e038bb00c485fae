#include "support/catch.hpp"

#include "io/codec.hpp"
#include "mesh/shapes.hpp"
#include "stages/write/lattice.hpp"
#include "support/bench.hpp"

#include <cmath>
#include <limits>
#include <set>

namespace write_lattice_test {

using namespace facetmill;
using namespace facetmill::test;

Part& add(Scene& scene, Mesh mesh, double scale = 1, const Vec3& at = {}) {
    Part& part = scene.parts.emplace_back();
    part.name = "part";
    part.mesh = std::move(mesh);
    part.transform = {{{scale, 0, 0, at.x}, {0, scale, 0, at.y}, {0, 0, scale, at.z}}};
    return part;
}

Scene metres() {
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    return scene;
}

write_stage::EvenGrid grid_of(const Scene& scene, int bits = 14) {
    const std::vector<int> usual(scene.parts.size(), 12);
    const auto views = io::part_views(scene);
    return write_stage::even_grid(scene, write_stage::parts_sharing_grids(scene, views), usual,
                                  {io::drawn_bounds(scene, views).longest_side(), bits, bits}, views);
}

/// The file after reading it back.
Scene written(Bench& b, const std::string& options) {
    Problems problems;
    const auto source = std::make_shared<const SourceText>(SourceText{"test.yaml", options});
    b.run("write", pipeline::parse_yaml(source, problems));
    b.state.outputs.commit();
    io::ReadLog log;
    return io::read_scene(io::Input::open(b.dir / "a.glb"), {}, log);
}

/// Half of a sphere, with its open border in the plane x = 0.
Mesh half_ball(bool right) {
    const Mesh ball = shapes::icosphere(3);
    Mesh half;
    half.positions = ball.positions;
    for (Index f = 0; f < ball.face_count(); ++f) {
        double x = 0;
        for (const Index w : ball.face_wedges(f)) x += ball.positions[ball.vertex_of_wedge(w)].x;
        if ((x > 0) != right) continue;
        for (const Index w : ball.face_wedges(f)) half.corners.push_back(ball.vertex_of_wedge(w));
    }
    return half;
}

/// The positions in the world, to a millionth of a step.
std::set<std::array<std::int64_t, 3>> places(const Part& part, double step) {
    std::set<std::array<std::int64_t, 3>> all;
    for (const Vec3& v : part.mesh.positions) {
        const Vec3 p = part.transform.point(v);
        all.insert(
            {std::llround(p.x / step * 100), std::llround(p.y / step * 100), std::llround(p.z / step * 100)});
    }
    return all;
}

TEST_CASE("on an even grid, parts that meet keep meeting", "[stages]") {
    const auto common = [](const std::string& grid) {
        Bench b;
        b.scene = metres();
        add(b.scene, half_ball(false), 1, {0.123, 0.456, 0.789});
        add(b.scene, half_ball(true), 0.5, {0.123, 0.456, 0.789});
        for (Vec3& p : b.scene.parts[1].mesh.positions) p = p * 2; // the same surface at another scale
        add(b.scene, shapes::cube(), 3, {5, 0, 0});
        const Scene back =
            written(b, "{path: a.glb, meshopt: true, quantize: {position: 10, grid: " + grid + "}}");
        const double step = 8.0 / 1023; // about
        CHECK(b.state.record.outputs.back().read_back["position_error"].get<double>() < step);
        const auto left = places(back.parts.at(0), step), right = places(back.parts.at(1), step);
        std::size_t both = 0;
        for (const auto& p : left) both += right.count(p);
        return both;
    };
    CHECK(common("even") > 40); // a border of 3 subdivisions
    CHECK(common("mesh") < 10);
}

TEST_CASE("all parts have the steps of the scene, in their own coordinates", "[stages]") {
    Scene scene = metres();
    add(scene, shapes::cube(), 10);
    add(scene, shapes::cube(), 0.01, {5, 5, 5});
    const auto grid = grid_of(scene);
    const double step = 10.0 / 16383;
    CHECK(grid.lattices[0].step * 10 >= step);
    CHECK(grid.lattices[0].step * 10 < step * 1.001);
    CHECK(std::abs(grid.lattices[1].step * 0.01 - grid.lattices[0].step * 10) < 1e-12);
    CHECK(grid.bits[0] == 14);
    CHECK(grid.bits[1] == 5); // 0.01 / step is 16.4
    for (const std::string how :
         {"draco: {grid: even}", "quantize: {grid: even}", "meshopt: true, quantize: {grid: even}"}) {
        Bench b;
        b.scene = scene;
        const Scene back = written(b, "{path: a.glb, " + how + "}");
        // Under Draco, all parts have the bits of the scene, so that equal points stay equal to the last bit.
        const bool draco = how.starts_with("draco");
        const Json& bits = b.record.result[draco ? "draco" : "quantize"];
        CHECK(bits.value("least", 14) == (draco ? 14 : 5));
        CHECK(b.state.record.outputs.back().read_back["position_error"].get<double>() < step);
        CHECK(back.parts[1].mesh.face_count() == 12);
    }
}

TEST_CASE("steps are finer where vertices would coincide", "[stages]") {
    Scene scene = metres();
    add(scene, shapes::cube(), 1000);
    add(scene, shapes::icosphere(3), 1);
    const auto grid = grid_of(scene);
    CHECK(grid.bits[1] > 5);
    CHECK(grid.bits[1] < 10);
    // The ratio is a power of two, so that its points are among the points of the scene's grid.
    const double ratio = grid.lattices[0].step * 1000 / grid.lattices[1].step;
    CHECK(std::abs(std::log2(ratio) - std::round(std::log2(ratio))) < 1e-9);
    Bench b;
    b.scene = scene;
    written(b, "{path: a.glb, quantize: {position: 14, grid: even}}");
    CHECK(b.record.warnings.empty());
}

TEST_CASE("one mesh has one grid, and what moves or is turned its own", "[stages]") {
    Scene scene = metres();
    for (const double scale : {1.0, 4.0}) {
        Part& part = add(scene, shapes::cube(), scale);
        part.document = part.source_mesh = 0;
    }
    const auto larger = [](double by) {
        Mesh mesh = shapes::cube();
        for (Vec3& p : mesh.positions) p = p * by;
        return mesh;
    };
    Part& turned = add(scene, larger(1.5));
    turned.transform = {{{0, -1, 0, 0.3}, {1, 0, 0, 0}, {0, 0, 1, 0}}};
    add(scene, larger(2));
    const std::vector<int> usual{12, 12, 12, 11};
    auto views = io::part_views(scene);
    views[3].animated = true;
    const auto grid = write_stage::even_grid(scene, write_stage::parts_sharing_grids(scene, views), usual,
                                             {io::drawn_bounds(scene, views).longest_side(), 14, 14}, views);
    CHECK(grid.lattices[0].step == grid.lattices[1].step);
    CHECK(grid.lattices[1].step * 4 < 5.2 / 16383 * 1.001); // the larger one's
    CHECK(grid.lattices[2].origin == Vec3{0, 0, 0});
    CHECK(grid.lattices[3].step == 0);
    CHECK(grid.bits[3] == 11);
}

TEST_CASE("equal parts share a grid under nodes of equal scale", "[stages]") {
    Scene scene = metres();
    for (const double scale : {3.0, 1.0, 3.0 * (1 + 0x1p-24)}) add(scene, shapes::cube(), scale);
    add(scene, shapes::icosphere(2), 3);
    for (const double scale : {1.0, 3.0}) { // one mesh, whose larger node needs the grid of the first part
        Part& part = add(scene, shapes::cube(), scale);
        part.document = 0;
        part.source_mesh = 7;
    }
    const auto shared = write_stage::parts_sharing_grids(scene, io::part_views(scene));
    CHECK(shared.first == std::vector<std::size_t>{0, 1, 0, 3, 0, 0});
}

TEST_CASE("an even grid takes one point, flat parts, far ones and huge ones", "[stages]") {
    Scene scene = metres();
    Mesh point = shapes::cube();
    for (Vec3& p : point.positions) p = {3, 3, 3};
    Mesh flat = shapes::cube();
    for (Vec3& p : flat.positions) p.z = 0;
    add(scene, point);
    add(scene, flat, 1, {5e6, 4e5, 0});
    add(scene, shapes::cube(), 1, {5e6, 4e5, 0});
    add(scene, Mesh{});
    const auto grid = grid_of(scene);
    CHECK(grid.lattices[0].step > 0);
    CHECK(grid.bits[0] == 1);
    CHECK(grid.lattices[3].step == 0);
    for (std::size_t i : {1, 2}) {
        const auto& lattice = grid.lattices[i];
        for (const Vec3& p : scene.parts[i].mesh.positions)
            for (std::size_t c = 0; c < 3; ++c) {
                const double n = (p[c] - lattice.origin[c]) / lattice.step;
                CHECK(n >= -1e-6);
                CHECK(n < 16384);
            }
    }
    add(scene, shapes::cube(), 1e300);
    for (const auto& lattice : grid_of(scene).lattices)
        for (std::size_t c = 0; c < 3; ++c) CHECK(std::isfinite(lattice.origin[c]));
    Bench b;
    b.scene = scene;
    CHECK_NOTHROW(written(b, "{path: a.glb, quantize: {position: 14, grid: even}}"));
    Scene broken = metres();
    add(broken, shapes::cube()).mesh.positions[0].x = std::numeric_limits<double>::quiet_NaN();
    add(broken, shapes::cube());
    CHECK_NOTHROW(grid_of(broken));
    CHECK(grid_of(metres()).lattices.empty());
}

TEST_CASE("chunks that meet still meet in files, by default", "[stages]") {
    Scene scene = metres();
    const Mesh field = shapes::grid(20, 20);
    const Box box = field.bounds();
    const Vec3 middle = box.centre();
    for (int quarter = 0; quarter < 4; ++quarter) { // those of a plane, with heights and an odd size
        Mesh mesh;
        std::vector<Index> number(field.vertex_count(), none);
        for (Index f = 0; f < field.face_count(); ++f) {
            Vec3 centre;
            for (const Index w : field.face_wedges(f)) centre = centre + field.positions[w] * (1.0 / 3);
            if ((centre.x > middle.x) + 2 * (centre.y > middle.y) != quarter) continue;
            for (const Index w : field.face_wedges(f)) {
                if (number[w] == none) {
                    const Vec3 p = field.positions[w] - box.min;
                    number[w] = static_cast<Index>(mesh.positions.size());
                    mesh.positions.push_back({7.3 * p.x, 7.3 * p.y, 0.9 * p.x * p.y});
                }
                mesh.corners.push_back(number[w]);
            }
        }
        add(scene, std::move(mesh));
    }
    for (const char* given :
         {"{path: a.glb, draco: true}", "{path: a.glb, meshopt: true}", "{path: a.glb, quantize: true}"}) {
        INFO(given);
        Bench b;
        b.scene = scene;
        const Scene again = written(b, given);
        std::vector<Vec3> points;
        for (const Part& part : again.parts)
            for (const Vec3& p : part.mesh.positions) points.push_back(part.transform.point(p));
        REQUIRE(points.size() == 4 * 11 * 11);
        std::size_t met = 0;
        const double size = scene.bounds().diagonal();
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) met += length(points[i] - points[k]) < 1e-8 * size;
        CHECK(met == 2 * 20 + 6); // pairs on the borders, and the six of the middle
    }
}

} // namespace write_lattice_test
