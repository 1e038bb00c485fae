#include "geometry/inspect/inspect.hpp"
#include "report/check_text.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include "io/codec.hpp"
#include "io/images/encode_image.hpp"
#include "mesh/shapes.hpp"
#include "report/contents.hpp"
#include "stages/validate/scene_limits.hpp"
#include "support/bench.hpp"

using namespace facetmill;
using test::Bench;
using test::failure;
using test::options;
using test::run_stage;
using test::scene_of;

namespace {

/// "closed: true, found false" of the checks that failed, one per line.
std::string failures(const test::StageRun& run) {
    std::string text;
    for (const auto& c : run.state->record.checks)
        if (!c.passed)
            text += (text.empty() ? "" : "\n") + (c.part.empty() ? "" : c.part + " ") + c.name + ": " +
                    c.expected + ", found " + report::found_text(c);
    return text;
}

std::string judged(const std::string& options, Scene scene) {
    return failures(run_stage("validate", options, std::move(scene)));
}
std::string judged(const std::string& options, Mesh mesh) {
    return judged(options, scene_of(std::move(mesh)));
}

/// A block of 3 x 3 x 1 cells with a hole through each of the given number of cells: closed, of that genus.
Mesh block_with_holes(int holes) {
    Mesh mesh;
    const int columns = 2 * holes + 1;
    const auto vertex = [&](int x, int y, int z) {
        return static_cast<Index>((z * 4 + y) * (columns + 1) + x);
    };
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x <= columns; ++x) mesh.positions.push_back({double(x), double(y), double(z)});
    const auto solid = [&](int x, int y) {
        return x >= 0 && x < columns && y >= 0 && y < 3 && !(y == 1 && x % 2 == 1);
    };
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < columns; ++x) {
            if (!solid(x, y)) continue;
            const Index a = vertex(x, y, 0), b = vertex(x + 1, y, 0), c = vertex(x + 1, y + 1, 0),
                        d = vertex(x, y + 1, 0);
            const Index up = vertex(0, 0, 1);
            add_face(mesh, std::vector<Index>{d, c, b, a});
            add_face(mesh, std::vector<Index>{a + up, b + up, c + up, d + up});
            if (!solid(x, y - 1)) add_face(mesh, std::vector<Index>{a, b, b + up, a + up});
            if (!solid(x + 1, y)) add_face(mesh, std::vector<Index>{b, c, c + up, b + up});
            if (!solid(x, y + 1)) add_face(mesh, std::vector<Index>{c, d, d + up, c + up});
            if (!solid(x - 1, y)) add_face(mesh, std::vector<Index>{d, a, a + up, d + up});
        }
    return mesh;
}

Mesh flipped(Mesh mesh) {
    for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
        std::swap(mesh.corners[c + 1], mesh.corners[c + 2]);
    return mesh;
}

} // namespace

TEST_CASE("a bare validate passes a sound solid and lists all that an open one lacks", "[stages]") {
    CHECK(judged("", shapes::cube()) == "");
    CHECK(judged("{closed: true, edge_manifold: true}", shapes::fan3()) ==
          "closed: true, found false\nedge_manifold: true, found false");
    CHECK(judged("", Mesh{}) == "faces: at least 1, found 0");
}

TEST_CASE("closed means Euler number 2 only for genus 0 with one component", "[stages]") {
    CHECK(judged("{closed: true, euler: 2, genus: 0}", shapes::icosphere(2)) == "");
    CHECK(judged("{closed: true, euler: 0, genus: 1}", shapes::torus(9, 7)) == "");
    CHECK(judged("{closed: true, euler: 0, genus: 1}", block_with_holes(1)) == "");
    CHECK(judged("{closed: true, euler: -44, genus: 23}", block_with_holes(23)) == "");
    Mesh three = shapes::cube(); // the pieces add up
    append(three, shapes::icosphere(1));
    append(three, shapes::torus(9, 7));
    CHECK(judged("{closed: true, euler: 4, genus: 1, components: 3}", three) == "");
    CHECK(judged("{closed: true, euler: 2}", three) == "euler: 2, found 4");
    // Open surfaces can have it too: a sphere with a missing face and an isolated patch next to it.
    Mesh open = shapes::icosphere(1);
    open.corners.resize(open.corners.size() - 3);
    append(open, shapes::grid(1, 1));
    CHECK(judged("{closed: true, euler: 2}", open) == "closed: true, found false");
}

