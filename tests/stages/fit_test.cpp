#include "io/images/encode_image.hpp"
#include "io/images/png.hpp"
#include "stages/fit/model.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <cmath>
#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

std::size_t bytes_of(const StageRun& run) {
    std::size_t bytes = 0;
    for (const auto& file : run.state->outputs.files()) bytes += file->stream.size();
    return bytes;
}

StageRun fitted(const std::string& options, Scene scene) {
    return run_stage("fit", "{path: '-', pixels: 48, " + options + "}", std::move(scene));
}

/// A bumpy sphere, so that triangles matter.
Scene bumpy() {
    Mesh mesh = shapes::icosphere(4);
    for (Vec3& p : mesh.positions) {
        const double bump = 1 + 0.1 * std::sin(9 * p.x) * std::sin(7 * p.y) * std::sin(8 * p.z);
        p = p * bump;
    }
    return scene_of(std::move(mesh));
}

/// A triangle with an image of noise.
Scene textured() {
    io::Pixels image{128, 128, {}, false};
    for (std::size_t i = 0; i < 128 * 128; ++i)
        for (const std::size_t c : {i * 7 % 251, i * i % 239, i * 31 % 211, std::size_t{255}})
            image.rgba.push_back(static_cast<std::uint8_t>(c));
    const io::Bytes png = io::encoded_png(image);
    return read_text(
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],
"images":[{"uri":"data:image/png;base64,)" +
        io::base64(png) + R"("}]})");
}

} // namespace

TEST_CASE("fit writes less than the budget, and a larger budget looks better", "[stages]") {
    double similarity = 0;
    for (const std::size_t budget : {2500, 5000, 10000}) {
        const StageRun run = fitted(fmt::format("budget: {}", budget), bumpy());
        INFO(budget);
        CHECK(run.state->record.checks.empty());
        CHECK(bytes_of(run) > budget / 2);
        CHECK(bytes_of(run) <= budget);
        CHECK(run.record.result["bytes"] == bytes_of(run));
        CHECK(run.record.result["similarity"].get<double>() > similarity);
        similarity = run.record.result["similarity"].get<double>();
        CHECK(run.scene.face_count() == 5120); // the scene passes on unchanged
    }
}

TEST_CASE("fit keeps everything if the budget suffices", "[stages]") {
    const StageRun run = fitted("budget: 1MB", bumpy());
    CHECK(run.record.result["keep"] == 1.0);
    CHECK(run.record.result["trials"] == 1);
    CHECK(run.record.result["triangles"] == 5120);
}

TEST_CASE("fit names the least size if nothing fits, and writes nothing", "[stages]") {
    const StageRun run = fitted("budget: 300", bumpy());
    REQUIRE(run.state->record.checks.size() == 1);
    const report::Check& check = run.state->record.checks[0];
    CHECK(check.name == "budget");
    CHECK_FALSE(check.passed);
    CHECK(std::get<std::int64_t>(check.found) > 300);
    CHECK(check.hint.find("budget: ") != std::string::npos);
    CHECK(run.state->outputs.files().empty());
    CHECK(run.record.result["written"] == false);
    const std::string hint = check.hint.substr(check.hint.find("budget: "));
    CHECK(fitted(hint, bumpy()).state->record.checks.empty()); // the hint works when followed
}

TEST_CASE("fit finds fewer bytes for a larger difference", "[stages]") {
    const StageRun close = fitted("look: 0.5%", bumpy()), far = fitted("look: 3%", bumpy());
    CHECK(close.state->record.checks.empty());
    CHECK(close.record.result["difference"].get<double>() <= 0.5);
    CHECK(far.record.result["difference"].get<double>() <= 3);
    CHECK(bytes_of(far) < bytes_of(close));
}

TEST_CASE("fit with look and budget fails if the smallest file is too large", "[stages]") {
    const StageRun run = fitted("look: 0.5%, budget: 1000", bumpy());
    REQUIRE(run.state->record.checks.size() == 1);
    CHECK(run.state->record.checks[0].name == "budget");
    CHECK(run.state->outputs.files().empty());
}

