// Every assertion of validate: one mesh on which it fails, with evidence, and one on which it holds.
#include "geometry/inspect/inspect.hpp"
#include "support/catch.hpp"
#include "support/temporary.hpp"

#include "io/codec.hpp"
#include "mesh/shapes.hpp"
#include "report/contents.hpp"
#include "report/render.hpp"
#include "stage/assertions.hpp"
#include "stage/stage.hpp"
#include "support/run_stage.hpp"

#include <algorithm>
#include <set>

using namespace facetmill;
using test::run_stage;
using test::scene_of;

namespace {

struct Row {
    std::string assertion; ///< "faces: {max: 5}"
    Scene fails, holds;
    bool faces = true; ///< its evidence names faces, and a marked copy shows them

    std::string property() const { return assertion.substr(0, assertion.find(':')); }
};

Mesh scaled(Mesh mesh, double by) {
    for (Vec3& p : mesh.positions) p = p * by;
    return mesh;
}

Mesh joined(Mesh a, const Mesh& b, const Vec3& by) {
    Mesh moved = b;
    for (Vec3& p : moved.positions) p += by;
    append(a, moved);
    return a;
}

/// The cube with its first face, or all faces, reversed.
Mesh turned(std::size_t faces) {
    Mesh mesh = shapes::cube();
    for (std::size_t f = 0; f < faces; ++f) std::swap(mesh.corners[3 * f + 1], mesh.corners[3 * f + 2]);
    return mesh;
}

Mesh with_face(Mesh mesh, Index a, Index b, Index c) {
    const Index face[] = {a, b, c};
    add_face(mesh, face);
    return mesh;
}

Mesh with_point(Mesh mesh) {
    mesh.positions.push_back({5, 5, 5});
    return mesh;
}

Mesh warped_quad() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0}, {0, 1, 0.5}};
    const Index quad[] = {0, 1, 2, 3};
    add_face(mesh, quad);
    return mesh;
}

Mesh cracked() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, -2, 0}, {0, 2, 0}, {1, 0, 0}};
    mesh.corners = {0, 2, 1, 0, 4, 3, 4, 1, 3};
    return mesh;
}

/// The uv_cube with component c of element i of an attribute set to x.
Mesh with_value(const char* name, std::size_t i, int c, double x) {
    Mesh mesh = shapes::uv_cube();
    mesh.find(name, Domain::wedge)->set_value(i, c, x);
    return mesh;
}

Mesh with_weights(double weight) {
    Mesh mesh = shapes::grid(1, 1);
    mesh.attributes.push_back({"WEIGHTS_0", Domain::wedge, Role::weights, 4, false,
                               std::vector<float>(4 * mesh.wedge_count(), 0.25f)});
    mesh.attributes.back().set_value(1, 2, weight);
    return mesh;
}

Mesh with_joints(std::uint16_t joint) {
    Mesh mesh = shapes::grid(1, 1);
    mesh.attributes.push_back({"JOINTS_0", Domain::wedge, Role::joints, 4, false,
                               std::vector<std::uint16_t>(4 * mesh.wedge_count(), joint)});
    return mesh;
}

Mesh mapped_grid() {
    Mesh mesh = shapes::grid(1, 1);
    std::vector<float> uvs;
    for (const Vec3& p : mesh.positions) {
        uvs.push_back(float(p.x));
        uvs.push_back(float(p.y));
    }
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uvs)});
    return mesh;
}

/// The grid with its image upright, as v runs down in glTF.
Mesh upright_grid(double left, double width) {
    Mesh mesh = mapped_grid();
    Attribute& uv = mesh.attributes.back();
    for (std::size_t w = 0; w < uv.size(); ++w) {
        uv.set_value(w, 0, left + width * uv.value(w, 0));
        uv.set_value(w, 1, 1 - uv.value(w, 1));
    }
    return mesh;
}

/// Two grids whose charts are apart by a gap in the texture.
Mesh two_charts(double gap) {
    Mesh all = upright_grid(0, 0.25);
    append(all, upright_grid(0.25 + gap, 0.25));
    return all;
}

