#include "io/gltf/contents/resolved_materials.hpp"
#include "support/catch.hpp"

#include "base/json.hpp"
#include "io/images/png.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"

#include <fmt/format.h>

using namespace facetmill;

namespace {

std::string data_uri(const std::string& bytes, const char* type = "image/png") {
    return fmt::format("data:{};base64,{}", type, io::base64(std::as_bytes(std::span(bytes))));
}

/// A scene of no part with that one material, and its images.
Scene scene_with(const Json& material, const std::vector<std::string>& uris,
                 const Json& samplers = Json::array()) {
    Json document = {{"asset", {{"version", "2.0"}}}, {"materials", {material}}, {"samplers", samplers}};
    for (const auto& uri : uris) {
        const std::size_t n = document.contains("images") ? document["images"].size() : 0;
        document["images"].push_back({{"uri", uri}});
        document["textures"].push_back({{"source", n}});
        if (!samplers.empty()) document["textures"].back()["sampler"] = 0;
    }
    Scene scene;
    auto own = std::make_shared<Document>();
    own->json = document.dump();
    own->name = "test.gltf";
    scene.documents.push_back(own);
    scene.materials.emplace_back();
    scene.materials[0].document = scene.materials[0].index = 0;
    return scene;
}

MaterialLook look_of(const Scene& scene, std::vector<Diagnostic>* warnings = nullptr) {
    std::vector<Diagnostic> own;
    io::MaterialResolver reader;
    const auto materials = reader.materials(scene, warnings ? *warnings : own);
    REQUIRE(materials->size() == 1);
    return materials->front();
}

const Json red_texture = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};

} // namespace

TEST_CASE("a look has the textures of its material", "[io]") {
    const Json material = {
        {"pbrMetallicRoughness",
         {{"baseColorTexture",
           {{"index", 0},
            {"texCoord", 1},
            {"extensions",
             {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"texCoord", 2}}}}}}}}},
        {"normalTexture", {{"index", 1}, {"scale", 0.5}}},
        {"occlusionTexture", {{"index", 1}, {"strength", 0.25}}},
        {"emissiveFactor", {0.5, 1, 0}},
        {"extensions",
         {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
          {"KHR_materials_unlit", Json::object()}}},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.25}};
    const Json sampler = {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}};
    const MaterialLook look = look_of(scene_with(
        material, {data_uri(test::red_png()), data_uri(test::blue_png())}, Json::array({sampler})));
    REQUIRE(look.base_texture);
    CHECK(look.base_texture.image->srgb);
    CHECK(look.base_texture.image->levels[0].rgba == std::vector<std::uint8_t>{255, 16, 16, 255});
    CHECK(look.base_texture.set == 2);
    CHECK(look.base_texture.wrap_u == TextureWrap::clamp);
    CHECK(look.base_texture.wrap_v == TextureWrap::mirror);
    CHECK(look.base_texture.nearest);
    CHECK(look.base_texture.transform == std::array<double, 6>{2, 0, 0.5, 0, 3, 0.25});
    REQUIRE(look.normal_texture);
    CHECK_FALSE(look.normal_texture.image->srgb);
    CHECK(look.normal_texture.image == look.occlusion_texture.image); // decoded once
    CHECK(look.normal_scale == 0.5f);
    CHECK(look.occlusion_strength == 0.25f);
    CHECK(look.emissive == std::array<float, 3>{2, 4, 0});
    CHECK(look.alpha == MaterialLook::Alpha::mask);
    CHECK(look.cutoff == 0.25f);
    CHECK(look.unlit);
}

TEST_CASE("a texture that cannot be drawn is a warning, and the plain colour", "[io]") {
    const auto warned = [](const Scene& scene) {
        std::vector<Diagnostic> warnings;
        CHECK_FALSE(look_of(scene, &warnings).base_texture);
        std::string text;
        for (const auto& w : warnings) text += w.id + " " + w.message + " | " + w.hint;
        return text;
    };
    CHECK(warned(scene_with(red_texture, {data_uri("no image at all")}))
              .starts_with("W-TEXTURE images[0]: not drawn: it is broken"));
    CHECK(
        warned(scene_with(red_texture, {data_uri(test::red_png().substr(0, 50))})).starts_with("W-TEXTURE"));
    // An image with a header for 16384 x 16384 pixels and no data.
    std::string huge = test::red_png();
    huge.replace(16, 8, std::string("\0\0\x40\0\0\0\x40\0", 8));
    const std::string told = warned(scene_with(red_texture, {data_uri(huge)}));
    CHECK(told.starts_with("W-TEXTURE images[0]: not drawn: "));
    CHECK(told.ends_with("; the plain colour is drawn instead"));
    CHECK(warned(scene_with(red_texture, {})).starts_with("W-TEXTURE not drawn: "));
    CHECK(warned(scene_with(red_texture, {"missing.png"})).empty()); // the reader has already warned
    Scene compressed = scene_with(red_texture, {data_uri(test::red_png())});
    auto document = std::make_shared<Document>(*compressed.documents[0]);
    document->json = Json::parse(document->json)
                         .patch(Json::parse(R"([{"op": "remove", "path": "/textures/0/source"}])"))
                         .dump();
    compressed.documents[0] = document;
    CHECK(warned(compressed).find("of an unsupported kind") != std::string::npos);
}

TEST_CASE("a material that nothing would be seen of is drawn", "[io]") {
    Scene scene = scene_with({{"alphaMode", "BLEND"}}, {});
    CHECK(look_of(scene).alpha == MaterialLook::Alpha::blend);
    scene.materials[0].base_colour[3] = 0;
    CHECK(look_of(scene).alpha == MaterialLook::Alpha::opaque);
}

TEST_CASE("each image is decoded once, and told once", "[io]") {
    const Scene scene = scene_with(red_texture, {data_uri(test::red_png())});
    const Scene broken = scene_with(red_texture, {data_uri("x")});
    io::MaterialResolver reader;
    std::vector<Diagnostic> warnings;
    const auto first = reader.materials(scene, warnings), second = reader.materials(scene, warnings);
    CHECK(first->front().base_texture.image == second->front().base_texture.image);
    for (int i = 0; i < 2; ++i) reader.materials(broken, warnings);
    CHECK(warnings.size() == 1);
}

TEST_CASE("images of documents that are gone do not count", "[io]") {
    const Scene one = scene_with(red_texture, {data_uri(test::red_png())});
    const Scene other = scene_with(red_texture, {data_uri(test::blue_png())});
    io::MaterialResolver reader(4); // bytes: one pixel
    std::vector<Diagnostic> warnings;
    std::weak_ptr<const TextureImage> image = reader.materials(one, warnings)->front().base_texture.image;
    CHECK_FALSE(image.expired());
    CHECK(reader.materials(other, warnings)->front().base_texture);
    CHECK(image.expired());
    CHECK(warnings.empty());
    io::MaterialResolver small(3);
    CHECK_FALSE(small.materials(one, warnings)->front().base_texture);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].message.find("take more than") != std::string::npos);
    // The size is checked before the pixels, which are broken here.
    const std::string png = test::red_png();
    warnings.clear();
    small.materials(scene_with(red_texture, {data_uri(png.substr(0, png.size() - 20))}), warnings);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].message.find("take more than") != std::string::npos);
}

TEST_CASE("a number of texture coordinates beyond all sets is not the first", "[io]") {
    const Json material = {
        {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 256}}}}}};
    CHECK(look_of(scene_with(material, {data_uri(test::red_png())})).base_texture.set == 255);
}