TEST_CASE("validate names the locations that speak against a property", "[stages]") {
    Mesh mesh = shapes::cube();
    mesh.corners.resize(33);
    const auto run = run_stage("validate", "{closed: true}", scene_of(mesh));
    const Json evidence = report::evidence_json(run.state->record.checks.at(0).evidence);
    REQUIRE(evidence.size() == 1); // one hole
    CHECK(evidence[0]["part"] == "part");
    CHECK(evidence[0]["at"].size() == 3);
    CHECK(evidence[0]["edges"] == 3);
    CHECK(evidence[0]["length"] == Approx(2 + std::sqrt(2.0)));
    Mesh third = shapes::cube(); // an edge with three faces; the only open edges are the third face's
    const Index fin[] = {0, 1, 6};
    add_face(third, fin);
    const auto crowded = run_stage("validate", "{edge_manifold: true}", scene_of(third));
    CHECK(crowded.state->record.checks.at(0).evidence.value().at(0).face);
}

TEST_CASE("validate tells every open loop: which, how long and where, in the world", "[stages]") {
    Mesh mesh = shapes::grid(2, 1);
    append(mesh, shapes::grid(3, 3));
    Scene scene = scene_of(mesh);
    scene.parts[0].transform.m[0][0] = scene.parts[0].transform.m[1][1] = scene.parts[0].transform.m[2][2] =
        10;
    const auto run = run_stage("validate", "{boundary_loops: 0, longest_boundary: {max: 100}}", scene);
    for (const auto& check : run.state->record.checks) {
        const Json evidence = report::evidence_json(check.evidence);
        REQUIRE(evidence.size() == 2);
        CHECK(evidence[0]["loop"] == 0);
        CHECK(evidence[0]["edges"] == 6);
        CHECK(evidence[0]["length"] == Approx(60));
        CHECK(evidence[1]["loop"] == 1);
        CHECK(evidence[1]["length"] == Approx(120));
        CHECK(evidence[1]["at"].size() == 3);
    }
}

TEST_CASE("validate takes lengths with units, and says what they are in the scene", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.unit = Unit::cm;
    CHECK(judged("{bounds: {max: [10mm, 1cm, 0.01m]}, max_extent: {max: 10mm}}", scene) == "");
    CHECK(judged("{max_extent: {max: 9mm}}", scene) == "max_extent: at most 9mm (0.9), found 1");
    CHECK(judged("{unit: cm, parts: 1, materials: 0}", scene) == "");
    CHECK(judged("{unit: mm}", scene) == "unit: mm, found cm");
    CHECK(judged("{parts: 2, per: part}", scene) == "part parts: 2, found 1");
}

TEST_CASE("a cavity looks outward as a component when it looks into the hollow", "[stages]") {
    Mesh hollow = shapes::cube(), inner = shapes::cube();
    for (Vec3& p : inner.positions) p = p * 0.5 + Vec3{0.25, 0.25, 0.25};
    for (std::size_t c = 0; c < inner.corners.size(); c += 3)
        std::swap(inner.corners[c], inner.corners[c + 1]);
    append(hollow, inner);
    CHECK(judged("{outward_oriented: true, euler: 2, per: component}", hollow) == "");
    Mesh alone = shapes::cube();
    append(alone, inner);
    for (std::size_t v = 8; v < 16; ++v) alone.positions[v].x += 5; // inside out, in no solid
    CHECK(judged("{outward_oriented: true, per: component}", alone) ==
          "part.1 outward_oriented: true, found false");
}

TEST_CASE("validate judges each part or component when asked", "[stages]") {
    Mesh mesh = shapes::cube();
    append(mesh, shapes::grid(1, 1));
    CHECK(judged("{euler: 2, per: component}", mesh) == "part.1 euler: 2, found 1");
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "open";
    scene.parts[1].mesh = shapes::grid(1, 1);
    CHECK(failures(run_stage("validate", "{closed: true, per: part}", scene)) ==
          "open closed: true, found false");
}