Scene in_unit(Unit unit, UpAxis up) {
    Scene scene = scene_of(shapes::cube());
    scene.unit = unit;
    scene.up = up;
    return scene;
}

Scene with_materials(std::size_t count) {
    Scene scene = scene_of(shapes::cube());
    scene.materials.resize(count);
    return scene;
}

Scene with_parts(std::size_t count) {
    Scene scene = scene_of(shapes::cube());
    scene.parts.resize(count, scene.parts.front());
    return scene;
}

/// This many consecutive lines.
Mesh path(Index lines) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}};
    for (Index i = 0; i < lines; ++i) {
        mesh.positions.push_back({1.0 + i, 0, 0});
        mesh.lines.insert(mesh.lines.end(), {i, i + 1});
    }
    return mesh;
}

std::vector<Row> counts() {
    using namespace shapes;
    const Mesh small = scaled(cube(), 0.25);
    return {{"vertices: {max: 7}", scene_of(cube()), scene_of(tetrahedron()), false},
            {"wedges: {max: 8}", scene_of(uv_cube()), scene_of(cube()), false},
            {"edges: {max: 17}", scene_of(cube()), scene_of(tetrahedron()), false},
            {"faces: {max: 11}", scene_of(cube()), scene_of(quad_cube()), false},
            {"triangles: {max: 11}", scene_of(cube()), scene_of(quad_cube()), false},
            {"components: 1", scene_of(joined(cube(), cube(), {3, 0, 0})), scene_of(cube())},
            {"euler: 2", scene_of(torus(8, 6)), scene_of(cube()), false},
            {"genus: 0", scene_of(torus(8, 6)), scene_of(cube()), false},
            {"area: {max: 5}", scene_of(cube()), scene_of(small), false},
            {"volume: {max: 0.5}", scene_of(cube()), scene_of(small), false},
            {"solid_volume: {max: 0.5}", scene_of(cube()), scene_of(small), false},
            {"bounds: {max: [2, 0.5, 2]}", scene_of(cube()), scene_of(small), false},
            {"max_extent: {max: 0.5}", scene_of(cube()), scene_of(small), false},
            {"materials: {max: 1}", with_materials(2), with_materials(1), false},
            {"parts: {max: 1}", with_parts(2), with_parts(1), false},
            {"unit: mm", in_unit(Unit::cm, UpAxis::z), in_unit(Unit::mm, UpAxis::z), false},
            {"up: z", in_unit(Unit::mm, UpAxis::y), in_unit(Unit::mm, UpAxis::z), false}};
}

std::vector<Row> topology() {
    using namespace shapes;
    return {{"boundary_loops: 0", scene_of(grid(2, 2)), scene_of(cube())},
            {"boundary_edges: {max: 7}", scene_of(grid(2, 2)), scene_of(grid(1, 1))},
            {"boundary_length: {max: 7}", scene_of(grid(2, 2)), scene_of(grid(1, 1))},
            {"longest_boundary: {max: 7}", scene_of(grid(2, 2)), scene_of(grid(1, 1))},
            {"closed: true", scene_of(grid(2, 2)), scene_of(cube())},
            {"edge_manifold: true", scene_of(fan3()), scene_of(cube())},
            {"vertex_manifold: true", scene_of(hourglass()), scene_of(cube())},
            {"oriented: true", scene_of(turned(1)), scene_of(turned(12))},
            {"outward_oriented: true", scene_of(turned(12)), scene_of(cube())},
            {"degenerate_faces: 0", scene_of(with_face(cracked(), 0, 4, 1)), scene_of(cracked())},
            {"duplicate_faces: 0", scene_of(with_face(grid(1, 1), 0, 1, 3)), scene_of(grid(1, 1))},
            {"isolated_vertices: 0", scene_of(with_point(cube())), scene_of(cube()), false},
            {"t_junctions: 0", scene_of(cracked()), scene_of(cube())},
            {"self_intersections: 0", scene_of(crossing()), scene_of(joined(cube(), cube(), {1, 1, 0}))},
            {"touching: 0", scene_of(joined(cube(), cube(), {1, 1, 0})), scene_of(crossing())},
            {"hard_edges: 0", scene_of(cube()), scene_of(shapes::icosphere(1)), false},
            {"hard_edges: 12", scene_of(grid(1, 1)), scene_of(cube()), false},
            {"folded_faces: 0", scene_of(folded_quad()), scene_of(cube())},
            {"coplanar_overlaps: 0", scene_of(folded_quad()), scene_of(crossing())}};
}

