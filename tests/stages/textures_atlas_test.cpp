#include "base/math/random.hpp"
#include "geometry/render/srgb.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/images/encode_image.hpp"
#include "io/images/png.hpp"
#include "stages/textures/atlas_layout.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;
using textures_stage::AtlasTile;

namespace textures_atlas_test {

namespace {

/// An image whose texels all differ.
io::Pixels image(std::size_t width, std::size_t height, std::uint8_t seed) {
    io::Pixels out{width, height, {}, false};
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (const std::size_t c : {x * 7 + seed, y * 5 + seed, (x + y) * 3 + seed, std::size_t{255}})
                out.rgba.push_back(static_cast<std::uint8_t>(c));
    return out;
}

/// A square with texture coordinates from `low` to `high`, and its material.
struct Square {
    std::array<float, 2> low{0, 0}, high{1, 1};
    std::string material;
};

std::string uri(const char* type, const io::Bytes& bytes) {
    return fmt::format("data:{};base64,{}", type, io::base64(bytes));
}

/// A node, a mesh and a material for each square. Texture i has image i and the sampler.
Scene squares(const std::vector<Square>& all, const std::vector<io::Pixels>& images,
              const std::string& sampler = "{}") {
    std::vector<float> numbers;
    Json json = Json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}],"nodes":[],
"meshes":[],"accessors":[],"bufferViews":[],"materials":[],"textures":[],"images":[]})");
    json["samplers"] = Json::array({Json::parse(sampler)});
    for (const io::Pixels& one : images) {
        json["textures"].push_back({{"source", json["images"].size()}, {"sampler", 0}});
        json["images"].push_back({{"uri", uri("image/png", io::encoded_png(one))}});
    }
    const auto accessor = [&](const std::vector<float>& values, int components) {
        const std::size_t number = json["accessors"].size();
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", 4 * numbers.size()}, {"byteLength", 4 * values.size()}});
        json["accessors"].push_back({{"bufferView", number},
                                     {"componentType", 5126},
                                     {"count", values.size() / static_cast<std::size_t>(components)},
                                     {"type", components == 2 ? "VEC2" : "VEC3"}});
        numbers.insert(numbers.end(), values.begin(), values.end());
        return number;
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto [a, b] = all[i].low;
        const auto [c, d] = all[i].high;
        const auto x = static_cast<float>(2 * i);
        const std::size_t position =
            accessor({x, 0, 0, x + 1, 0, 0, x + 1, 1, 0, x, 0, 0, x + 1, 1, 0, x, 1, 0}, 3);
        json["accessors"][position]["min"] = {x, 0, 0};
        json["accessors"][position]["max"] = {x + 1, 1, 0};
        const std::size_t uvs = accessor({a, b, c, b, c, d, a, b, c, d, a, d}, 2);
        json["scenes"][0]["nodes"].push_back(i);
        json["nodes"].push_back({{"mesh", i}});
        json["meshes"].push_back(
            {{"primitives", Json::array({{{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uvs}}},
                                          {"material", i}}})}});
        json["materials"].push_back(Json::parse(all[i].material));
        json["materials"].back()["name"] = fmt::format("m{}", i);
    }
    const auto bytes = std::as_bytes(std::span(numbers));
    json["buffers"] = Json::array({{{"byteLength", bytes.size()},
                                    {"uri", uri("application/octet-stream", {bytes.begin(), bytes.end()})}}});
    return read_text(json.dump());
}

std::string coloured(std::size_t texture, const std::string& more = "", const std::string& info = "") {
    return fmt::format(R"({{{}"pbrMetallicRoughness":{{"baseColorTexture":{{{}"index":{}}}}}}})", more, info,
                       texture);
}

/// The texture coordinates of a square at a point from (0, 0) to (1, 1).
std::array<double, 2> uv_at(const Scene& scene, std::size_t square, double s, double t) {
    const Mesh& mesh = scene.parts.at(square).mesh;
    const Attribute* uv = mesh.find("TEXCOORD_0", Domain::wedge);
    std::array<double, 2> out{};
    for (int k = 0; uv && k < 2; ++k) {
        const auto at = [&](std::size_t corner) { return uv->value(mesh.corners[corner], k); };
        out[static_cast<std::size_t>(k)] = at(0) + s * (at(1) - at(0)) + t * (at(2) - at(1));
    }
    return out;
}

