// Baselines of validate: known failures are waived by their locations only.
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/meshes.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"
#include "stages/validate/check_evidence.hpp"
#include "stages/validate/known_failures.hpp"

#include <fstream>
#include <numeric>

using namespace facetmill;
using namespace facetmill::test;
using namespace facetmill::validate_stage;
using test::failure;
using test::run_stage;
using test::scene_of;

namespace {

class Gate {
  public:
    explicit Gate(std::string assertions) : assertions_(std::move(assertions)) {}

    void learn(Scene scene) {
        auto run = run_stage("validate", options(", update_baseline: true"), std::move(scene));
        run.state->outputs.commit();
    }
    void learn(Mesh mesh) { learn(scene_of(std::move(mesh))); }
    test::StageRun judge(Scene scene) const { return run_stage("validate", options(""), std::move(scene)); }
    test::StageRun judge(Mesh mesh) const { return judge(scene_of(std::move(mesh))); }
    bool passes(Mesh mesh) const { return all_passed(judge(std::move(mesh))); }

    static bool all_passed(const test::StageRun& run) {
        const auto& checks = run.state->record.checks;
        return std::all_of(checks.begin(), checks.end(), [](const auto& c) { return c.passed; });
    }
    std::filesystem::path file() const { return folder_ / "known.json"; }
    void put(const std::string& text) const { std::ofstream(file()) << text; }

  private:
    std::string options(const std::string& more) const {
        return "{" + assertions_ + ", baseline: '" + file().string() + "'" + more + "}";
    }
    test::TemporaryDirectory folder_;
    std::string assertions_;
};

/// The cube without these faces.
Mesh cube_without(std::vector<Index> faces) {
    const Mesh all = shapes::cube();
    Mesh mesh;
    mesh.positions = all.positions;
    for (Index f = 0; f < all.face_count(); ++f)
        if (std::find(faces.begin(), faces.end(), f) == faces.end()) add_face(mesh, all.face_wedges(f));
    return mesh;
}

/// A face of the cube without a common edge with face 3.
Index across() {
    const Mesh cube = shapes::cube();
    for (Index f = 0;; ++f) {
        int shared = 0;
        for (Index i = 0; i < 9; ++i) shared += cube.vertex(3 * f + i / 3) == cube.vertex(9 + i % 3);
        if (shared < 2) return f;
    }
}

std::vector<Index> shuffled(std::size_t count, std::uint64_t seed) {
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return hashed(seed, a) < hashed(seed, b); });
    return order;
}

/// The same triangles with other numbers: of faces, vertices and first corners.
Mesh renumbered(const Mesh& mesh, std::uint64_t seed) {
    const auto faces = shuffled(mesh.face_count(), seed), vertices = shuffled(mesh.vertex_count(), seed + 1);
    Mesh out;
    std::vector<Index> number(vertices.size());
    for (Index v = 0; v < vertices.size(); ++v) {
        out.positions.push_back(mesh.positions[vertices[v]]);
        number[vertices[v]] = v;
    }
    for (const Index f : faces)
        for (Index i = 0; i < 3; ++i)
            out.corners.push_back(
                number[mesh.vertex(3 * f + (i + static_cast<Index>(hashed(seed, f) % 3)) % 3)]);
    for (const Attribute& a : mesh.attributes) {
        out.attributes.push_back(a);
        out.attributes.back().select(vertices);
    }
    return out;
}

/// Something of everything that can be wrong.
Mesh wreck() {
    Mesh mesh = with_noise(shapes::icosphere(2), 0.2, 5);
    for (Vec3& p : mesh.positions)
        for (std::size_t i = 0; i < 3; ++i) p[i] = std::floor(p[i] * 8) / 8;
    for (const Mesh& more : {shapes::fan3(), shapes::hourglass(), shapes::folded_quad(), shapes::crossing(),
                             torn_apart(shapes::octahedron()), cube_without({3})}) {
        Mesh moved = more;
        for (Vec3& p : moved.positions)
            p += Vec3{3.0 + 2.0 * static_cast<double>(mesh.face_count() % 7), 0, 0};
        append(mesh, moved);
    }
    std::swap(mesh.corners[0], mesh.corners[1]); // turned
    for (Index i = 0; i < 3; ++i) mesh.corners.push_back(mesh.corners[30 + i]);
    mesh.positions.push_back({9, 9, 9}); // isolated
    std::vector<float> uvs;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        for (int c = 0; c < 2; ++c) uvs.push_back(float(hashed(v, std::uint64_t(c)) % 20) / 16);
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uvs)});
    std::vector<float> normals(3 * mesh.vertex_count(), 0.5f);
    normals[7] = NAN;
    mesh.attributes.push_back({"NORMAL", Domain::wedge, Role::normal, 3, false, std::move(normals)});
    return mesh;
}

} // namespace

