#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include "base/math/portable_math.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/numbers/quantise.hpp"
#include "io/images/png.hpp"

#include <cmath>
#include <fmt/format.h>

namespace optimize_keys_test {

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// A track: a property of node 0, its times, and its values.
struct Track {
    std::string path;
    std::vector<float> times, values;
    std::string interpolation = "LINEAR";
};

/// A triangle one unit from node 0, which the tracks move.
std::string moving(const std::vector<Track>& tracks) {
    std::vector<float> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0};
    Json json = Json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
        "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
        "animations":[{"channels":[],"samplers":[]}]})");
    const auto add = [&](const std::vector<float>& values, const char* type, std::size_t width) {
        json["accessors"].push_back({{"bufferView", 0},
                                     {"byteOffset", numbers.size() * sizeof(float)},
                                     {"componentType", 5126},
                                     {"count", values.size() / width},
                                     {"type", type}});
        if (width == 1) {
            json["accessors"].back()["min"] = Json::array({values.front()});
            json["accessors"].back()["max"] = Json::array({values.back()});
        }
        numbers.insert(numbers.end(), values.begin(), values.end());
        return json["accessors"].size() - 1;
    };
    Json& animation = json["animations"][0];
    for (const Track& track : tracks) {
        const std::size_t input = add(track.times, "SCALAR", 1);
        const bool turn = track.path == "rotation";
        const std::size_t output = add(track.values, turn ? "VEC4" : "VEC3", turn ? 4 : 3);
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size()}, {"target", {{"node", 0}, {"path", track.path}}}});
        animation["samplers"].push_back(
            {{"input", input}, {"output", output}, {"interpolation", track.interpolation}});
    }
    const auto bytes = std::as_bytes(std::span(numbers));
    json["bufferViews"] = Json::array({{{"buffer", 0}, {"byteLength", bytes.size()}}});
    json["buffers"] = Json::array({{{"byteLength", bytes.size()},
                                    {"uri", "data:application/octet-stream;base64," + io::base64(bytes)}}});
    return json.dump();
}

std::vector<float> seconds(std::size_t keys, double rate) {
    std::vector<float> times;
    times.reserve(keys);
    for (std::size_t k = 0; k < keys; ++k) times.push_back(static_cast<float>(static_cast<double>(k) / rate));
    return times;
}

/// A turn about z by this angle at each key.
std::vector<float> turns(std::size_t keys, const std::function<double(std::size_t)>& angle) {
    std::vector<float> values;
    for (std::size_t k = 0; k < keys; ++k)
        for (const double x : {0.0, 0.0, sine(angle(k) / 2), cosine(angle(k) / 2)})
            values.push_back(static_cast<float>(x));
    return values;
}

/// The numbers of the keys of a track after the stage.
std::vector<float> numbers_after(const Scene& scene, std::size_t sampler, const char* which) {
    const Json json = Json::parse(scene.documents.at(0)->json);
    io::gltf::Source source(json, scene.documents[0]->buffers);
    const Json reference = json["animations"][0]["samplers"][sampler][which];
    const auto data =
        io::gltf::decode(source, io::gltf::accessor(source, io::gltf::JsonCursor(reference, "reference")));
    return std::get<std::vector<float>>(data);
}

} // namespace

TEST_CASE("keys that interpolation gives anyway are dropped", "[stages]") {
    const Track steady{"rotation", seconds(61, 60),
                       turns(61, [](std::size_t k) { return 0.01 * double(k); })};
    const auto run = run_stage("optimize", "{max_motion: 0.01%}", read_text(moving({steady})));
    CHECK(run.record.result["keys"]["before"] == 61);
    CHECK(run.record.result["keys"]["after"] == 2);
    CHECK(numbers_after(run.scene, 0, "input") == std::vector<float>{0, 1});
    std::vector<float> ends(steady.values.begin(), steady.values.begin() + 4);
    ends.insert(ends.end(), steady.values.end() - 4, steady.values.end());
    CHECK(numbers_after(run.scene, 0, "output") == ends);
}

