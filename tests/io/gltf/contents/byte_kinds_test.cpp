#include "support/catch.hpp"

#include "io/gltf/contents/byte_kinds.hpp"

#include <string>

using namespace facetmill;
using io::byte_kinds;

namespace {

io::Span bytes_of_text(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string glb(std::string json, const std::string& binary) {
    while (json.size() % 4 != 0) json += ' ';
    const auto number = [](std::size_t n) {
        std::string out;
        for (int i = 0; i < 4; ++i) out += static_cast<char>(n >> (8 * i) & 255);
        return out;
    };
    const std::string chunks =
        number(json.size()) + "JSON" + json + number(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + number(2) + number(12 + chunks.size()) + chunks;
}

} // namespace

TEST_CASE("the bytes of a GLB are geometry, textures and JSON", "[io]") {
    const std::string json = R"({"images":[{"bufferView":1},{"bufferView":1},{"bufferView":9}],)"
                             R"("bufferViews":[{"byteLength":8},{"byteLength":20}]})";
    const std::string file = glb(json, std::string(28, 'x'));
    const auto kinds = byte_kinds("a.bin", file.size(), bytes_of_text(file));
    CHECK(kinds.textures == 20);
    CHECK(kinds.json == (json.size() + 3) / 4 * 4);
    CHECK(kinds.geometry == file.size() - kinds.textures - kinds.json);
}

TEST_CASE("the bytes of other files are told by their names, those of a broken one are geometry", "[io]") {
    const std::string document =
        R"({"images":[{"uri":"data:image/png;base64,AAAA"}],"buffers":[{"uri":"data:,AAAAAAAA"}]})";
    const auto kinds = byte_kinds("a.gltf", document.size(), bytes_of_text(document));
    CHECK(kinds.textures == 26);
    CHECK(kinds.geometry == 14);
    CHECK(kinds.json == document.size() - 40);
    CHECK(byte_kinds("A.PNG", 7, {}).textures == 7);
    CHECK(byte_kinds("a.mtl", 7, {}).json == 7);
    CHECK(byte_kinds("a.stl", 7, {}).geometry == 7);
    const std::string broken = "glTF....";
    CHECK(byte_kinds("a.glb", 8, bytes_of_text(broken)).geometry == 8);
    const std::string no_document = "[1, 2";
    const auto all = byte_kinds("a.gltf", 5, bytes_of_text(no_document));
    CHECK(all.geometry + all.textures + all.json == 5);
}