TEST_CASE("validate measures angles, edges and ratios", "[stages]") {
    CHECK(judged("{min_angle: {min: 44.9deg}, max_angle: {max: 90.1}}", shapes::cube()) == "");
    CHECK(judged("{min_angle: {min: 50deg}}", shapes::cube()).substr(0, 31) ==
          "min_angle: at least 50, found 4");
    CHECK(judged("{aspect_ratio: {min: 0.999, max: 1.001}}", shapes::octahedron()) == "");
    CHECK(judged("{shortest_edge: {min: 0.999}, longest_edge: {max: 1.42}, max_extent: {max: 1}}",
                 shapes::cube()) == "");
    CHECK(judged("{nonplanarity: {max: 1e-12}}", shapes::quad_cube()) == "");
    CHECK(judged("{boundary_length: 8, longest_boundary: 8}", shapes::grid(2, 2)) == "");
}

TEST_CASE("validate finds folds, T-vertices, overlaps and the wrong side out", "[stages]") {
    CHECK(judged("{folded_faces: 0, coplanar_overlaps: 0, t_junctions: 0, outward_oriented: true}",
                 shapes::cube()) == "");
    CHECK(judged("{folded_faces: 0}", shapes::folded_quad()) == "folded_faces: 0, found 1");
    CHECK(judged("{coplanar_overlaps: 0}", shapes::folded_quad()) == "coplanar_overlaps: 0, found 1");
    CHECK(judged("{coplanar_overlaps: 0}", shapes::crossing()) == "");
    CHECK(judged("{outward_oriented: true}", flipped(shapes::cube())) ==
          "outward_oriented: true, found false");
    CHECK(judged("{outward_oriented: true}", shapes::moebius(9)) == "outward_oriented: true, found false");
    Mesh crack;
    crack.positions = {{0, 0, 0}, {2, 0, 0}, {0, -2, 0}, {0, 2, 0}, {1, 0, 0}};
    crack.corners = {0, 2, 1, 0, 4, 3, 4, 1, 3};
    CHECK(judged("{t_junctions: 0}", crack) == "t_junctions: 0, found 1");
}

TEST_CASE("validate measures the wall of a solid", "[stages]") {
    CHECK(judged("{wall_thickness: {min: 0.999999, max: 1.000001}}", shapes::cube()) == "");
    Mesh plate = shapes::cube();
    for (Vec3& p : plate.positions) p.z *= 0.125;
    CHECK(judged("{wall_thickness: {min: 0.2}}", plate) == "wall_thickness: at least 0.2, found 0.125");
    CHECK(judged("{wall_thickness: {min: 0}}", shapes::grid(1, 1)) ==
          "wall_thickness: at least 0, found not applicable");
}

TEST_CASE("validate judges attributes", "[stages]") {
    Mesh mesh = shapes::uv_cube();
    CHECK(judged("{uvs_in_range: true, finite_attributes: true, unit_normals: true}", mesh) == "");
    CHECK(judged("{uv_overlaps: 0}", mesh) != ""); // every side of the cube uses the whole texture
    mesh.find("TEXCOORD_0", Domain::wedge)->set_value(0, 0, 1.5);
    mesh.find("NORMAL", Domain::wedge)->set_value(3, 1, 5);
    CHECK(judged("{uvs_in_range: true, unit_normals: true}", mesh) ==
          "uvs_in_range: true, found false\nunit_normals: true, found false");
    mesh.find("NORMAL", Domain::wedge)->set_value(3, 1, NAN);
    CHECK(judged("{finite_attributes: true}", mesh) == "finite_attributes: true, found false");
    mesh.attributes.push_back({"WEIGHTS_0", Domain::wedge, Role::weights, 4, false,
                               std::vector<float>(4 * mesh.wedge_count(), 0.25f)});
    CHECK(judged("{weights_normalized: true}", mesh) == "");
    mesh.attributes.back().set_value(2, 0, 0.5);
    CHECK(judged("{weights_normalized: true}", mesh) == "weights_normalized: true, found false");
}

TEST_CASE("validate knows what a purpose needs", "[stages]") {
    CHECK(judged("{for: printing}", shapes::icosphere(2)) == "");
    CHECK(judged("{for: simulation}", shapes::icosphere(2)) == "");
    CHECK(judged("{for: web}", shapes::grid(2, 2)) ==
          ""); // open, without normals and weights, which the profile does not require
    CHECK(judged("{for: solid}", flipped(shapes::cube())) == "outward_oriented: true, found false");
    CHECK(judged("{for: solid, outward_oriented: false}", flipped(shapes::cube())) ==
          ""); // given assertions override the profile
}

