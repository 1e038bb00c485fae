#include "io/gltf/contents/textures.hpp"
#include "io/images/avif.hpp"
#include "io/images/encode_image.hpp"
#include "io/images/image_files.hpp"
#include "io/images/png.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <numeric>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// Noise of which few bytes can be saved, or a soft picture; with every second pixel transparent.
io::Pixels picture(std::size_t width, std::size_t height, bool alpha = false) {
    io::Pixels image{width, height, {}, false};
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (const std::size_t c :
                 {x * 3 + (y * y) % 61, 255 - y * 2, (x * y) % 199, alpha && x % 2 ? 0ul : 255ul})
                image.rgba.push_back(static_cast<std::uint8_t>(c));
    return image;
}

std::string uri_for(const io::Bytes& bytes) {
    return "data:" + io::media_type(bytes) + ";base64," + io::base64(bytes);
}

/// A triangle with these materials. Texture i has image i, unless `textures` is given.
Scene textured(const std::vector<io::Bytes>& images, const std::string& materials,
               const std::string& textures = "") {
    std::string all, own;
    for (std::size_t i = 0; i < images.size(); ++i) {
        all += fmt::format(R"({}{{"uri":"{}"}})", i ? "," : "", uri_for(images[i]));
        own += fmt::format(R"({}{{"source":{}}})", i ? "," : "", i);
    }
    return read_text(
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}],
"materials":[)" +
        materials + R"(],"textures":[)" + (textures.empty() ? own : textures) + R"(],"images":[)" + all +
        "]}");
}

const char* const coloured = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
const char* const every_role =
    R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorTexture":{"index":0},
"metallicRoughnessTexture":{"index":1}},"normalTexture":{"index":2},"occlusionTexture":{"index":1}})";

const Json& image_result(const StageRun& run, std::size_t i) { return run.record.result["images"][i]; }

/// The images of the scene after it was written as a GLB and read again.
std::vector<io::DocumentImage> images_again(const Scene& scene) {
    return io::document_images(*again(scene).documents.at(0), {});
}
Json document_again(const Scene& scene) { return Json::parse(again(scene).documents.at(0)->json); }

} // namespace

TEST_CASE("textures scales images down to a longest side, never up", "[stages]") {
    const io::Bytes large = io::encoded_png(picture(96, 40)), small = io::encoded_png(picture(20, 30));
    const auto run = run_stage(
        "textures", "32",
        textured({large, small}, fmt::format(R"({},{})", coloured, R"({"emissiveTexture":{"index":1}})")));
    CHECK(run.warnings().empty());
    const auto images = images_again(run.scene);
    REQUIRE(images.size() == 2);
    CHECK(io::image_size(images[0].bytes) == std::pair<std::size_t, std::size_t>(32, 13));
    CHECK(io::media_type(images[0].bytes) == "image/png");
    CHECK(images[1].bytes == small);
    CHECK(run.record.result["resized"] == 1);
    CHECK(run.record.result["unchanged"] == 1);
    CHECK(run.record.result["bytes_before"] == large.size() + small.size());
    CHECK(run.record.result["bytes_after"] == images[0].bytes.size() + small.size());
    CHECK(image_result(run, 0)["after"]["width"] == 32);
    CHECK(image_result(run, 0)["used_as"] == Json::array({"baseColorTexture"}));
    CHECK_FALSE(run.scene.parts[0].changed);
}

TEST_CASE("textures scales down to powers of two", "[stages]") {
    const auto run = run_stage("textures", "{power_of_two: true}",
                               textured({io::encoded_png(picture(100, 33))}, coloured));
    CHECK(image_result(run, 0)["after"]["width"] == 64);
    CHECK(image_result(run, 0)["after"]["height"] == 32);
}

TEST_CASE("nothing asked leaves every byte, broken images too", "[stages]") {
    const io::Bytes whole = io::encoded_png(picture(8, 8)), broken = to_bytes("\x89PNG\r\n\x1a\nbroken");
    const Scene scene = textured({whole, broken, whole}, every_role);
    const auto run = run_stage("textures", "{}", scene);
    CHECK(run.scene.documents[0] == scene.documents[0]);
    CHECK(run.warnings() == std::vector<std::string>{"W-TEXTURE-KEPT"});
    CHECK(image_result(run, 1)["kept"] == "it is broken");
}

