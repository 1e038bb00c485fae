#include "support/catch.hpp"

#include "io/codec.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::test;

TEST_CASE("a unit or an up axis that the format states is not overridden silently", "[io]") {
    const auto warnings = [](const std::string& name, const std::string& text, std::optional<Unit> unit,
                             std::optional<UpAxis> up) {
        const auto bytes = bytes_of(text);
        io::ReadLog log;
        io::ReadSettings settings;
        settings.unit = unit;
        settings.up = up;
        io::read_scene(io::Input::of(name, {bytes.begin(), bytes.end()}), settings, log);
        std::string all;
        for (const auto& w : log.warnings) all += w.id + ": " + w.message + "\n";
        return all;
    };
    const std::string gltf =
        R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [0, 0, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
        std::string(48, 'A') + R"("}]})";
    CHECK(warnings("a.gltf", gltf, Unit::mm, UpAxis::z) ==
          "W-OVERRIDDEN: 'a.gltf' states unit m, but mm is used instead, without a conversion\n"
          "W-OVERRIDDEN: 'a.gltf' states up y, but z is used instead, without a conversion\n");
    CHECK(warnings("a.gltf", gltf, Unit::m, UpAxis::y).empty());
    CHECK(warnings("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Unit::mm, {}).empty());
}