TEST_CASE("validate limits what a scene holds", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.materials.resize(3);
    CHECK(failures(run_stage("validate", "{limits: {parts: 1, materials: {max: 2}, names: [p*, q]}}",
                             scene)) == "materials: at most 2, found 3");
    CHECK(failures(run_stage("validate", "{limits: {materials: 5}}", scene)) == ""); // the most
    CHECK(failures(run_stage("validate", "{limits: {materials: {min: 4}}}", scene)) ==
          "materials: at least 4, found 3");
    CHECK(failures(run_stage("validate", "{limits: {names: [body]}}", scene)) == "names: body, found part");
}

namespace {

/// A black image.
io::Pixels black(std::size_t width, std::size_t height) {
    return {width, height, std::vector<std::uint8_t>(4 * width * height), false};
}

/// A PNG inside a buffer of 1000 bytes and a WebP next to the document.
Scene with_document() {
    Scene scene = scene_of(shapes::cube());
    auto document = std::make_shared<Document>();
    document->name = "body.glb";
    const io::Bytes png = io::encoded_png(black(100, 50));
    document->json = fmt::format(
        R"({{"extensionsUsed":["KHR_a","VENDOR_b"],"images":[{{"uri":"wood.webp"}},)"
        R"({{"name":"steel","bufferView":0}}],"bufferViews":[{{"buffer":0,"byteLength":{:4}}}]}})",
        png.size());
    document->buffers = {png};
    document->buffers[0].resize(1000);
    document->files["wood.webp"] = io::encoded_webp(black(20, 10), {});
    scene.documents.push_back(document);
    return scene;
}

Json limit_evidence(const std::string& limit) {
    const auto run = run_stage("validate", "{limits: {" + limit + "}}", with_document());
    const auto& check = run.state->record.checks.at(0);
    return check.passed ? Json("passed") : report::evidence_json(check.evidence);
}

template <class Limit>
Limit at_most(double most) {
    Limit limit;
    limit.max = most;
    return limit;
}

/// The evidence of a limit on a file of 100 bytes and its buffer of 200 bytes.
Json file_evidence(const validate_stage::SceneLimits& limits) {
    using namespace validate_stage;
    const std::vector<report::FileRecord> files{{"a.gltf", 100, "", {}}, {"a.bin", 200, "", {}}};
    const Scene scene = with_document();
    const auto checks = check_limits(limits, LimitsOf::file, {scene, files});
    return checks.at(0).check.passed ? Json("passed") : report::evidence_json(checks[0].check.evidence);
}

/// "bytes of a.stl 684 passed", one per line.
std::string checks_of(const Bench& b) {
    std::string all;
    for (const auto& check : b.state.record.checks)
        all += fmt::format("{}{} of {} {} {}", all.empty() ? "" : "\n", check.name, check.file,
                           report::found_text(check), report::outcome(check));
    return all;
}

Value limits(const char* name, const char* most) {
    return Value::map({{"limits", {}, options({{name, most}})}});
}

} // namespace

TEST_CASE("validate limits the bytes of files as they are written", "[stages]") {
    Bench b;
    b.scene = scene_of(shapes::cube());
    b.run("write", Value::scalar("a.stl")); // 84 bytes and 50 for each of 12 triangles
    b.run("validate", limits("bytes", "684"));
    CHECK(checks_of(b) == "bytes of a.stl 684 passed");
    b.state.number_scene(false); // the limit is of every file before, whatever happens to the scene
    b.run("write", options({{"path", "b.ply"}, {"ascii", "true"}}));
    const auto bytes = b.state.record.outputs.at(1).bytes;
    b.state.record.checks.clear();
    b.run("validate", limits("bytes", "600"));
    CHECK(checks_of(b) == fmt::format("bytes of a.stl 684 failed\nbytes of b.ply {} passed", bytes));
    b.state.record.checks.clear();
    b.run("validate", limits("draw_calls", "1"));
    CHECK(checks_of(b) == "draw_calls of a.stl 1 passed\ndraw_calls of b.ply 1 passed");
    CHECK(failure([] {
              run_stage("validate", "{limits: {bytes: 1kB}}", scene_of(shapes::cube()));
          }).find("'limits.bytes' limits written files, and no file was written before it") !=
          std::string::npos);
}