TEST_CASE("a fault that replaces a fixed one is not waived", "[stages]") {
    Gate gate("closed: true, boundary_edges: 0, boundary_loops: 0, longest_boundary: {max: 0}");
    gate.learn(cube_without({3}));
    CHECK(gate.passes(cube_without({3})));
    const auto run = gate.judge(cube_without({across()})); // as many open edges, elsewhere
    for (const auto& check : run.state->record.checks) {
        CHECK_FALSE(check.passed);
        CHECK(check.fresh == 3);
    }
    CHECK(run.record.warnings.empty());
    CHECK(run.record.result["fixed"] == 0);
    CHECK(run.record.result["fixed_locations"] == 4 * 3);
}

TEST_CASE("of a failure that is known in part, the new locations are shown", "[stages]") {
    Gate gate("degenerate_faces: 0");
    Mesh mesh = shapes::cube();
    const auto collapse = [&](Index at) {
        const auto first = static_cast<Index>(mesh.positions.size());
        for (const double x : {0.0, 1.0, 2.0}) mesh.positions.push_back({x, double(at), 9});
        const Index face[] = {first, first + 1, first + 2};
        add_face(mesh, face);
    };
    for (Index i = 0; i < 15; ++i) collapse(i);
    gate.learn(mesh);
    collapse(77);
    const auto run = gate.judge(mesh);
    const auto& check = run.state->record.checks.at(0);
    CHECK_FALSE(check.passed);
    CHECK(check.fresh == 1);
    REQUIRE(check.evidence.value().size() == 1);
    CHECK(check.evidence->at(0).at.value().y == 77);
    CHECK(check.evidence->at(0).face == std::size_t{12 + 15});
    CHECK(run.record.result["waived_locations"] == 15);
}

TEST_CASE("the order and the numbers of faces and vertices do not matter", "[stages]") {
    const Mesh mesh = wreck();
    const Scene scene = scene_of(mesh), other = scene_of(renumbered(mesh, 7));
    std::size_t with_locations = 0;
    for (const auto& property : property_table()) {
        CAPTURE(property.name);
        Assertion assertion{.property = std::string(property.name)};
        assertion.bound.min = 40;
        assertion.bound.max = 41; // most faces exceed it
        const auto keys = location_keys(scene, assertion);
        CHECK(keys == location_keys(other, assertion));
        with_locations += !keys.empty();
    }
    CHECK(with_locations > 25);
    Gate gate("closed: true, edge_manifold: true, self_intersections: 0, touching: 0, components: 1, "
              "min_angle: {min: 5deg}, unit_normals: true");
    gate.learn(scene);
    CHECK(Gate::all_passed(gate.judge(other)));
    Mesh moved = mesh;
    moved.positions[40].x += 1e-12;
    CHECK_FALSE(Gate::all_passed(gate.judge(moved)));
}

TEST_CASE("components are known by their lowest vertex, whatever their number", "[stages]") {
    Gate gate("closed: true, faces: {max: 5}, per: component");
    Mesh mesh = cube_without({3});
    Mesh sheet = shapes::grid(1, 1);
    for (Vec3& p : sheet.positions) p.x += 5;
    append(mesh, sheet);
    gate.learn(mesh);
    Mesh swapped = sheet;
    append(swapped, cube_without({3}));
    CHECK(gate.passes(mesh));
    CHECK(gate.passes(swapped));
    CHECK(gate.passes(renumbered(mesh, 3)));
    for (Vec3& p : sheet.positions) p.x += 1;
    append(mesh, sheet); // a third component
    CHECK_FALSE(gate.passes(mesh));
}

