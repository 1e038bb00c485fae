// tinygltf reads what facetmill wrote, and notices every kind of difference.
#include "io/gltf/read/second_reader.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;

namespace {

struct Written {
    io::Input file;
    Scene scene; ///< as read by facetmill
};

Written written(io::WriteSettings settings) {
    settings.title = "mesh";
    const io::Codec& codec = *io::codec_named("glb");
    io::Input file = io::Input::of(
        "mesh.glb", codec.write(test::scene_in_metres(shapes::torus(16, 12)), settings).files.front().bytes);
    io::ReadLog log;
    Scene scene = io::read_scene(file, {}, log);
    return {std::move(file), std::move(scene)};
}

std::vector<std::string> differences(const Written& w) {
    return io::gltf::read_again(w.file, w.scene).differences;
}

} // namespace

TEST_CASE("A second reader finds the same contents in every encoding that it knows", "[gltf]") {
    for (const bool draco : {false, true})
        for (const bool quantize : {false, true}) {
            io::WriteSettings settings;
            settings.draco.on = draco;
            settings.quantize.on = quantize && !draco;
            const io::SecondReading reading = [&] {
                const Written w = written(settings);
                return io::gltf::read_again(w.file, w.scene);
            }();
            CHECK(reading.reader == "tinygltf");
            CHECK(reading.not_asked.empty());
            CHECK(reading.differences == std::vector<std::string>{});
        }
}

TEST_CASE("A second reader that cannot decode a file is not asked", "[gltf]") {
    io::WriteSettings settings;
    settings.quantize.on = settings.meshopt.on = true;
    const Written w = written(settings);
    const io::SecondReading reading = io::gltf::read_again(w.file, w.scene);
    CHECK(reading.not_asked == "tinygltf does not decode meshopt compression");
    CHECK(reading.differences.empty());
}

TEST_CASE("A second reader notices other faces, places, lists and accessors", "[gltf]") {
    Written w = written({});
    REQUIRE(differences(w).empty());
    Mesh& mesh = w.scene.parts[0].mesh;
    const Mesh right = mesh;
    mesh.positions[0].x += 100;
    CHECK(differences(w) == std::vector<std::string>{"box of 'thing'"});
    mesh = shapes::cube();
    CHECK(differences(w).front() == "faces of 'thing': 12, tinygltf reads 384");
    mesh = right;
    Document document = *w.scene.documents[0];
    Json json = Json::parse(document.json);
    json["cameras"].push_back({{"type", "perspective"}});
    json["accessors"][0]["count"] = 7;
    document.json = json.dump();
    w.scene.documents[0] = std::make_shared<const Document>(document);
    const auto found = differences(w);
    REQUIRE(found.size() == 2);
    CHECK(found[0] == "cameras: 1, tinygltf reads 0");
    CHECK(found[1].starts_with("accessors[0].count: 7, tinygltf reads "));
}