TEST_CASE("validate after write judges the file, in the unit of the scene", "[stages]") {
    Bench b;
    b.scene = scene_of(shapes::cube(), Unit::mm);
    b.scene.up = UpAxis::z;
    b.scene.parts[0].mesh.positions[0].x = 1 - 1e-9; // float32 makes faces degenerate
    b.run("validate", options({{"degenerate_faces", "0"}, {"max_extent", "1mm"}}));
    CHECK(checks_of(b).find("failed") == std::string::npos);
    b.state.record.checks.clear();
    b.run("write", Value::scalar("a.glb")); // in metres, y up
    b.run("validate", options({{"degenerate_faces", "0"}, {"max_extent", "1mm"}}));
    CHECK(checks_of(b).find("degenerate_faces of a.glb 2 failed") != std::string::npos);
    CHECK(checks_of(b).find("max_extent of a.glb 1 passed") != std::string::npos);
    b.state.record.checks.clear();
    b.state.number_scene(false); // as a stage that changes the scene
    b.run("validate", options({{"degenerate_faces", "0"}}));
    CHECK(checks_of(b) == "degenerate_faces of  0 passed");
    CHECK(b.record.said.back() == "checked the scene in memory, not a.glb");
}

TEST_CASE("validate says what counts towards a limit that fails, the most first", "[stages]") {
    CHECK(file_evidence({.texture_pixels = at_most<CountLimit>(5000)}).dump() ==
          R"([{"image":"steel","width":100,"height":50,"amount":5000},)"
          R"({"image":"wood.webp","width":20,"height":10,"amount":200}])");
    CHECK(file_evidence({.texture_pixels = at_most<CountLimit>(5200)}) == "passed");
    CHECK(file_evidence({.draw_calls = at_most<CountLimit>(0)}).dump() == R"([{"part":"part","amount":1}])");
    CHECK(file_evidence({.bytes = at_most<ByteLimit>(299)}).dump() ==
          R"([{"bytes_of":"a.bin","amount":200},{"bytes_of":"a.gltf","amount":100}])");
    CHECK(file_evidence({.bytes = at_most<ByteLimit>(300)}) == "passed");
    CHECK(limit_evidence("extensions: [KHR_*]").dump() ==
          R"([{"extension":"VENDOR_b","document":"body.glb"}])");
    CHECK(limit_evidence("extensions: ['*']") == "passed");
    CHECK(limit_evidence("names: [body]").dump() == R"([{"part":"part"}])");
    CHECK(limit_evidence("parts: 0").dump() == R"([{"part":"part"}])");
    CHECK(limit_evidence("texture_sides: {max: 64}").dump() ==
          R"([{"image":"steel","width":100,"height":50}])");
    CHECK(limit_evidence("texture_sides: {max: 100}") == "passed");
    CHECK(limit_evidence("odd_textures: 1").size() == 2);
}

TEST_CASE("validate says which parts have most of what is too much", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "ball";
    scene.parts[1].mesh = shapes::icosphere(1);
    const auto run =
        run_stage("validate", "{faces: {max: 50}, vertices: {max: 60}, joint_count: {max: 3}}", scene);
    CHECK(report::evidence_json(run.state->record.checks.at(0).evidence).dump() ==
          R"([{"part":"ball","amount":80},{"part":"part","amount":12}])");
    CHECK(run.state->record.checks.at(1).passed);
    CHECK(run.state->record.checks.at(2).found == report::Found());
}

TEST_CASE("an edge of four faces that clean separated is fit for printing", "[stages]") {
    Mesh mesh = shapes::cube();
    Mesh other = shapes::cube();
    for (Vec3& p : other.positions) p += Vec3{1, 1, 0};
    append(mesh, other);
    const auto welded = run_stage("clean", "{non_manifold: false}", scene_of(mesh));
    CHECK(judged("{for: printing}", welded.scene) == "edge_manifold: true, found false");
    const auto clean = run_stage("clean", "{non_manifold: true}", welded.scene);
    CHECK(judged("{for: printing}", clean.scene) == "");
    CHECK(judged("{for: simulation, min_angle: {min: 1deg}}", clean.scene) == "");
    CHECK(judged("{touching: 0}", clean.scene) != "");
}

TEST_CASE("update_baseline needs a file", "[stages]") {
    CHECK(failure([] { run_stage("validate", "{update_baseline: true}", scene_of({})); }) ==
          "usage [E-MISSING] test.yaml:1:1: validate: update_baseline needs a baseline file to write | add "
          "baseline: known.json");
}

