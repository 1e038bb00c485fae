#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/mutations.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

struct Sample {
    std::string name;
    io::Bytes bytes;
};

/// A small file of every format that is written, in every encoding that it has.
std::vector<Sample> samples() {
    Scene scene;
    scene.parts.emplace_back().mesh = shapes::uv_cube();
    scene.parts.back().name = "cube";
    scene.materials.emplace_back().name = "red";
    scene.parts.back().mesh.primitives = {{0, {}, {}}};
    std::vector<Sample> all;
    for (const auto& codec : io::codecs()) {
        if (!codec.write || !codec.read) continue;
        for (const auto& settings :
             {io::WriteSettings{.title = "a"}, io::WriteSettings{.ascii = true, .title = "a"},
              io::WriteSettings{.big_endian = true, .title = "a"}})
            all.push_back(
                {"a." + codec.extensions.front(), codec.write(scene, settings).files.front().bytes});
    }
    scene.parts.back().mesh.drop("NORMAL", Domain::wedge);
    all.push_back({"a.ply", io::codec_named("ply")->write(scene, {.title = "a"}).files.front().bytes});
    return all;
}

} // namespace

TEST_CASE("damaged files are refused or read as sound meshes", "[io]") {
    for (const auto& sample : samples())
        for (std::uint64_t seed = 0; seed < 300; ++seed) {
            const std::string trouble = trouble_reading(sample.name, mutated(sample.bytes, seed));
            if (!trouble.empty()) FAIL_CHECK(sample.name << ", seed " << seed << ": " << trouble);
        }
    SUCCEED("no damage got through");
}

TEST_CASE("a file cut anywhere is refused or read as a sound mesh", "[io]") {
    for (const auto& sample : samples())
        for (std::size_t size = 0; size < sample.bytes.size(); size += 1 + sample.bytes.size() / 200) {
            const auto end = sample.bytes.begin() + static_cast<std::ptrdiff_t>(size);
            const std::string trouble = trouble_reading(sample.name, {sample.bytes.begin(), end});
            if (!trouble.empty()) FAIL_CHECK(sample.name << " cut at " << size << ": " << trouble);
        }
    SUCCEED("no cut got through");
}