/// Cubes of side 1 with a gap between them.
Mesh two_cubes(double gap) {
    Mesh all = shapes::cube(), other = all;
    for (Vec3& p : other.positions) p.x += 1 + gap;
    append(all, other);
    return all;
}

std::vector<Row> shapes_and_attributes() {
    using namespace shapes;
    const Mesh small = scaled(cube(), 0.25), uneven = with_value("TEXCOORD_0", 3, 0, 9);
    return {{"min_angle: {min: 50deg}", scene_of(cube()), scene_of(octahedron())},
            {"max_angle: {max: 1.4rad}", scene_of(cube()), scene_of(octahedron())},
            {"aspect_ratio: {max: 1.2}", scene_of(cube()), scene_of(octahedron())},
            {"shortest_edge: {min: 0.5}", scene_of(small), scene_of(cube())},
            {"longest_edge: {max: 1}", scene_of(cube()), scene_of(small)},
            {"nonplanarity: {max: 0.1}", scene_of(warped_quad()), scene_of(quad_cube())},
            {"wall_thickness: {min: 0.5}", scene_of(small), scene_of(cube())},
            {"gap: {min: 0.5}", scene_of(two_cubes(0.25)), scene_of(two_cubes(0.75))},
            {"detail: {min: 0.5}", scene_of(two_cubes(0.25)), scene_of(two_cubes(0.75))},
            {"component_size: {min: 0.5}", scene_of(small), scene_of(cube())},
            {"uvs_in_range: true", scene_of(with_value("TEXCOORD_0", 3, 0, 1.5)), scene_of(uv_cube())},
            {"uv_overlaps: 0", scene_of(uv_cube()), scene_of(mapped_grid())},
            {"mirrored_uvs: 0", scene_of(mapped_grid()), scene_of(upright_grid(0, 1))},
            {"texel_density_ratio: {max: 2}", scene_of(uneven), scene_of(uv_cube()), false},
            {"uv_gap: {min: 0.1}", scene_of(two_charts(0.0625)), scene_of(two_charts(0.125)), false},
            {"finite_attributes: true", scene_of(with_value("NORMAL", 7, 1, NAN)), scene_of(uv_cube())},
            {"unit_normals: true", scene_of(with_value("NORMAL", 7, 1, 5)), scene_of(uv_cube())},
            {"weights_normalized: true", scene_of(with_weights(0.5)), scene_of(with_weights(0.25))},
            {"lines: {max: 2}", scene_of(path(3)), scene_of(path(2)), false},
            {"joint_count: {max: 64}", scene_of(with_joints(70)), scene_of(with_joints(63))}};
}

