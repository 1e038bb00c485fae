// EXT_mesh_gpu_instancing: the positions of parts, moves together with instances, and grids of positions in
// each instance.
#include "base/error.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/read/instances.hpp"
#include "io/images/png.hpp"
#include "io/read_back.hpp"
#include "mesh/placement.hpp"
#include "mesh/shapes.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"
#include "stage/surface_loss.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;

namespace {

constexpr int bits = 14;

std::size_t add_floats(Json& json, const std::vector<float>& numbers, std::size_t components) {
    const auto bytes = std::as_bytes(std::span(numbers));
    json["buffers"].push_back(
        {{"byteLength", bytes.size()},
         {"uri", "data:application/octet-stream;base64," + io::base64({bytes.begin(), bytes.end()})}});
    json["bufferViews"].push_back({{"buffer", json["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", 5126},
                                 {"count", numbers.size() / components},
                                 {"type", components == 3 ? "VEC3" : "VEC4"}});
    return json["accessors"].size() - 1;
}

Json places(Json attributes) {
    return {{"EXT_mesh_gpu_instancing", {{"attributes", std::move(attributes)}}}};
}

/// A torus away from zero in four nodes. `three` has three mirrored or unevenly scaled instances, `plain`
/// has one, and `two` has two. `flat` has two instances of sizes 0 and 4. `three` and `two` are below a
/// scaled group.
Json four_nodes() {
    Mesh torus = shapes::torus(16, 12);
    for (Vec3& p : torus.positions) p = p * 0.5 + Vec3{20, -7, 3};
    io::WriteSettings settings;
    settings.order = io::TriangleOrder::keep;
    const Scene plain = test::again(test::scene_in_metres(torus), settings);
    Json json = Json::parse(plain.documents.at(0)->json);
    json["buffers"][0]["uri"] =
        "data:application/octet-stream;base64," + io::base64(plain.documents[0]->buffers.at(0));
    const std::size_t moves = add_floats(json, {100, 0, 0, -3, 50.5F, 7, 0.25F, 0, -80}, 3);
    const std::size_t turns = add_floats(json, {0, 0, 0, 1, 0.6F, 0, 0, 0.8F, 0.5F, -0.5F, 0.5F, 0.5F}, 4);
    const std::size_t scales = add_floats(json, {-1, 1, 1, 2, 0.5F, 3, 0.1F, 0.1F, 0.1F}, 3);
    const std::size_t two = add_floats(json, {5, 6, 7, -9, 0, 1}, 3);
    const std::size_t sizes = add_floats(json, {0, 0, 0, 4, 4, 4}, 3);
    json["nodes"] = {
        {{"name", "group"}, {"children", {1, 3}}, {"scale", {2, 2, 2}}, {"translation", {0, 1, 0}}},
        {{"name", "three"},
         {"mesh", 0},
         {"translation", {1, 2, 3}},
         {"extensions", places({{"TRANSLATION", moves}, {"ROTATION", turns}, {"SCALE", scales}})}},
        {{"name", "plain"}, {"mesh", 0}, {"rotation", {0, 0.6, 0, 0.8}}},
        {{"name", "two"}, {"mesh", 0}, {"extensions", places({{"TRANSLATION", two}})}},
        {{"name", "flat"}, {"mesh", 0}, {"extensions", places({{"TRANSLATION", two}, {"SCALE", sizes}})}}};
    json["scenes"] = {{{"nodes", {0, 2, 4}}}};
    json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    return json;
}

Scene expanded(const io::Bytes& bytes, const char* codec) {
    io::ReadSettings settings;
    settings.expand_instances = true;
    io::ReadLog log;
    return io::codec_named(codec)->read(io::Input::of("test", io::Bytes(bytes)), settings, log);
}

Scene expanded(const Json& json) { return expanded(test::to_bytes(json.dump()), "gltf"); }
Scene unexpanded(const Json& json) { return test::read_text(json.dump()); }

const Part& named(const Scene& scene, const std::string& name) {
    const auto found = std::find_if(scene.parts.begin(), scene.parts.end(),
                                    [&](const Part& part) { return part.name == name; });
    REQUIRE(found != scene.parts.end());
    return *found;
}

/// The largest move of a vertex of any instance, in steps of its own grid.
double steps_moved(const Scene& before, const Scene& after) {
    REQUIRE(before.parts.size() == after.parts.size());
    double most = 0;
    for (std::size_t i = 0; i < before.parts.size(); ++i) {
        const Part &was = before.parts[i], &is = after.parts[i];
        REQUIRE(was.mesh.vertex_count() == is.mesh.vertex_count());
        const Vec3 e = was.mesh.bounds().extent();
        const double step = std::max({e.x, e.y, e.z}) / ((1 << bits) - 1) * greatest_stretch(was.transform);
        for (Index v = 0; v < was.mesh.vertex_count(); ++v) {
            const double moved =
                length(in_world(was, was.mesh.positions[v]) - in_world(is, is.mesh.positions[v]));
            if (was.transform.determinant() != 0) most = std::max(most, moved / step);
        }
    }
    return most;
}

io::WriteSettings quantized(bool meshopt, bool filters) {
    io::WriteSettings settings;
    settings.quantize = {.on = true, .position_bits = bits};
    settings.meshopt = {.on = meshopt, .extension = {}, .filters = filters};
    settings.order = io::TriangleOrder::keep;
    return settings;
}

/// The type of the positions of the first primitive.
int position_type(const io::Bytes& glb) {
    const Json json = Json::parse(test::json_of(glb));
    const auto positions = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>();
    return json["accessors"][positions]["componentType"].get<int>();
}

} // namespace

TEST_CASE("the grid of instanced positions is in each place", "[io]") {
    const Json json = four_nodes();
    const Scene scene = unexpanded(json), all = expanded(json);
    REQUIRE(scene.parts.size() == 4);
    REQUIRE(all.parts.size() == 8);
    for (const auto& [meshopt, filters] : {std::pair(false, false), {true, false}, {true, true}}) {
        INFO(meshopt << filters);
        const io::WriteSettings settings = quantized(meshopt, filters);
        const io::Written written = test::written(scene, "glb", settings);
        CHECK(written.warnings.empty());
        CHECK(written.changes.empty());
        const io::Bytes& glb = written.files.at(0).bytes;
        CHECK(position_type(glb) == 5123);
        // sqrt(3) / 2 steps and float32's; with filters, also 16 bits of the rotations.
        CHECK(steps_moved(all, expanded(glb, "glb")) < (filters ? 2.5 : 0.95));
        CHECK(io::read_back(io::Input::of("a.glb", io::Bytes(glb)), *io::codec_named("glb"), scene, settings)
                  .position_error > 0);
        // Values that are already on a grid do not change, except for rotations, which are rounded again.
        const io::Bytes again =
            test::written(test::read_bytes(glb, "glb"), "glb", settings).files.at(0).bytes;
        CHECK((filters || again == glb));
        CHECK(steps_moved(all, expanded(again, "glb")) < (filters ? 3 : 0.95));
    }
}

TEST_CASE("instances on a grid have the same bytes for any number of threads", "[io]") {
    const Scene scene = unexpanded(four_nodes());
    std::vector<io::Bytes> all;
    for (const int threads : {1, 2, 5}) {
        set_threads(threads);
        all.push_back(test::written(scene, "glb", quantized(true, true)).files.at(0).bytes);
    }
    set_threads(0);
    CHECK((all[0] == all[1] && all[0] == all[2]));
}

TEST_CASE("places that a grid cannot be in keep the positions as they are, which is said", "[io]") {
    for (const bool far : {true, false}) {
        Json json = four_nodes();
        if (far) // a step of the grid exceeds the range of float32
            json["nodes"][3]["extensions"] = places({{"SCALE", add_floats(json, {3e38F, 1, 1, 1, 1, 1}, 3)}});
        else
            json["nodes"][3]["extensions"] = places(Json::object());
        const io::Written written = test::written(unexpanded(json), "glb", quantized(false, false));
        CHECK(position_type(written.files.at(0).bytes) == 5126);
        REQUIRE(written.changes.size() == 1);
        CHECK(written.changes[0].why.find("positions of its instances") != std::string::npos);
    }
}

TEST_CASE("a part with instances stands where the largest one with a volume does", "[io]") {
    const Json json = four_nodes();
    const Scene scene = unexpanded(json), all = expanded(json);
    CHECK(named(scene, "three").transform == all.parts.at(2).transform);
    CHECK(named(scene, "flat").transform.point({}) == Vec3{-9, 0, 1});
    CHECK(named(scene, "flat").transform.determinant() == 64);
    const Json same = Json::parse(test::json_of(test::written(scene, "glb").files.at(0).bytes));
    CHECK(same["nodes"] == json["nodes"]);
}

TEST_CASE("a part that moves takes all its instances along", "[io]") {
    const Json json = four_nodes();
    Scene scene = unexpanded(json);
    Scene wanted = expanded(json);
    Transform turn{{{0, -2, 0, 5}, {2, 0, 0, 6}, {0, 0, 2, 7}}};
    for (Part& part : scene.parts) part.transform = turn * part.transform;
    for (Part& part : wanted.parts) part.transform = turn * part.transform;
    for (const bool quantize : {false, true}) {
        const io::WriteSettings settings = quantize ? quantized(false, false) : io::WriteSettings{};
        const auto glb = test::written(scene, "glb", settings).files.at(0).bytes;
        if (quantize) CHECK(steps_moved(wanted, expanded(glb, "glb")) < 0.95);
        if (!quantize) CHECK(steps_moved(wanted, expanded(glb, "glb")) < 1e-6);
    }
}

TEST_CASE("the surface of a part counts at all of its instances, and moves with it", "[io]") {
    const Json json = four_nodes();
    Scene scene = unexpanded(json), all = expanded(json);
    const Transform turn{{{0, -2, 0, 5}, {2, 0, 0, 6}, {0, 0, 2, 7}}};
    for (Scene* each : {&scene, &all})
        for (Part& part : each->parts) part.transform = turn * part.transform;
    const auto places_of = [](const Scene& of) {
        std::vector<std::vector<Transform>> places(of.parts.size());
        io::for_each_place_of_instances(of, [&](std::size_t part, const Transform& place, double times) {
            CHECK(times == 1);
            places[part].push_back(place);
        });
        return places;
    };
    const auto places = places_of(scene);
    const auto total = [](const Scene& of) {
        PartSurface sum;
        for (const PartSurface& s : surfaces_of_parts(of)) {
            sum.faces += s.faces;
            sum.area += s.area;
        }
        return sum;
    };
    std::size_t seen = 0, faces = 0; // of parts that have instances, and of the one at each of them
    for (std::size_t i = 0; i < 4; ++i) {
        seen += places[i].size();
        faces += scene.parts[i].mesh.face_count() * std::max<std::size_t>(1, places[i].size());
        if (!places[i].empty())
            CHECK(std::any_of(places[i].begin(), places[i].end(), [&](const Transform& t) {
                return length(t.point({}) - scene.parts[i].transform.point({})) < 1e-9;
            }));
    }
    CHECK(seen == 3 + 2 + 2);
    CHECK(total(scene).faces == faces);
    CHECK(total(scene).faces == total(all).faces);
    const double ratio =
        total(scene).area / total(all).area; // the area of an unevenly scaled instance is estimated
    CHECK(ratio > 1 - 1e-6);
    CHECK(ratio < 1.05);
    CHECK(places_of(all) == std::vector<std::vector<Transform>>(8));
    for (Part& part : scene.parts) part.document = -1;
    CHECK(total(scene).faces * 2 == faces); // the document no longer applies
}

TEST_CASE("pieces of an instanced part are instanced, too", "[io]") {
    const Json json = four_nodes();
    Scene scene = unexpanded(json);
    Part piece = named(scene, "three");
    piece.name = "half";
    piece.mesh.corners.resize(piece.mesh.corners.size() / 6 * 3);
    piece.changed = true;
    scene.parts.push_back(piece);
    const Scene all = expanded(test::written(scene, "glb").files.at(0).bytes, "glb");
    REQUIRE(all.parts.size() == 8 + 3);
    const Scene before = expanded(json);
    for (std::size_t i = 0; i < 3; ++i) {
        const Part& of = before.parts.at(1 + i);
        CHECK(std::any_of(all.parts.begin() + 8, all.parts.end(), [&](const Part& p) {
            return length(p.transform.point({}) - of.transform.point({})) < 1e-4 &&
                   std::abs(p.transform.determinant() - of.transform.determinant()) < 1e-4;
        }));
    }
}

TEST_CASE("instances that do not fit together are malformed", "[io]") {
    Json json = four_nodes();
    json["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
        add_floats(json, {1, 1, 1}, 3);
    for (const auto& read : {unexpanded, static_cast<Scene (*)(const Json&)>(expanded)})
        CHECK_THROWS_AS(read(json), Error);
}

TEST_CASE("the area at a place is that of the surface there, and no less where its scale is uneven", "[io]") {
    const auto estimated = [](Mesh mesh, const std::array<double, 3>& scales) {
        Json json = four_nodes();
        Scene scene = unexpanded(json);
        scene.parts.resize(1);
        scene.parts[0].mesh = std::move(mesh);
        const auto exact = [&](const Mesh& m) {
            double area = 0;
            io::for_each_place_of_instances(scene, [&](std::size_t, const Transform& place, double) {
                area += surface_size(m, place, false).area;
            });
            return area;
        };
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 4; ++j) scene.parts[0].transform.m[k][j] *= scales[k];
        return std::pair(surfaces_of_parts(scene).at(0).area, exact(scene.parts[0].mesh));
    };
    for (const Mesh& mesh : {shapes::icosphere(3), shapes::cube(), shapes::grid(3, 3)})
        for (const std::array<double, 3>& scales :
             {std::array<double, 3>{1, 1, 1}, {5, 1, 1}, {1, 0.01, 3}}) {
            const auto [area, exact] = estimated(mesh, scales);
            CHECK(area > exact * (1 - 1e-6));
            CHECK(area <
                  exact * 1.5); // the mean square of |cos| over a sphere is 1.33 times the square of its mean
        }
}
