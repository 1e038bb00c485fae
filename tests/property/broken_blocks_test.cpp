// Repairs admesh's blocks, each broken in a different way. Needs a folder with them in FACETMILL_CORPUS.
#include "support/catch.hpp"
#include "support/corpus.hpp"

#include "geometry/clean/clean.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/orient/orient.hpp"

#include <cmath>
#include <cstdio>

using namespace facetmill;

TEST_CASE("admesh's broken blocks come out good", "[property]") {
    const auto folder = test::corpus();
    if (!folder) return;
    constexpr double side = 3.937008; // of the good block
    std::size_t repaired = 0;
    for (const auto& file : test::meshes_below(*folder)) {
        const std::string name = file.stem().string();
        if (!name.starts_with("block-")) continue;
        CAPTURE(name);
        const Scene scene = test::read_or_nothing(file);
        REQUIRE(scene.parts.size() == 1);
        const Mesh& mesh = scene.parts[0].mesh;
        CleanSettings settings;
        settings.holes = HoleSettings{};
        settings.components = ComponentSettings{.keep = 1};
        settings.weld = Nearness::near;
        settings.tolerance = 0.05 * mesh.bounds().diagonal();
        const Properties before = inspect(mesh);
        const Mesh good = orient(clean(mesh, settings).mesh, {}).mesh;
        const Properties after = inspect(good, {.self_intersections = true});
        CHECK((after.closed && after.oriented && after.edge_manifold && after.vertex_manifold));
        CHECK(after.faces == 12);
        CHECK(after.euler == 2);
        CHECK(after.components == 1);
        CHECK(after.degenerate_faces == 0);
        CHECK(after.self_intersections == 0);
        // A corner that was a little off stays a little off.
        CHECK(std::abs(after.volume.value_or(0) - side * side * side) < 0.02 * side * side * side);
        repaired += name.ends_with("-bad") && !(before.closed && before.oriented);
    }
    std::printf("clean and orient repaired %zu of admesh's blocks\n", repaired);
}