/// The images of the last document, by the names of their textures in the material.
std::map<std::string, io::Pixels> atlas_of(const Scene& scene) {
    std::map<std::string, io::Pixels> all;
    for (const auto& one : io::document_images(*scene.documents.back(), {}))
        for (const std::string& name : one.use.textures) all[name] = io::decoded_image(one.bytes).value();
    return all;
}

std::array<int, 4> texel(const io::Pixels& image, std::array<double, 2> uv) {
    const auto at = [](double u, std::size_t side) {
        return static_cast<std::size_t>(u * static_cast<double>(side));
    };
    const std::size_t i = 4 * (at(uv[1], image.height) * image.width + at(uv[0], image.width));
    return {image.rgba.at(i), image.rgba.at(i + 1), image.rgba.at(i + 2), image.rgba.at(i + 3)};
}

/// Compares the atlas with an image at all texel centres of a square that shows columns x rows texels.
/// expected(x, y): the texel of the image.
template <class Expected>
void compare(const Scene& scene, std::size_t square, const io::Pixels& image, int columns, int rows,
             Expected&& expected) {
    const io::Pixels atlas = atlas_of(scene).at("baseColorTexture");
    int different = 0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto [ex, ey] = expected(x, y);
            const std::size_t i =
                4 * (static_cast<std::size_t>(ey) * image.width + static_cast<std::size_t>(ex));
            const auto found = texel(atlas, uv_at(scene, square, (x + 0.5) / columns, (y + 0.5) / rows));
            for (std::size_t c = 0; c < 4; ++c) different += found[c] != image.rgba[i + c];
        }
    CHECK(different == 0);
}

constexpr auto itself = [](int x, int y) { return std::pair(x, y); };

std::string reason(const StageRun& run, std::size_t i) {
    return run.record.result["atlas"]["apart"].at(i)["reason"].get<std::string>();
}

} // namespace

TEST_CASE("textures: an atlas keeps every texel", "[stages]") {
    const io::Pixels a = image(32, 16, 1), b = image(8, 8, 90);
    const auto run = run_stage("textures", "{atlas: true}",
                               squares({{{}, {1, 1}, coloured(0)}, {{}, {1, 1}, coloured(1)}}, {a, b}));
    CHECK(run.warnings().empty());
    compare(run.scene, 0, a, 32, 16, itself);
    compare(run.scene, 1, b, 8, 8, itself);
    // The gutter continues the textures, which repeat.
    const io::Pixels atlas = atlas_of(run.scene).at("baseColorTexture");
    auto beyond = uv_at(run.scene, 1, 1 + 0.5 / 8, 0.5 / 8);
    CHECK(texel(atlas, beyond)[0] == 90);
    const Json& result = run.record.result["atlas"];
    CHECK(result["before"]["materials"] == 2);
    CHECK(result["after"]["materials"] == 1);
    CHECK(result["before"]["images"] == 2);
    CHECK(result["after"]["images"] == 1);
    CHECK(result["made"][0]["materials"] == Json::array({"m0", "m1"}));
    CHECK(result["apart"].empty());
    // The written file has one material and one image.
    const Json document = Json::parse(again(run.scene).documents.at(0)->json);
    CHECK(document["materials"].size() == 1);
    CHECK(document["images"].size() == 1);
    // Its parts can be joined.
    const auto joined = run_stage("optimize", "{}", run.scene);
    CHECK(joined.record.result["draw_calls_before"] == 2);
    CHECK(joined.record.result["draw_calls_after"] == 1);
}

TEST_CASE("textures: an atlas unrolls repeats as samplers do", "[stages]") {
    const io::Pixels a = image(16, 16, 3), b = image(16, 16, 120);
    const std::vector<Square> twice = {{{3, -1}, {5, 0}, coloured(0)}, {{}, {1, 1}, coloured(1)}};
    auto run = run_stage("textures", "{atlas: true}", squares(twice, {a, b}));
    compare(run.scene, 0, a, 32, 16, [](int x, int y) { return std::pair(x % 16, y); });
    run = run_stage("textures", "{atlas: true}", squares(twice, {a, b}, R"({"wrapS":33648})"));
    // From 3 to 4, the texture is mirrored.
    compare(run.scene, 0, a, 32, 16, [](int x, int y) { return std::pair(x < 16 ? 15 - x : x - 16, y); });
    const std::vector<Square> outside = {{{-0.5F, 0}, {1.5F, 1}, coloured(0)}, {{}, {1, 1}, coloured(1)}};
    run =
        run_stage("textures", "{atlas: true}", squares(outside, {a, b}, R"({"wrapS":33071,"wrapT":33071})"));
    compare(run.scene, 0, a, 32, 16, [](int x, int y) { return std::pair(std::clamp(x - 8, 0, 15), y); });
    run = run_stage("textures", "{atlas: true, unroll: 1}", squares(twice, {a, b}));
    CHECK(run.record.result["atlas"]["made"].empty());
    CHECK(reason(run, 0) == "its texture repeats 2 x 1 times, more than unroll: 1");
    const std::vector<Square> strip = {{{0, 0}, {8, 0.25F}, coloured(0)}, {{}, {1, 1}, coloured(1)}};
    run = run_stage("textures", "{atlas: true}", squares(strip, {a, b}));
    CHECK(reason(run, 0) == "its texture repeats 8 x 0.25 times, more than unroll: 4");
}