TEST_CASE("textures writes WebP as EXT_texture_webp asks", "[stages]") {
    const auto run =
        run_stage("textures", "{format: webp}", textured({io::encoded_png(picture(64, 64))}, coloured));
    const Json json = document_again(run.scene);
    CHECK(json["textures"][0] == Json::parse(R"({"extensions":{"EXT_texture_webp":{"source":0}}})"));
    CHECK(json["images"][0]["mimeType"] == "image/webp");
    CHECK(json["extensionsUsed"] == Json::array({"EXT_texture_webp"}));
    CHECK(json["extensionsRequired"] == Json::array({"EXT_texture_webp"}));
    CHECK(image_result(run, 0)["after"]["format"] == "webp");
    CHECK(run.record.result["converted"] == 1);

    const auto back = run_stage("textures", "{format: png}", run.scene);
    const Json plain = document_again(back.scene);
    CHECK(plain["textures"][0] == Json::parse(R"({"source":0})"));
    CHECK_FALSE(plain.contains("extensionsUsed"));
    CHECK_FALSE(plain.contains("extensionsRequired"));
}

TEST_CASE("an image for readers without WebP is scaled and stays what it is", "[stages]") {
    const io::Bytes png = io::encoded_png(picture(64, 64)), webp = io::encoded_webp(picture(64, 64), {});
    const auto run = run_stage(
        "textures", "{format: webp, max_size: 16}",
        textured({png, webp}, coloured, R"({"source":0,"extensions":{"EXT_texture_webp":{"source":1}}})"));
    CHECK(image_result(run, 0)["after"]["format"] == "png");
    CHECK(image_result(run, 0)["after"]["width"] == 16);
    CHECK(image_result(run, 1)["after"]["width"] == 16);
    const Json json = document_again(run.scene);
    CHECK(json["textures"][0]["source"] == 0);
    CHECK_FALSE(json.contains("extensionsRequired"));
}

TEST_CASE("textures writes AVIF as EXT_texture_avif asks, or says that it cannot", "[stages]") {
    const Scene scene = textured({io::encoded_png(picture(64, 64))}, coloured);
    if (!io::has_avif()) {
        CHECK(problems_of("textures", options({{"format", "avif"}})).starts_with("E-AVIF "));
        return;
    }
    const auto run = run_stage("textures", "{format: avif}", scene);
    const Json json = document_again(run.scene);
    CHECK(json["textures"][0] == Json::parse(R"({"extensions":{"EXT_texture_avif":{"source":0}}})"));
    CHECK(json["images"][0]["mimeType"] == "image/avif");
    CHECK(json["extensionsRequired"] == Json::array({"EXT_texture_avif"}));
    CHECK(image_result(run, 0)["after"]["format"] == "avif");
    CHECK(image_result(run, 0)["after"]["width"] == 64);

    const auto back = run_stage("textures", "{format: png}", run.scene);
    CHECK(document_again(back.scene)["textures"][0] == Json::parse(R"({"source":0})"));
}

TEST_CASE("alpha that is used never becomes JPEG", "[stages]") {
    const io::Bytes leaf = io::encoded_png(picture(64, 64, true));
    const auto kept = run_stage("textures", "{format: jpeg}", textured({leaf, leaf, leaf}, every_role));
    CHECK(kept.warnings() == std::vector<std::string>{"W-TEXTURE-KEPT"});
    CHECK(images_again(kept.scene)[0].bytes == leaf);
    const auto scaled =
        run_stage("textures", "{format: jpeg, max_size: 32}", textured({leaf, leaf, leaf}, every_role));
    CHECK(image_result(scaled, 0)["after"]["format"] == "png");
    CHECK(image_result(scaled, 0)["after"]["width"] == 32);
    // For an opaque material it is not.
    const auto opaque = run_stage("textures", "{format: jpeg}", textured({leaf}, coloured));
    CHECK(opaque.warnings().empty());
    CHECK(image_result(opaque, 0)["after"]["format"] == "jpeg");
}

TEST_CASE("each role has options of its own", "[stages]") {
    const io::Bytes colour = io::encoded_png(picture(64, 64)), data = io::encoded_png(picture(64, 48)),
                    normal = io::encoded_png(picture(48, 64));
    const auto run =
        run_stage("textures",
                  "{max_size: 32, format: webp, normals: {format: keep, max_size: 16}, data: {format: png}}",
                  textured({colour, data, normal}, every_role));
    CHECK(image_result(run, 0)["after"]["format"] == "webp");
    CHECK(image_result(run, 1)["after"]["format"] == "png");
    CHECK(image_result(run, 1)["used_as"] == Json::array({"metallicRoughnessTexture", "occlusionTexture"}));
    CHECK(image_result(run, 2)["after"]["height"] == 16);
}