TEST_CASE("fit makes images smaller when they are most of the bytes", "[stages]") {
    double similarity = 0;
    for (const std::size_t budget : {4000, 7000, 12000}) {
        INFO(budget);
        const StageRun run = fitted(fmt::format("budget: {}", budget), textured());
        CHECK(run.state->record.checks.empty());
        CHECK(bytes_of(run) <= budget);
        CHECK(run.record.result["similarity"].get<double>() >= similarity);
        similarity = run.record.result["similarity"].get<double>();
        REQUIRE(run.record.result.contains("colours"));
        CHECK(run.record.result["colours"]["max_size"].get<int>() <= 128);
        CHECK(run.record.result["keep"] == 1.0);
    }
}

TEST_CASE("fit takes point clouds and scenes without faces", "[stages]") {
    Mesh points;
    for (int i = 0; i < 200; ++i) points.positions.push_back({i % 7 * 0.1, i % 11 * 0.2, i % 13 * 0.3});
    const StageRun run = fitted("budget: 100kB", scene_of(std::move(points)));
    CHECK(run.state->record.checks.empty());
    CHECK(bytes_of(run) <= 100000);
}

TEST_CASE("fit refuses a missing, empty or ambiguous target, and other formats", "[stages]") {
    const auto problems = [](std::vector<std::pair<std::string, std::string>> given) {
        return problems_of("fit", options(std::move(given)));
    };
    CHECK(problems({{"path", "a.glb"}}).starts_with("E-MISSING"));
    // A pipeline may pass both on and skip the stage.
    CHECK(problems({{"path", "a.glb"}, {"budget", "off"}, {"look", "off"}}).empty());
    CHECK(failure([] {
              run_stage("fit", "{path: a.glb, budget: off, look: off}", scene_of(shapes::cube()));
          }).find("E-MISSING") != std::string::npos);
    CHECK(problems({{"path", "a.glb"}, {"budget", "0"}}).starts_with("E-RANGE"));
    CHECK(problems({{"path", "a.glb"}, {"look", "0%"}}).starts_with("E-RANGE"));
    CHECK(problems({{"path", "a.ply"}, {"budget", "1MB"}}).starts_with("E-FORMAT"));
    CHECK(problems({{"path", "a.glb"}, {"budget", "500kB"}}).empty());
    CHECK(problems({{"path", "a.gltf"}, {"budget", "500kB"}, {"look", "off"}}).empty());
}

TEST_CASE("The model finds the best choice of the measured curves", "[stages]") {
    fit_stage::Curves curves;
    curves.ratios = {{1, {1000, 0}}, {0.5, {500, 0.01}}, {0.25, {250, 0.04}}};
    curves.position = {{16, 0, 0}, {10, 0.2, 0.001}};
    curves.normal = {{12, 0, 0}};
    curves.uv = {{14, 0, 0}};
    curves.colours = {{{}, {600, 0}}, {{256, 80}, {500, 0.0001}}};
    curves.normals = {{{}, {0, 0}}};
    const fit_stage::Model model(curves, 1);
    const auto whole = model.best_within(1600);
    REQUIRE(whole);
    CHECK(*whole == fit_stage::Choice{});
    const auto near = model.best_within(1500); // smaller images change least
    REQUIRE(near);
    CHECK(near->colours == fit_stage::ImageChoice{256, 80});
    CHECK(near->keep == 1);
    CHECK(near->bits.position == 16);
    CHECK_FALSE(model.best_within(650));
    CHECK(model.smallest().keep == 0.25);
    const auto alike = model.smallest_within(0.0005);
    REQUIRE(alike);
    CHECK(alike->colours == fit_stage::ImageChoice{256, 80});
    CHECK_FALSE(model.smallest_within(-1));
}
