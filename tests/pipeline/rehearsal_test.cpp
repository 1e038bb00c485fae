// Checks that plan lists exactly the files that run writes, even if stages change the images of a mesh.
#include "pipeline/rehearsal.hpp"

#include "pipeline/run.hpp"
#include "support/catch.hpp"
#include "support/images.hpp"
#include "support/planning.hpp"
#include "support/temporary.hpp"

#include <algorithm>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// A picture of many colours, which WebP makes smaller, or of one, which it does not.
std::string picture(std::uint32_t side, bool plain) {
    std::string rows;
    for (std::uint32_t y = 0; y < side; ++y) {
        rows += '\0'; // no filter
        for (std::uint32_t x = 0; x < side; ++x)
            for (const std::uint32_t c : {x * 3, y * 5, x * y}) rows += static_cast<char>(plain ? 7 : c);
    }
    return png_of_rows(side, side, 8, 2, rows);
}

/// Two objects with a texture each, an unused material with a third texture, and the same as glTF.
class Textured {
  public:
    Textured() {
        put(folder_ / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\n"
                               "vt 0 0\nvt 1 0\nvt 0 1\no left\nusemtl fine\nf 1/1 2/2 3/3\n"
                               "o right\nusemtl plain\nf 4/1 5/2 6/3\n");
        put(folder_ / "a.mtl", "newmtl fine\nmap_Kd fine.png\nnewmtl plain\nmap_Kd plain.png\n"
                               "newmtl idle\nmap_Kd idle.png\n");
        put(folder_ / "fine.png", picture(64, false));
        put(folder_ / "plain.png", picture(8, true));
        put(folder_ / "idle.png", picture(16, false));
        run("load: a.obj", "write: b.gltf", folder_.path());
    }

    /// The names that plan lists, and the names that run writes.
    std::pair<std::vector<std::string>, std::vector<std::string>> both(const std::string& load,
                                                                       const std::string& rest) const {
        const TemporaryDirectory out;
        const auto plan = plan_of(load, rest, out.path());
        std::vector<std::string> names;
        for (const auto& path : pipeline::planned_outputs(plan, pipeline::rehearsed_headers(plan)))
            names.push_back(path.lexically_relative(out.path()).string());
        std::sort(names.begin(), names.end());
        CHECK(out.names().empty()); // planning writes nothing
        run(load, rest, out.path());
        return {names, out.names()};
    }

  private:
    pipeline::Plan plan_of(const std::string& load, const std::string& rest,
                           const std::filesystem::path& out) const {
        pipeline::PlanSettings settings;
        settings.places = {folder_.path(), out};
        auto result = planned_stages("  - " + load + "\n  - " + rest + "\n", settings);
        if (!result.problems.empty()) FAIL(result.problems);
        return std::move(result.plan);
    }
    void run(const std::string& load, const std::string& rest, const std::filesystem::path& out) const {
        const auto record = pipeline::run_plan(plan_of(load, rest, out), {});
        for (const auto& error : record.errors) UNSCOPED_INFO(render(error));
        REQUIRE(record.exit_code == 0);
    }

    TemporaryDirectory folder_;
};

} // namespace

TEST_CASE("plan lists the files that run writes, whatever becomes of images", "[pipeline][textures]") {
    const Textured ground;
    for (const char* load : {"load: a.obj", "load: b.gltf"})
        for (const char* rest :
             {"write: c.gltf", "write: c.obj", "write: c.glb", "optimize\n  - write: c.gltf",
              "optimize\n  - write: c.obj", "optimize: {palette: true}\n  - write: c.gltf",
              "textures: {format: webp}\n  - write: c.gltf",
              "textures: {format: webp}\n  - optimize\n  - write: {path: c.gltf, draco: true}",
              "textures: {max_size: 32}\n  - write: {path: c.glb, textures: reference}",
              "textures: {max_size: 32}\n  - write: {path: c.gltf, textures: reference}",
              "textures: {format: webp, max_size: 16}\n  - write: {path: c.glb, textures: copy}",
              "textures: {format: jpeg}\n  - write: c.obj", "clip: x=3\n  - optimize\n  - write: c.gltf",
              "optimize\n  - write: c.gltf\n  - textures: {format: webp}\n  - write: d.gltf",
              "foreach: {size: [32, 8]}\n    do: [{textures: \"${size}\"}, {write: \"${size}.gltf\"}]",
              "textures: {format: webp}\n    when: {faces: {min: 1000}}\n  - write: c.gltf"}) {
            INFO(load << "\n" << rest);
            const auto [names, written] = ground.both(load, rest);
            CHECK(names == written);
        }
}

TEST_CASE("a plan that cannot be rehearsed lists the images as they came", "[pipeline][textures]") {
    const Textured ground;
    const TemporaryDirectory out;
    pipeline::PlanSettings settings;
    settings.places = {out.path(), out.path()};
    const auto plan =
        planned_stages("  - load: gone.gltf\n  - textures: {format: webp}\n  - write: c.gltf\n", settings)
            .plan;
    const auto outputs = pipeline::planned_outputs(plan, pipeline::rehearsed_headers(plan));
    CHECK(outputs == std::vector<std::filesystem::path>{out / "c.gltf", out / "c.bin"});
}
