// Poses of animations and morph targets, in which simplify compares its result with the input.
#include "io/gltf/read/animation_poses.hpp"
#include "mesh/shapes.hpp"
#include "support/bench.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

#include <cstring>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// A document that tests complete with data and animations.
struct Editable {
    Scene scene;
    Document document;
    Json json;

    explicit Editable(Mesh mesh) : scene(again(scene_in_metres(std::move(mesh)))) {
        document = *scene.documents.at(0);
        json = Json::parse(document.json);
    }
    std::size_t accessor(const std::vector<float>& numbers, const char* type, std::size_t components) {
        std::vector<std::byte> bytes(numbers.size() * sizeof(float));
        std::memcpy(bytes.data(), numbers.data(), bytes.size());
        json["buffers"].push_back({{"byteLength", bytes.size()}});
        json["bufferViews"].push_back({{"buffer", json["buffers"].size() - 1}, {"byteLength", bytes.size()}});
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", 5126},
                                     {"count", numbers.size() / components},
                                     {"type", type}});
        document.buffers.push_back(std::move(bytes));
        return json["accessors"].size() - 1;
    }
    /// Adds a track to the animation 'walk'.
    void track(std::size_t node, const char* path, const std::vector<float>& times,
               const std::vector<float>& values, const char* type, std::size_t components,
               const char* interpolation = "LINEAR") {
        if (!json.contains("animations"))
            json["animations"] = {
                {{"name", "walk"}, {"channels", Json::array()}, {"samplers", Json::array()}}};
        Json& animation = json["animations"][0];
        const std::size_t input = accessor(times, "SCALAR", 1), output = accessor(values, type, components);
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
        animation["samplers"].push_back(
            {{"input", input}, {"output", output}, {"interpolation", interpolation}});
    }
    void finish() {
        document.json = json.dump();
        scene.documents[0] = std::make_shared<const Document>(document);
    }
};

/// A grid with a morph target that lifts its middle.
Mesh liftable() {
    Mesh mesh = shapes::grid(8, 8);
    std::vector<float> lifts(3 * mesh.vertex_count(), 0);
    Index middle = 0;
    const Vec3 centre = mesh.bounds().centre();
    for (Index v = 0; v < mesh.vertex_count(); ++v)
        if (length(mesh.positions[v] - centre) < length(mesh.positions[middle] - centre)) middle = v;
    lifts[3 * middle + 2] = 2;
    mesh.attributes.push_back(
        {"TARGET_0_POSITION", Domain::wedge, Role::morph_vector, 3, false, std::move(lifts)});
    return mesh;
}

double height(const Mesh& mesh) { return mesh.bounds().max.z; }

} // namespace

TEST_CASE("poses are the keys of animations, with other tracks in between", "[io]") {
    Editable e(liftable());
    const std::size_t node = static_cast<std::size_t>(e.scene.parts.at(0).node);
    e.track(node, "weights", {0, 2}, {0, 1}, "SCALAR", 1);
    e.track(node, "translation", {1}, {0, 0, 0}, "VEC3", 3); // only another time
    e.finish();
    const Part& part = e.scene.parts[0];
    const auto poses = io::AnimationPoses(*e.scene.documents[0], 8).of(part);
    REQUIRE(poses.size() == 3);
    CHECK(poses[1].name == "animation 'walk' at 1 s");
    CHECK(height(io::posed_mesh(part.mesh, poses[0])) == 0);
    CHECK(height(io::posed_mesh(part.mesh, poses[1])) == 1);
    CHECK(height(io::posed_mesh(part.mesh, poses[2])) == 2);
    const auto two = io::AnimationPoses(*e.scene.documents[0], 2).of(part); // the first and the last
    REQUIRE(two.size() == 2);
    CHECK(height(io::posed_mesh(part.mesh, two[1])) == 2);
}