TEST_CASE("textures: an atlas has only the used part of a texture", "[stages]") {
    const io::Pixels a = image(64, 64, 3), b = image(16, 16, 120);
    const auto run =
        run_stage("textures", "{atlas: true}",
                  squares({{{0.25F, 0.5F}, {0.5F, 0.75F}, coloured(0)}, {{}, {1, 1}, coloured(1)}}, {a, b}));
    compare(run.scene, 0, a, 16, 16, [](int x, int y) { return std::pair(16 + x, 32 + y); });
    CHECK(atlas_of(run.scene).at("baseColorTexture").width *
              atlas_of(run.scene).at("baseColorTexture").height ==
          64 * 32); // two tiles of 16 texels, each with a gutter of 8
}

TEST_CASE("textures: an atlas applies texture transforms", "[stages]") {
    const io::Pixels a = image(16, 16, 3), b = image(16, 16, 120);
    const std::string moved = R"("extensions":{"KHR_texture_transform":{"offset":[0.5,0],"scale":[0.5,1]}},)";
    const auto run =
        run_stage("textures", "{atlas: true}",
                  squares({{{}, {1, 1}, coloured(0, "", moved)}, {{}, {1, 1}, coloured(1)}}, {a, b}));
    compare(run.scene, 0, a, 8, 16, [](int x, int y) { return std::pair(8 + x, y); });
}

TEST_CASE("textures: an atlas multiplies factors in linear light", "[stages]") {
    const io::Pixels a = image(16, 16, 100), b = image(16, 16, 120);
    const std::string half =
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[0.5,1,1,1],"roughnessFactor":0.5}})";
    const std::string plain =
        R"({"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,1,1],"metallicFactor":0}})";
    const auto run =
        run_stage("textures", "{atlas: true}",
                  squares({{{}, {1, 1}, half}, {{}, {1, 1}, coloured(1)}, {{}, {1, 1}, plain}}, {a, b}));
    const auto atlas = atlas_of(run.scene);
    const auto first = texel(atlas.at("baseColorTexture"), uv_at(run.scene, 0, 0.5 / 16, 0.5 / 16));
    CHECK(first[0] == srgb_of(linear_of(100) / 2));
    CHECK(first[1] == 100);
    compare(run.scene, 1, b, 16, 16, itself);
    const auto patch = texel(atlas.at("baseColorTexture"), uv_at(run.scene, 2, 0.5, 0.5));
    CHECK(patch == std::array<int, 4>{srgb_of(0.25F), srgb_of(0.5F), 255, 255});
    // Roughness and metalness are plain values, so their map has one texel per gutter.
    const io::Pixels& surface = atlas.at("metallicRoughnessTexture");
    CHECK(8 * surface.width == atlas.at("baseColorTexture").width);
    CHECK(texel(surface, uv_at(run.scene, 0, 0.5, 0.5))[1] == 128);
    CHECK(texel(surface, uv_at(run.scene, 1, 0.5, 0.5))[1] == 255);
    CHECK(texel(surface, uv_at(run.scene, 2, 0.5, 0.5))[2] == 0);
}