TEST_CASE("what is fixed is told", "[stages]") {
    Gate gate("closed: true, faces: {max: 9}, boundary_edges: 0");
    gate.learn(cube_without({3, across()}));
    const auto half = gate.judge(cube_without({across()}));
    CHECK_FALSE(Gate::all_passed(half)); // more failing faces than before
    Gate open("closed: true, boundary_edges: 0, isolated_vertices: 0");
    Mesh mesh = cube_without({3, across()});
    mesh.positions.push_back({7, 7, 7});
    open.learn(mesh);
    const auto run = open.judge(cube_without({across()}));
    CHECK(Gate::all_passed(run));
    CHECK(run.record.result["waived"] == 2);
    CHECK(run.record.result["waived_locations"] == 6);
    CHECK(run.record.result["fixed"] == 1);
    CHECK(run.record.result["fixed_locations"] == 6);
    CHECK(run.record.said ==
          std::vector<std::string>{"2 known failures waived, 1 fixed; 6 known locations waived, 6 fixed: use "
                                   "update_baseline to remove them from the baseline"});
    const auto sound = open.judge(shapes::cube());
    CHECK(Gate::all_passed(sound));
    CHECK(sound.record.result["fixed"] == 3);
    open.learn(cube_without({across()}));
    CHECK(open.passes(cube_without({across()})));
    CHECK_FALSE(open.passes(cube_without({3, across()})));
}

TEST_CASE("what has no locations is known by its value", "[stages]") {
    Gate gate("faces: {max: 5}, area: {max: 1}");
    gate.learn(shapes::cube());
    CHECK(gate.passes(shapes::cube()));
    CHECK(gate.passes(cube_without({1, 2})));
    CHECK_FALSE(gate.passes(shapes::icosphere(1)));
}

TEST_CASE("names that no pattern matches are known one by one", "[stages]") {
    Gate gate("limits: {names: [body]}");
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[0].name = "a";
    scene.parts[1].name = "b";
    gate.learn(scene);
    scene.parts.pop_back();
    CHECK(Gate::all_passed(gate.judge(scene)));
    scene.parts[0].name = "c";
    CHECK_FALSE(Gate::all_passed(gate.judge(scene)));
}

TEST_CASE("a node that moves leaves its locations known, another part's are new", "[stages]") {
    Gate gate("closed: true");
    Scene scene = scene_of(cube_without({3}));
    gate.learn(scene);
    scene.parts[0].transform.m[0][3] = 12;
    CHECK(Gate::all_passed(gate.judge(scene)));
    scene.parts[0].name = "other";
    CHECK_FALSE(Gate::all_passed(gate.judge(scene)));
}

TEST_CASE("the baseline of another mesh is told as such", "[stages]") {
    Gate gate("closed: true, for: web");
    gate.learn(cube_without({3}));
    const auto run = gate.judge(Mesh{});
    CHECK(run.warnings() == std::vector<std::string>{"W-BASELINE"});
    CHECK(run.record.warnings.at(0).message ==
          "none of the failures in '" + gate.file().string() + "' occurs here, but others do");
    CHECK(gate.judge(cube_without({3})).warnings().empty());
    CHECK(gate.judge(shapes::cube()).warnings().empty());
}

