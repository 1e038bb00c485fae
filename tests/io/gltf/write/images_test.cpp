// Images that a document refers to as files: embedded in the output, copied next to it, or left in place.
#include "io/images/image_files.hpp"
#include "io/images/png.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// A textured triangle whose image is the file `uri`.
std::string triangle(const std::string& uri) {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}],
"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],
"textures":[{{"source":0}}],"images":[{{"uri":"{}"}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}}],
"bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":24}}],
"buffers":[{{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}}]}})",
        uri);
}

/// A folder with the asset and its image.
void put_asset(const std::filesystem::path& folder, const std::string& image) {
    std::filesystem::create_directories(folder / "maps");
    put(folder / "a.gltf", triangle("maps/wood%20grain.png"));
    put(folder / "maps" / "wood grain.png", image);
}

Scene load(const std::filesystem::path& path) {
    io::ReadLog log;
    Scene scene = io::read_scene(io::Input::open(path), {}, log);
    CHECK(log.warnings.empty());
    return scene;
}

/// The bytes of image 0 of a file that was read.
std::string image_of(const std::filesystem::path& path) {
    const Scene scene = load(path);
    const Document& document = *scene.documents.at(0);
    const Json json = Json::parse(document.json), image = json["images"][0];
    if (image.contains("uri")) return std::string(io::as_text(document.files.at(image["uri"])));
    const Json view = json["bufferViews"][image["bufferView"].get<std::size_t>()];
    return std::string(io::as_text(
        io::Span(document.buffers[0])
            .subspan(view.value("byteOffset", std::size_t{0}), view["byteLength"].get<std::size_t>())));
}

/// Writes the scene by the stage and commits.
StageRun write(const Scene& scene, const std::string& options) {
    StageRun run = run_stage("write", options, scene);
    run.state->outputs.commit();
    return run;
}

} // namespace

TEST_CASE("a GLB has its images in it, a .gltf beside it under its own name", "[io]") {
    const TemporaryDirectory dir;
    put_asset(dir / "in", red_png());
    const Scene scene = load(dir / "in/a.gltf");

    const io::Written glb = written(scene, "glb", {.title = "lamp"});
    REQUIRE(glb.files.size() == 1);
    const Json image = Json::parse(json_of(glb.files[0].bytes))["images"][0];
    CHECK(image["mimeType"] == "image/png");
    CHECK(image["name"] == "wood grain");
    CHECK_FALSE(image.contains("uri"));
    CHECK(image.contains("bufferView"));

    const io::Written gltf = written(scene, "gltf", {.title = "lamp"});
    REQUIRE(gltf.files.size() == 3);
    CHECK(gltf.files[2].name == "maps/lamp.wood grain.png");
    CHECK(io::as_text(gltf.files[2].bytes) == red_png());
    CHECK(Json::parse(io::as_text(gltf.files[0].bytes))["images"][0]["uri"] == "maps/lamp.wood%20grain.png");
}

TEST_CASE("two assets in one folder keep their textures, whatever their images are called", "[io]") {
    const TemporaryDirectory dir;
    put_asset(dir / "red", red_png());
    put_asset(dir / "blue", blue_png());
    for (const std::string suffix : {"glb", "gltf"})
        for (const char* textures : {"auto", "embed", "copy"}) {
            INFO(suffix << " " << textures);
            const auto out = dir / ("out_" + suffix + textures);
            for (const std::string name : {"red", "blue"})
                write(load(dir / (name + "/a.gltf")),
                      fmt::format("{{path: {}/{}.{}, textures: {}}}", out.string(), name, suffix, textures));
            std::filesystem::rename(out, dir / "elsewhere");
            CHECK(image_of(dir / ("elsewhere/red." + suffix)) == red_png());
            CHECK(image_of(dir / ("elsewhere/blue." + suffix)) == blue_png());
            std::filesystem::remove_all(dir / "elsewhere");
        }
}

TEST_CASE("images may stay where the input has them", "[io]") {
    const TemporaryDirectory dir;
    put_asset(dir / "in", red_png());
    const Scene scene = load(dir / "in/a.gltf");
    write(scene, fmt::format("{{path: {}/out/deep/b.glb, textures: reference}}", dir.path().string()));
    CHECK(dir.names() == std::vector<std::string>{"in", "in/a.gltf", "in/maps", "in/maps/wood grain.png",
                                                  "out", "out/deep", "out/deep/b.glb"});
    const std::string glb = get(dir / "out/deep/b.glb");
    CHECK(Json::parse(json_of(to_bytes(glb)))["images"][0]["uri"] == "../../in/maps/wood%20grain.png");
}