TEST_CASE("validate shows only the faces beyond the bound, and how many they are", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto file = folder.path() / "failed.ply";
    Mesh mesh = shapes::grid(4, 4);
    mesh.positions[12].x += 0.95; // thin faces around the middle
    const auto run =
        run_stage("validate", "{min_angle: {min: 20deg}, mark: '" + file.string() + "'}", scene_of(mesh));
    const auto& check = run.state->record.checks.at(0);
    std::size_t thin = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        Mesh one;
        one.positions = mesh.positions;
        add_face(one, mesh.face_wedges(f));
        thin += measure(one, *property_named("min_angle")).value() < 20;
    }
    REQUIRE((thin > 0 && thin < 10));
    CHECK(check.locations == thin);
    CHECK(check.evidence.value().size() == thin);
    io::ReadLog log;
    const Scene copy = io::read_scene(io::Input::open(file), {}, log);
    const Attribute* failed = copy.parts.at(0).mesh.find("failed", Domain::face);
    REQUIRE(failed);
    double sum = 0;
    for (std::size_t f = 0; f < failed->size(); ++f) sum += failed->value(f, 0);
    CHECK(sum == static_cast<double>(thin));
}

TEST_CASE("validate numbers faces as the part has them, also by component", "[stages]") {
    Mesh mesh = shapes::cube();
    append(mesh, shapes::grid(1, 1));
    for (Vec3& p : mesh.positions) p.z += p.x; // the sheet is the second component
    const auto run = run_stage("validate", "{closed: true, per: component}", scene_of(mesh));
    const auto& check = run.state->record.checks.at(1);
    CHECK(check.part == "part.1");
    CHECK(check.evidence->at(0).name == "part");
    CHECK(check.evidence->at(0).face.value() >= 12);
    CHECK(check.locations == 4);
}

TEST_CASE("validate shows where Euler's number and the components come from", "[stages]") {
    Mesh mesh = shapes::hourglass();
    append(mesh, shapes::tetrahedron());
    const auto run = run_stage("validate", "{euler: 2, components: 1}", scene_of(mesh));
    CHECK(run.state->record.checks.at(0).evidence.value().size() == 1); // the vertex of two fans
    CHECK(run.state->record.checks.at(1).evidence.value().size() == 2); // a face of each piece
}

TEST_CASE("validate writes a copy that shows where it failed", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto file = folder.path() / "failed.ply";
    Mesh mesh = shapes::cube();
    mesh.corners.resize(33);
    run_stage("validate", "{closed: true, mark: '" + file.string() + "'}", scene_of(mesh));
    io::ReadLog log;
    const Scene copy = io::read_scene(io::Input::open(file), {}, log);
    const Attribute* failed = copy.parts.at(0).mesh.find("failed", Domain::face);
    REQUIRE(failed);
    double sum = 0;
    for (std::size_t f = 0; f < 11; ++f) sum += failed->value(f, 0);
    CHECK(sum == 3);
    CHECK(failure([] { run_stage("validate", "{mark: a.xyz}", scene_of({})); }) ==
          "usage [E-FORMAT] test.yaml:1:8: validate: no format writes 'a.xyz' | facetmill formats lists "
          "them; .glb shows "
          "the colours");
}

TEST_CASE("validate warns instead, when asked", "[stages]") {
    const auto run = run_stage("validate", "{closed: true, severity: warn}", scene_of(shapes::grid(1, 1)));
    CHECK(run.state->record.checks.at(0).severity == Severity::warning);
}

TEST_CASE("validate says that a bare value of a measure is asked for exactly", "[stages]") {
    const auto hint = [](const char* options) {
        return run_stage("validate", options, scene_of(shapes::cube())).state->record.checks.at(0).hint;
    };
    const std::string exactly =
        "a bare value requires exactly this value; use min for at least, max for at most";
    CHECK(hint("{min_angle: 30}") == exactly);
    CHECK(hint("{longest_edge: 2}") == exactly);
    CHECK(hint("{volume: 2}") == exactly);
    CHECK(hint("{min_angle: {min: 60}}") == "use relax to make faces more regular");
    CHECK(
        hint("{faces: 7}").starts_with("use simplify to reduce")); // an exact count is a sensible requirement
    CHECK(hint("{volume: 0}") != exactly);
}
