#include "cells/hierarchy/hierarchy.hpp"

#include "geometry/deviation/deviation.hpp"
#include "io/outputs/outputs.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/meshes.hpp"
#include "support/surface.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

constexpr std::uint64_t ample = std::uint64_t{1} << 30;

std::filesystem::path ply_of(const test::TemporaryDirectory& folder, const Mesh& mesh) {
    Scene scene;
    scene.parts.emplace_back().mesh = mesh;
    const auto path = folder / "m.ply";
    io::write_now(path, io::codec_for(path)->write(scene, {.double_positions = true}).files.front().bytes);
    return path;
}

HierarchyResult in_cells(const std::filesystem::path& path, std::size_t faces, std::uint64_t most,
                         std::uint64_t memory = ample) {
    const CellResources means{path.parent_path(), memory};
    const Partition partition(open_faces({path}, {}, path.parent_path()), means, most);
    SimplifySettings settings;
    settings.faces = faces;
    return simplify_cells(partition, settings, means);
}

} // namespace

TEST_CASE("closed stays closed and manifold whatever the cells", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto sphere = ply_of(folder, test::noisy_icosphere(5, 0.02, 7));
    for (const std::uint64_t most : {40, 200, 1500, 100000})
        for (const std::size_t faces : {std::size_t{4000}, std::size_t{500}, std::size_t{60}}) {
            const HierarchyResult r = in_cells(sphere, faces, most);
            CHECK(test::sound(r.mesh, 2));
            CHECK(r.mesh.face_count() <= faces);
            CHECK(r.mesh.face_count() + 2 >= faces);
            CHECK(r.error > 0);
        }
    const auto torus = ply_of(folder, test::noisy_torus(150, 60, 0.002, 3));
    for (const std::uint64_t most : {60, 700}) CHECK(test::sound(in_cells(torus, 800, most).mesh, 0));
}

TEST_CASE("open borders and non-manifold places stay as in memory", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh grid = test::with_noise(shapes::grid(60, 60), 0.2, 5);
    const HierarchyResult r = in_cells(ply_of(folder, grid), 600, 100);
    const test::Counts counts = test::count(r.mesh);
    CHECK(counts.euler == 1);
    CHECK(counts.crowded + counts.pinched + counts.duplicates == 0);
    CHECK(r.mesh.face_count() <= 600);

    Mesh pinched = test::noisy_icosphere(3, 0.01, 1); // two spheres that share a vertex
    Mesh other = test::moved(pinched, {3, 0, 0});
    const Index shared = 0, first = static_cast<Index>(pinched.vertex_count());
    append(pinched, other);
    for (Index& c : pinched.corners)
        if (c == first + shared) c = shared;
    drop_unused(pinched);
    const std::size_t before = test::count(pinched).pinched;
    CHECK(before == 1);
    CHECK(test::count(in_cells(ply_of(folder, pinched), 600, 100).mesh).pinched == before);
}

TEST_CASE("the result of cells is as near to the mesh as that in memory", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = test::noisy_icosphere(6, 0.004, 7);
    SimplifySettings settings;
    settings.faces = 3000;
    const Mesh whole = simplify(mesh, settings).mesh;
    const HierarchyResult r = in_cells(ply_of(folder, mesh), 3000, 4000);
    CHECK(r.cells > 16);
    CHECK(r.levels >= 3);
    const DeviationResult of_cells = deviation(mesh, r.mesh), of_whole = deviation(mesh, whole);
    CHECK(of_cells.rms() <= 1.1 * of_whole.rms());
    CHECK(of_cells.maximum() <= 1.5 * of_whole.maximum());
}

TEST_CASE("the result depends on the mesh and the target alone", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = ply_of(folder, test::noisy_torus(150, 60, 0.002, 3));
    const Mesh one = in_cells(path, 900, 300).mesh;
    CHECK(test::same(one, in_cells(path, 900, 300, std::uint64_t{40} << 20).mesh));
    const int before = threads();
    for (const int count : {1, 2, 5}) {
        set_threads(count);
        CHECK(test::same(one, in_cells(path, 900, 300).mesh));
    }
    set_threads(before);
}

TEST_CASE("what cannot be done in cells is refused by name", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = ply_of(folder, test::noisy_icosphere(5, 0.02, 7));
    CHECK(test::failure_id([&] { in_cells(path, 10000, 100, std::uint64_t{20} << 20); }) == "E-MEMORY");
    SimplifySettings settings;
    CHECK_FALSE(why_not_in_cells(settings));
    settings.max_error = 1;
    CHECK(why_not_in_cells(settings)->find("max_error") == 0);
    settings = {};
    settings.method = SimplifySettings::Method::cluster;
    CHECK(why_not_in_cells(settings));
    settings = {};
    settings.levels = {0.5};
    CHECK(why_not_in_cells(settings)->find("lods") == 0);
}