TEST_CASE("an image whose file is no longer what was read is copied and not named", "[io]") {
    const TemporaryDirectory dir;
    put_asset(dir / "in", red_png());
    const Scene scene = load(dir / "in/a.gltf");
    put(dir / "in" / "maps" / "wood grain.png", blue_png());
    write(scene, fmt::format("{{path: {}/out/b.glb, textures: reference}}", dir.path().string()));
    CHECK(image_of(dir / "out/b.glb") == red_png());
}

TEST_CASE("an image that would replace another output of the run is an error", "[io]") {
    const TemporaryDirectory dir;
    put_asset(dir / "red", red_png());
    RunState state;
    state.outputs.add(dir / "out/maps/lamp.wood grain.png", bytes_of("not an image"));
    Problems problems;
    const Value value = Value::scalar((dir / "out/lamp.gltf").string());
    const auto stage = use_of(stage_for_test("write"), value, problems);
    report::StageRecord record;
    const PartFilter all;
    const Scene scene = load(dir / "red/a.gltf");
    Context context(state, record, all, scene.bounds(), {});
    CHECK(failure([&] { perform(*stage, scene, context); }).find("[E-DUPLICATE-OUTPUT]") !=
          std::string::npos);
}

TEST_CASE("an image that is missing is said, and what cannot be embedded is copied", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a.gltf", triangle("gone.png"));
    io::ReadLog log;
    const Scene scene = io::read_scene(io::Input::open(dir / "a.gltf"), {}, log);
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].id == "W-IMAGE");
    CHECK(written(scene, "glb").warnings.at(0).id == "W-IMAGE");

    put(dir / "b.gltf", triangle("b.tga"));
    put(dir / "b.tga", "no known kind of image");
    const io::Written other = written(load(dir / "b.gltf"), "glb");
    REQUIRE(other.files.size() == 2);
    CHECK(other.files[1].name == "out.b.tga");
    CHECK(other.warnings.at(0).id == "W-IMAGE");
}

TEST_CASE("a broken image is told where it is written, once", "[io]") {
    const TemporaryDirectory dir;
    const std::string cut = red_png().substr(0, red_png().size() - 6);
    const auto told = [&](const std::string& uri, const char* format, const std::string& options = {}) {
        put(dir / "a.gltf", triangle(uri));
        const Scene scene = load(dir / "a.gltf");
        if (!options.empty()) return write(scene, options).warnings();
        std::vector<std::string> all;
        for (const Diagnostic& d : written(scene, format).warnings) all.push_back(d.id + ": " + d.message);
        return all;
    };
    const std::vector<std::string> once{"W-IMAGE: the image \"wood.png\" is written unchanged, but viewers "
                                        "cannot show it: its data end early"};
    put(dir / "wood.png", cut);
    CHECK(told("wood.png", "glb") == once);
    CHECK(told("wood.png", "gltf") == once);
    CHECK(
        told("wood.png", "", fmt::format("{{path: {}/out/b.glb, textures: reference}}", dir.path().string()))
            .empty()); // not written
    const std::string base = io::base64(io::bytes_of_text(cut));
    for (const char* format : {"glb", "gltf"})
        CHECK(told("data:image/png;base64," + base, format).size() == 1);
    put(dir / "wood.png", red_png());
    CHECK(told("wood.png", "glb").empty());
    // ... and where it was embedded before.
    put(dir / "wood.png", cut);
    put(dir / "a.gltf", triangle("wood.png"));
    put(dir / "b.glb", std::string(io::as_text(written(load(dir / "a.gltf"), "glb").files.at(0).bytes)));
    CHECK(written(load(dir / "b.glb"), "gltf").warnings.size() == 1);
}

TEST_CASE("names of images beside an output begin with its stem, once each", "[io]") {
    io::ImageNames names("lamp");
    CHECK(names.add("wood.png") == "lamp.wood.png");
    CHECK(names.add("WOOD.png") == "lamp.WOOD.2.png");
    CHECK(names.add("lamp.wood.png") == "lamp.wood.3.png");
    CHECK(names.add("maps/wood.png") == "maps/lamp.wood.png");
    CHECK(names.add("bin") == "lamp.2.bin");
}