std::vector<Row> rows() {
    auto all = counts();
    for (const auto& more : {topology(), shapes_and_attributes()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

const report::Check& only_check(const test::StageRun& run) { return run.state->record.checks.at(0); }

bool is_word(const std::string& property) { return property == "unit" || property == "up"; }

} // namespace

TEST_CASE("the table has a row for every property", "[stages]") {
    std::set<std::string> told;
    for (const Row& row : rows()) told.insert(row.property());
    for (const auto& property : property_table()) {
        CAPTURE(property.name);
        CHECK(told.contains(std::string(property.name)));
    }
}

TEST_CASE("every assertion fails where it should, with evidence, and holds where it should", "[stages]") {
    for (const Row& row : rows()) {
        CAPTURE(row.assertion);
        CHECK(only_check(run_stage("validate", "{" + row.assertion + "}", row.holds)).passed);
        const auto run = run_stage("validate", "{" + row.assertion + "}", row.fails);
        REQUIRE(run.state->record.checks.size() == 1);
        const report::Check& check = only_check(run);
        CHECK_FALSE(check.passed);
        CHECK(check.name == row.property());
        CHECK(check.severity == Severity::error);
        const Json evidence = report::evidence_json(check.evidence);
        CHECK((evidence.empty() == is_word(check.name)));
        for (const Json& entry : evidence) {
            CHECK((entry.contains("part") || entry.contains("material")));
            if (entry.contains("at"))
                for (const Json& x : entry["at"]) CHECK(std::isfinite(x.get<double>()));
            if (entry.contains("face")) CHECK(entry["face"] < row.fails.parts.at(0).mesh.face_count());
        }
        if (row.faces) CHECK(evidence.at(0).contains("face"));
    }
}

TEST_CASE("every assertion is a warning when asked", "[stages]") {
    for (const Row& row : rows()) {
        const auto run = run_stage("validate", "{" + row.assertion + ", severity: warn}", row.fails);
        CHECK_FALSE(only_check(run).passed);
        CHECK(only_check(run).severity == Severity::warning);
    }
}

TEST_CASE("every assertion with faces as evidence marks them in a copy", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto file = folder.path() / "failed.ply";
    for (const Row& row : rows()) {
        if (!row.faces) continue;
        CAPTURE(row.assertion);
        run_stage("validate", "{" + row.assertion + ", mark: '" + file.string() + "'}", row.fails);
        io::ReadLog log;
        const Scene copy = io::read_scene(io::Input::open(file), {}, log);
        const Attribute* failed = copy.parts.at(0).mesh.find("failed", Domain::face);
        REQUIRE(failed);
        double sum = 0;
        for (std::size_t f = 0; f < failed->size(); ++f) sum += failed->value(f, 0);
        CHECK(sum > 0);
    }
}

TEST_CASE("every assertion about parts names the one that fails", "[stages]") {
    for (const Row& row : rows()) {
        if (property_named(row.property())->of_scene()) continue;
        CAPTURE(row.assertion);
        Scene scene = row.holds;
        scene.parts.at(0).name = "good";
        scene.parts.push_back(row.fails.parts.at(0));
        scene.parts.back().name = "bad";
        const auto run = run_stage("validate", "{" + row.assertion + ", per: part}", scene);
        REQUIRE(run.state->record.checks.size() == 2);
        for (const report::Check& check : run.state->record.checks) {
            CHECK(check.passed == (check.part == "good"));
            if (!check.passed) CHECK(check.evidence.value().at(0).name == "bad");
        }
    }
}

TEST_CASE("bounds that make no sense are refused, each with its reason", "[stages]") {
    for (const auto& [assertion, reason] : std::vector<std::pair<std::string, std::string>>{
             {"faces: {max: -1}", "no mesh can have a 'faces' of at most -1"},
             {"faces: 2.5", "'faces' is a count: a whole number"},
             {"euler: 1.5", "'euler' is a count: a whole number"},
             {"faces: 50%", "expected a number, found '50%'"},
             {"faces: 5deg", "expected a number, found '5deg'"},
             {"faces: 5mm", "expected a number, found '5mm'"},
             {"faces: true", "'faces' is a number (2) or a range"},
             {"faces: {max: true}", "expected a number, found"},
             {"faces: {min: 5, max: 2}", "no number is at least 5 and at most 2"},
             {"faces: {}", "min or max"},
             {"faces: {least: 5}", "a bound has no key 'least'"},
             {"faces: [1, 2]", "'faces' is a number (2) or a range"},
             {"faces: .inf", "expected a number"},
             {"closed: 1", "'closed' is true or false"},
             {"min_angle: {min: 200deg}", "no mesh can have a 'min_angle' of at least 200"},
             {"min_angle: {min: 5mm}", "expected an angle"},
             {"aspect_ratio: {max: 0.5}", "no mesh can have a 'aspect_ratio' of at most 0.5"},
             {"longest_edge: {max: -2}", "no mesh can have a 'longest_edge' of at most -2"},
             {"longest_edge: -2mm", "no mesh can have a 'longest_edge' of at most -2mm"},
             {"joint_count: {max: 2.5}", "'joint_count' is a count: a whole number"},
             {"bounds: 5", "'bounds' is a box"},
             {"unit: parsec", "parsec"}}) {
        CAPTURE(assertion);
        std::string message;
        try {
            run_stage("validate", "{" + assertion + "}", scene_of(shapes::cube()));
        } catch (const Error& error) {
            message = error.diagnostics().front().message;
        }
        CHECK(message.find(reason) != std::string::npos);
    }
    CHECK(only_check(run_stage("validate", "{euler: {max: -1}}", scene_of(shapes::cube()))).found ==
          report::Found(std::int64_t{2}));
    CHECK(only_check(run_stage("validate", "{volume: {max: -1}}", scene_of(shapes::cube()))).found ==
          report::Found(1.0));
}

TEST_CASE("empty scenes, points, and faces without area are judged", "[stages]") {
    Mesh points;
    points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    Mesh collapsed = shapes::cube();
    for (Vec3& p : collapsed.positions) p = {1, 2, 3};
    Mesh wide = shapes::cube();
    for (Vec3& p : wide.positions) p = p * 1e150;
    for (const Mesh& mesh : {Mesh{}, points, collapsed, wide})
        for (const Row& row : rows()) {
            CAPTURE(row.assertion);
            CHECK(run_stage("validate", "{" + row.assertion + "}", scene_of(mesh))
                      .state->record.checks.size() == 1);
        }
    for (const Row& row : rows()) {
        CAPTURE(row.assertion);
        CHECK(run_stage("validate", "{" + row.assertion + "}", Scene{}).state->record.checks.size() == 1);
    }
}

TEST_CASE("every property names the stage that fixes it, and is in the manual and the schemas", "[stages]") {
    const StageInfo* validate = stage_named("validate");
    REQUIRE(validate);
    const Json assertions = assertions_schema(), report = report::schema();
    for (const auto& property : property_table()) {
        CAPTURE(property.name);
        const std::string name(property.name);
        std::string hint(property.hint);
        if (hint.starts_with("use ")) hint.erase(0, 4);
        CHECK((hint.starts_with("no stage") ||
               std::any_of(stages().begin(), stages().end(),
                           [&](const StageInfo& stage) { return hint.starts_with(stage.name); })));
        const Option* option = validate->options->find(name);
        REQUIRE(option);
        CHECK(option->help.starts_with(std::string(property.help)));
        CHECK(assertions["properties"].contains(name));
        CHECK(report["$defs"]["scene"]["properties"].contains(name));
        CHECK((property.kind != PropertyKind::word || property.words));
        CHECK((property.on_request() != (property.member.index() != 0)));
    }
    for (const Row& row : rows()) {
        const auto run = run_stage("validate", "{" + row.assertion + "}", row.fails);
        CHECK(only_check(run).hint == property_named(row.property())->hint);
        CHECK(only_check(run_stage("validate", "{" + row.assertion + "}", row.holds)).hint.empty());
    }
}

TEST_CASE("what a check found has the type of its property's kind", "[stages]") {
    for (const Row& row : rows()) {
        CAPTURE(row.assertion);
        const Json found =
            report::found_json(only_check(run_stage("validate", "{" + row.assertion + "}", row.fails)).found);
        switch (property_named(row.property())->kind) {
        case PropertyKind::truth:
            CHECK(found.is_boolean());
            break;
        case PropertyKind::count:
            CHECK(found.is_number_integer());
            break;
        case PropertyKind::word:
            CHECK(found.is_string());
            break;
        case PropertyKind::box:
            CHECK(found["min"].size() == 3);
            break;
        default:
            CHECK(found.is_number_float());
        }
    }
}