TEST_CASE("textures: maps of an atlas have the size of their textures", "[stages]") {
    const std::string bumpy =
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"normalTexture":{"index":1}})";
    const std::string other =
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":2}},"normalTexture":{"index":3}})";
    const auto scene = [&] {
        return squares({{{}, {1, 1}, bumpy}, {{}, {1, 1}, other}},
                       {image(64, 64, 1), image(16, 16, 2), image(32, 32, 3), image(16, 16, 4)});
    };
    const auto run = run_stage("textures", "{atlas: true}", scene());
    const auto atlas = atlas_of(run.scene);
    CHECK(atlas.at("normalTexture").width * 2 == atlas.at("baseColorTexture").width);
    const auto halved = run_stage("textures", "{atlas: true, max_size: 64}", scene());
    CHECK(halved.warnings() == std::vector<std::string>{"W-TEXTURE-ATLAS"});
    CHECK(halved.record.result["atlas"]["made"][0]["halved"][0] == "m0"); // it has more texels per area
    const auto small = atlas_of(halved.scene).at("baseColorTexture");
    CHECK(std::max(small.width, small.height) <= 64);
}

TEST_CASE("textures: materials of different kinds stay apart", "[stages]") {
    const std::vector<io::Pixels> images = {image(16, 16, 1), image(16, 16, 2)};
    const auto run_with = [&](const std::string& a, const std::string& b) {
        return run_stage("textures", "{atlas: true}", squares({{{}, {1, 1}, a}, {{}, {1, 1}, b}}, images));
    };
    for (const std::string more :
         {R"("alphaMode":"BLEND",)", R"("doubleSided":true,)", R"("extensions":{"KHR_materials_unlit":{}},)",
          R"("extras":{"a":1},)", R"("alphaMode":"MASK",)", R"("normalTexture":{"index":0},)"}) {
        const auto run = run_with(coloured(0), coloured(1, more));
        CHECK(run.record.result["atlas"]["made"].empty());
        CHECK(reason(run, 0) == "no other material has the same textures, alpha mode, sides and extensions");
        CHECK(run.record.result["unchanged"] == 2);
        CHECK(run_with(coloured(0, more), coloured(1, more)).record.result["atlas"]["made"].size() == 1);
    }
    const auto clear = run_with(
        coloured(0),
        coloured(1, R"("extensions":{"KHR_materials_transmission":{"transmissionTexture":{"index":0}}},)"));
    CHECK(reason(clear, 1) == "KHR_materials_transmission has textures");
    const auto mixed = run_with(coloured(0), coloured(1, R"("occlusionTexture":{"index":0,"texCoord":1},)"));
    CHECK(reason(mixed, 1) == "its textures use different texture coordinates");
}

TEST_CASE("textures: tiles of an atlas are apart, within the limit, and multiples of the gutter",
          "[stages]") {
    std::uint64_t random = 7;
    for (int round = 0; round < 20; ++round) {
        std::vector<AtlasTile> tiles(1 + static_cast<std::size_t>(round));
        for (AtlasTile& tile : tiles) {
            const auto next = [&](std::uint64_t most) { return (random = hashed(random, 1)) % most; };
            tile.image_width = 1 + next(200);
            tile.image_height = 1 + next(200);
            tile.extent.low = {0.01 * static_cast<double>(next(50)), -0.01 * static_cast<double>(next(50))};
            tile.extent.high = {0.5 + 0.01 * static_cast<double>(next(100)), 1};
            tile.extent.uv_area = tile.extent.world_area = 1;
        }
        const std::size_t gutter = std::size_t{1} << (round % 5);
        const auto layout = textures_stage::lay_out(tiles, 512, gutter);
        REQUIRE(layout);
        CHECK(std::max(layout->width, layout->height) <= 512);
        const auto& all = layout->tiles;
        for (std::size_t i = 0; i < all.size(); ++i) {
            CHECK((all[i].x | all[i].y | all[i].width | all[i].height) % gutter == 0);
            const auto low = all[i].place(all[i].extent.low), high = all[i].place(all[i].extent.high);
            CHECK((low[0] >= static_cast<double>(all[i].x) &&
                   high[0] <= static_cast<double>(all[i].x + all[i].width)));
            CHECK(all[i].y + all[i].height + gutter <= layout->height);
            for (std::size_t k = 0; k < i; ++k) {
                const bool apart = all[i].x >= all[k].x + all[k].width + 2 * gutter ||
                                   all[k].x >= all[i].x + all[i].width + 2 * gutter ||
                                   all[i].y >= all[k].y + all[k].height + 2 * gutter ||
                                   all[k].y >= all[i].y + all[i].height + 2 * gutter;
                CHECK(apart);
            }
        }
    }
    CHECK(!textures_stage::lay_out(std::vector<AtlasTile>(100), 64, 8)); // plain colours cannot shrink
}

} // namespace textures_atlas_test