TEST_CASE("what is no baseline is refused", "[stages]") {
    Gate gate("closed: true");
    const auto reason = [&] { return failure([&] { gate.judge(shapes::grid(1, 1)); }); };
    const std::string no = "malformed [E-BASELINE] '" + gate.file().string() + "' ";
    const std::string hint = " | write one with update_baseline: true";
    CHECK(reason().starts_with("missing"));
    const std::string entry = R"("check":"closed","part":"","component":"","expected":"true","found":false)";
    for (const std::string& text :
         {std::string(""), std::string("[1]"), std::string("{\"failures\":{}}"), std::string("{\"failures"),
          std::string(R"({"facetmill_baseline":"1","failures":[]})"),
          std::string(R"({"facetmill_baseline":1,"failures":[7]})"),
          R"({"facetmill_baseline":1,"failures":[{)" + entry + R"(}]})",
          R"({"facetmill_baseline":1,"failures":[{)" + entry + R"(,"locations":1,"known":["zz"]}]})",
          R"({"facetmill_baseline":1,"failures":[{)" + entry +
              R"(,"locations":0,"known":["0123456789abcdef"]}]})",
          R"({"facetmill_baseline":1,"failures":[{)" + entry +
              R"(,"locations":9,"known":["0123456789abcdef"]}]})",
          R"({"facetmill_baseline":1,"failures":[{)" + entry +
              R"(,"locations":1,"known":["0123456789abcdef x99999999999"]}]})",
          R"({"facetmill_baseline":1,"failures":[{)" + entry +
              R"(,"locations":-1,"known":["0123456789abcdef"]}]})",
          std::string(R"({"facetmill_baseline":1,"failures":[{"check":"closed","part":"","component":"",)") +
              R"("expected":"true","found":{"min":[0,0]},"locations":0,"known":[]}]})"}) {
        CAPTURE(text);
        gate.put(text);
        CHECK(reason() == no + "is not a baseline of validate" + hint);
    }
    gate.put(R"({"failures":[{"check":"closed","part":"","expected":"true","found":false,"locations":8}]})");
    CHECK(reason() == no + "is not a baseline of validate" + hint);
    gate.put(R"({"facetmill_baseline":2,"failures":[]})");
    CHECK(reason() == no + "is a baseline of a version that this facetmill cannot read" + hint);
}

TEST_CASE("a baseline of very many locations is bounded, and still tells new ones", "[stages]") {
    const test::TemporaryDirectory folder;
    std::vector<std::uint64_t> keys;
    for (std::uint64_t i = 0; i < 200000; ++i) keys.push_back(hashed(1, i));
    std::sort(keys.begin(), keys.end());
    const auto failing = [](std::vector<std::uint64_t> keys) {
        std::sort(keys.begin(), keys.end());
        return Failure{.check = "closed", .part = "", .expected = "true", .found = false, .keys = keys};
    };
    KnownFailures written;
    written.add(failing(keys));
    io::Outputs outputs;
    written.write(outputs, folder / "known.json");
    outputs.commit();
    CHECK(std::filesystem::file_size(folder / "known.json") < 1300000);
    const KnownFailures known = KnownFailures::read(folder / "known.json");
    CHECK(known.judge(failing(keys)).waived);
    const auto with = [&](std::size_t at, std::uint64_t key) {
        auto other = keys;
        other[at] = key;
        return failing(other);
    };
    CHECK(known.judge(with(100, hashed(2, 0))).fresh == 1);         // one of the sample replaced
    CHECK(known.judge(with(199999, ~std::uint64_t{0})).fresh == 1); // one beyond it, by one beyond it
    CHECK_FALSE(known.judge(with(199999, 5)).waived);               // and by one that is in its range
    CHECK_FALSE(known.judge(with(100, ~std::uint64_t{0})).waived);
    auto fewer = keys;
    fewer.erase(fewer.begin() + 100);
    fewer.pop_back();
    CHECK(known.judge(failing(fewer)).waived);
    auto more = keys;
    more.push_back(hashed(3, 1));
    CHECK_FALSE(known.judge(failing(more)).waived);
    CHECK(known.gone(KnownFailures{}).failures == 1);
}

TEST_CASE("equal locations are counted, however many they are", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto failing = [](std::size_t copies) {
        return Failure{.check = "duplicate_faces",
                       .part = "",
                       .expected = "0",
                       .found = static_cast<std::int64_t>(copies),
                       .min = 0,
                       .max = 0,
                       .keys = std::vector<std::uint64_t>(copies, 12345)};
    };
    KnownFailures written;
    written.add(failing(200000));
    io::Outputs outputs;
    written.write(outputs, folder / "known.json");
    outputs.commit();
    CHECK(std::filesystem::file_size(folder / "known.json") < 300);
    const KnownFailures known = KnownFailures::read(folder / "known.json");
    CHECK(known.judge(failing(200000)).waived);
    CHECK(known.judge(failing(3)).waived);
    CHECK(known.judge(failing(200001)).fresh == 1);
}