TEST_CASE("what the dropped keys move stays within the ratio", "[stages]") {
    const std::size_t keys = 241;
    const auto angle = [](std::size_t k) { return 0.6 * sine(0.05 * static_cast<double>(k)); };
    const Track swing{"rotation", seconds(keys, 60), turns(keys, angle)};
    for (const double ratio : {0.01, 0.001}) {
        const auto run = run_stage("optimize", fmt::format("{{max_motion: {}%}}", 100 * ratio),
                                   read_text(moving({swing})));
        const auto times = numbers_after(run.scene, 0, "input"),
                   values = numbers_after(run.scene, 0, "output");
        CHECK(times.size() < keys / 2);
        CHECK(times.back() == swing.times.back());
        double most = 0;
        std::size_t at = 0;
        for (std::size_t k = 0; k < keys; ++k) {
            while (at + 2 < times.size() && times[at + 1] <= swing.times[k]) ++at;
            const double t = (swing.times[k] - times[at]) / double(times[at + 1] - times[at]);
            const auto angle_at = [&](std::size_t i) {
                return 2 * arc_tangent(values[4 * i + 2], values[4 * i + 3]);
            };
            const double between = (1 - t) * angle_at(at) + t * angle_at(at + 1);
            most = std::max(most, std::abs(between - angle(k)));
        }
        // The triangle reaches to 1 from the node; its diagonal is the root of two.
        CHECK(most <= ratio * std::sqrt(2.0) + 1e-6);
        CHECK(most <= 0.1 * pi / 180 + 1e-6); // however little is moved
        CHECK(most > 0);
    }
}

TEST_CASE("constant tracks get one key, and the animation stays as long", "[stages]") {
    std::vector<float> still;
    for (int k = 0; k < 31; ++k) still.insert(still.end(), {1, 2, 3});
    const Track constant{"translation", seconds(31, 30), still};
    auto run = run_stage("optimize", "{max_motion: 0.01%}", read_text(moving({constant})));
    CHECK(numbers_after(run.scene, 0, "input") == std::vector<float>{1}); // keeps the length
    const Track swing{"rotation", seconds(31, 30),
                      turns(31, [](std::size_t k) { return 0.3 * double(k % 2); })};
    run = run_stage("optimize", "{max_motion: 0.01%}", read_text(moving({constant, swing})));
    CHECK(numbers_after(run.scene, 0, "input") == std::vector<float>{1});
    CHECK(numbers_after(run.scene, 0, "output") == std::vector<float>{1, 2, 3});
    CHECK(numbers_after(run.scene, 1, "input").size() == 31);
}

TEST_CASE("steps keep their times, and cubic keys stay", "[stages]") {
    std::vector<float> values;
    for (int k = 0; k < 60; ++k) values.insert(values.end(), {k < 30 ? 0.0F : 5.0F, 0, 0});
    const Track steps{"translation", seconds(60, 30), values, "STEP"};
    const auto run = run_stage("optimize", "{max_motion: 0.01%}", read_text(moving({steps})));
    CHECK(numbers_after(run.scene, 0, "input") == std::vector<float>{0, steps.times[30], steps.times[59]});
    std::vector<float> cubic;
    for (int k = 0; k < 20; ++k) cubic.insert(cubic.end(), {0, 0, 0, float(k), 0, 0, 0, 0, 0});
    const Track smooth{"translation", seconds(20, 30), cubic, "CUBICSPLINE"};
    const auto kept = run_stage("optimize", "{max_motion: 0.01%, resample: 10}", read_text(moving({smooth})));
    CHECK(numbers_after(kept.scene, 0, "input").size() == 20);
}

TEST_CASE("linear keys are resampled on request", "[stages]") {
    const Track swing{"rotation", seconds(121, 120),
                      turns(121, [](std::size_t k) { return 0.02 * double(k); })};
    const auto run = run_stage("optimize", "{resample: 10}", read_text(moving({swing})));
    const auto times = numbers_after(run.scene, 0, "input"), values = numbers_after(run.scene, 0, "output");
    REQUIRE(times.size() == 11);
    for (std::size_t k = 0; k < times.size(); ++k) {
        CHECK(times[k] == Approx(0.1 * double(k)));
        CHECK(2 * arc_tangent(values[4 * k + 2], values[4 * k + 3]) == Approx(0.24 * double(k)).margin(1e-6));
    }
}

TEST_CASE("rotations get the fewest bits that turn them by little enough", "[io]") {
    Attribute turned{"", Domain::wedge, Role::generic,
                     4,  false,         turns(100, [](std::size_t k) { return 0.037 * double(k); })};
    int before = 0;
    for (const double angle : {1e-2, 1e-3, 1e-4}) {
        const int bits = io::gltf::bits_of_turns(turned, angle);
        CHECK(bits > before);
        CHECK(bits < 16);
        before = bits;
    }
    CHECK(io::gltf::bits_of_turns(turned, 0) == 16);
}

} // namespace optimize_keys_test