TEST_CASE("images of equal bytes are worked on once, in all their roles", "[stages]") {
    const io::Bytes image = io::encoded_png(picture(64, 64));
    const auto run = run_stage("textures", "16", textured({image, image, image}, every_role));
    REQUIRE(run.record.result["images"].size() == 1);
    CHECK(run.record.result["bytes_before"] == image.size());
    const auto images = images_again(run.scene);
    REQUIRE(images.size() == 3);
    CHECK(images[0].bytes == images[2].bytes);
    CHECK(io::image_size(images[2].bytes)->first == 16);
}

TEST_CASE("what would not be smaller stays", "[stages]") {
    const io::Bytes image = io::encoded_webp(picture(64, 64), {.quality = 1});
    const auto run = run_stage("textures", "{format: jpeg, quality: 100}", textured({image}, coloured));
    CHECK(image_result(run, 0)["kept"] == "it would not be smaller as jpeg");
    CHECK(run.warnings().empty());
}

TEST_CASE("repack makes images smaller that would stay, and nothing else", "[stages]") {
    const io::Bytes tight = io::encoded_png(picture(64, 64));
    io::Bytes loose = tight;
    loose.resize(loose.size() + 100); // after the end of the image
    const auto run =
        run_stage("textures", "{repack: true}",
                  textured({loose, tight}, every_role, R"({"source":0},{"source":1},{"source":1})"));
    CHECK(run.record.result["repacked"] == 1);
    CHECK(run.record.result["unchanged"] == 1);
    CHECK(run.record.result["resized"] == 0);
    const auto images = images_again(run.scene);
    CHECK(images.at(0).bytes == tight);
    CHECK(images.at(1).bytes == tight);
    CHECK(run_stage("textures", "{}", textured({loose}, coloured)).record.result["unchanged"] == 1);
}

TEST_CASE("images that hold feature ids stay as they are", "[stages]") {
    const Scene scene = textured(
        {io::encoded_png(picture(64, 64))},
        std::string(coloured) +
            R"(],"extensionsUsed":["EXT_structural_metadata"],"extensions":{"EXT_structural_metadata":
{"propertyTextures":[{"properties":{"a":{"index":0,"channels":[0]}}}]}},"cameras":[)");
    const auto run = run_stage("textures", "16", scene);
    CHECK(run.record.result["unchanged"] == 1);
    CHECK(image_result(run, 0).contains("kept"));
}

TEST_CASE("images that are read pixel by pixel stay as they are", "[stages]") {
    for (const int filter : {9728, 9729}) {
        Scene scene = textured({io::encoded_png(picture(64, 64))}, coloured);
        Document document = *scene.documents[0];
        Json json = Json::parse(document.json);
        json["samplers"] = {{{"magFilter", filter}, {"minFilter", 9728}}};
        json["textures"][0]["sampler"] = 0;
        document.json = json.dump();
        scene.documents[0] = std::make_shared<const Document>(std::move(document));
        const auto run = run_stage("textures", "{max_size: 16, format: jpeg}", scene);
        CHECK(run.record.result["unchanged"] == (filter == 9728 ? 1 : 0));
    }
}

TEST_CASE("textures refuses options that say nothing", "[stages]") {
    ::setenv("FACETMILL_KTX", "/nowhere/ktx", 1);
    CHECK(problems_of("textures", options({{"format", "ktx2"}}))
              .starts_with("E-KTX textures: FACETMILL_KTX is not the path of a program: '/nowhere/ktx'"));
    ::unsetenv("FACETMILL_KTX");
    CHECK(problems_of("textures", options({{"timeout", "0"}})).starts_with("E-RANGE"));
    CHECK(problems_of("textures", options({{"max_size", "nan"}})).starts_with("E-"));
    CHECK(problems_of("textures", options({{"max_size", "0"}})).starts_with("E-RANGE"));
    CHECK(problems_of("textures", options({{"quality", "101"}})).starts_with("E-RANGE"));
    CHECK(problems_of("textures", options({{"lossless", "true"}, {"format", "jpeg"}})) ==
          "E-CONFLICT textures: 'lossless' needs format: webp or avif | use format: webp, or remove it");
    const auto run = run_stage("textures", "16", scene_of(Mesh{}));
    CHECK(run.record.result["images"].empty());
}