TEST_CASE("poses interpolate as glTF says", "[io]") {
    for (const auto& [interpolation, values, wanted] :
         {std::tuple{"STEP", std::vector<float>{0.25F, 1}, 0.5},
          std::tuple{"CUBICSPLINE", std::vector<float>{0, 0, 0, 0, 1, 0}, 1.0}, // flat at both ends
          std::tuple{"CUBICSPLINE", std::vector<float>{0, 0, 4, 0, 0, 0}, 1.0}}) {
        Editable e(liftable());
        const std::size_t node = static_cast<std::size_t>(e.scene.parts.at(0).node);
        e.track(node, "weights", {0, 1}, values, "SCALAR", 1, interpolation);
        e.track(node, "translation", {0.5F}, {0, 0, 0}, "VEC3", 3);
        e.finish();
        const auto poses = io::AnimationPoses(*e.scene.documents[0], 8).of(e.scene.parts[0]);
        REQUIRE(poses.size() == 3);
        CHECK(height(io::posed_mesh(e.scene.parts[0].mesh, poses[1])) == Approx(wanted));
    }
}

TEST_CASE("targets that no animation moves count alone", "[io]") {
    const Scene scene = again(scene_in_metres(liftable()));
    const auto poses = io::AnimationPoses(*scene.documents.at(0), 8).of(scene.parts[0]);
    REQUIRE(poses.size() == 1);
    CHECK(poses[0].name == "morph target 0");
    CHECK(height(io::posed_mesh(scene.parts[0].mesh, poses[0])) == 2);
}

TEST_CASE("rotations of joints follow the arc, and move the world of what is below", "[io]") {
    Mesh mesh = shapes::cube();
    const std::size_t count = mesh.vertex_count();
    mesh.attributes.push_back(
        {"JOINTS_0", Domain::wedge, Role::joints, 4, false, std::vector<std::uint8_t>(4 * count, 0)});
    std::vector<float> weights;
    for (std::size_t v = 0; v < count; ++v) weights.insert(weights.end(), {1, 0, 0, 0});
    mesh.attributes.push_back({"WEIGHTS_0", Domain::wedge, Role::weights, 4, false, std::move(weights)});
    Editable e(std::move(mesh));
    const std::size_t node = static_cast<std::size_t>(e.scene.parts.at(0).node),
                      joint = e.json["nodes"].size();
    e.json["nodes"].push_back({{"children", {joint + 1}}});
    e.json["nodes"].push_back({{"name", "joint"}});
    e.json["scenes"][0]["nodes"].push_back(joint);
    e.json["skins"] = {{{"joints", {joint + 1}}}};
    e.json["nodes"][node]["skin"] = 0;
    const float half = 0.70710678F;
    e.track(joint, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, half, half}, "VEC4", 4); // a quarter turn about z
    e.track(joint + 1, "translation", {0.5F}, {10, 0, 0}, "VEC3", 3);
    e.finish();
    Part part = e.scene.parts[0];
    part.skinned = true;
    const auto poses = io::AnimationPoses(*e.scene.documents[0], 8).of(part);
    REQUIRE(poses.size() == 3);
    REQUIRE(poses[1].joints.size() == 1);
    const Vec3 origin = poses[1].joints[0].point({}); // 10 along x, turned by 45 degrees
    CHECK(origin.x == Approx(10 * half).epsilon(1e-6));
    CHECK(origin.y == Approx(10 * half).epsilon(1e-6));
}

TEST_CASE("simplify tells the deviation of the worst pose, and warns above max_error", "[stages]") {
    for (const double lift : {0.0001, 1.0}) {
        Bench b;
        Mesh mesh = liftable();
        for (float& x : std::get<std::vector<float>>(mesh.attributes[0].data)) x *= static_cast<float>(lift);
        b.scene = again(scene_in_metres(std::move(mesh)));
        b.run("simplify",
              Value::map({{"faces", {}, Value::scalar("2")}, {"max_error", {}, Value::scalar("0.001")}}));
        const Json part = b.record.result["parts"][0];
        REQUIRE(part.contains("posed_deviation"));
        CHECK(part["posed_deviation"]["poses"] == 1);
        const double found = part["posed_deviation"]["maximum"];
        CHECK(part["deviation"]["maximum"].get<double>() <= 0.001);
        std::size_t warned = 0;
        for (const auto& w : b.record.warnings) warned += w.id == "W-REST-POSE";
        CHECK(warned == (found > 0.001 ? 1U : 0U));
        if (lift < 1) CHECK(found <= 0.001);
    }
}
