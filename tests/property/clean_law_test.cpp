// Checks the guarantees of clean on generated meshes, and on a corpus of real meshes if FACETMILL_CORPUS is
// set.
#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/corpus.hpp"
#include "support/meshes.hpp"

#include "io/codec.hpp"

#include <cstdio>

using namespace facetmill;
using namespace facetmill::test;
using test::broken_clean_law;

namespace {

std::vector<std::pair<std::string, CleanSettings>> all_settings(double diagonal) {
    CleanSettings plain, off, near, holes, smooth, solid, all;
    off.weld = off.t_junctions = Nearness::off;
    off.degenerate = off.duplicates = off.non_manifold = off.isolated = false;
    near.weld = near.stitch = near.t_junctions = Nearness::near;
    near.tolerance = 1e-3 * diagonal;
    holes.holes = HoleSettings{};
    smooth.holes = HoleSettings{HoleFill::smooth, 40, 0};
    solid.components = ComponentSettings{2, 0, 0, 0};
    solid.holes = HoleSettings{};
    solid.inner_components = true;
    all = near;
    all.self_intersections = Untangle::all;
    all.inner_components = true;

    all.holes = HoleSettings{};
    return {{"plain", plain},   {"off", off},     {"near", near}, {"holes", holes},
            {"smooth", smooth}, {"solid", solid}, {"all", all}};
}

/// A surface with its vertices on a coarse lattice: equal places, faces without area, doubles, crowded edges.
Mesh on_lattice(Mesh mesh, double cell) {
    for (Vec3& p : mesh.positions)
        for (std::size_t i = 0; i < 3; ++i) p[i] = std::floor(p[i] / cell + 0.5) * cell;
    return mesh;
}

/// Removes some faces, duplicates others, and reverses some of these.
Mesh damaged(const Mesh& mesh, std::uint64_t seed) {
    Mesh result;
    result.positions = mesh.positions;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> face(mesh.face_wedges(f).begin(), mesh.face_wedges(f).end());
        const auto draw = hashed(seed, f) % 20;
        if (draw == 0) continue;
        add_face(result, face);
        if (draw == 2) std::reverse(face.begin(), face.end());
        if (draw <= 2) add_face(result, face);
    }
    return result;
}

std::vector<std::pair<std::string, Mesh>> meshes(std::uint64_t seed) {
    Mesh two = shapes::cube();
    append(two, shapes::hourglass());
    return {{"lattice sphere", on_lattice(noisy_icosphere(2, 0.2, seed), 0.25)},
            {"lattice torus", on_lattice(noisy_torus(20, 12, 0.1, seed), 0.3)},
            {"damaged sphere", damaged(shapes::icosphere(2), seed)},
            {"damaged quads", damaged(shapes::quad_cube(), seed)},
            {"damaged seams", with_uv_seams(damaged(noisy_icosphere(2, 0.1, seed), seed))},
            {"triangles", on_lattice(random_triangles(60, 0.3, seed), 0.125)},
            {"moebius", shapes::moebius(9)},
            {"fan3", shapes::fan3()},
            {"two", two},
            {"bowtie", shapes::bowtie()}};
}

} // namespace

TEST_CASE("clean leaves sound faces alone, and changes nothing the second time", "[property]") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
        for (const auto& [name, mesh] : meshes(seed))
            for (const auto& [how, settings] : all_settings(mesh.bounds().diagonal())) {
                INFO(name << ", " << how << ", seed " << seed);
                CHECK(broken_clean_law(mesh, settings) == "");
            }
}

TEST_CASE("clean keeps its promises over the corpus", "[property]") {
    const auto corpus = test::corpus();
    if (!corpus) return;
    std::size_t checked = 0;
    for (const auto& file : test::meshes_below(*corpus)) {
        const Scene scene = test::read_or_nothing(file);
        for (const Part& part : scene.parts)
            for (const auto& [how, settings] : all_settings(part.mesh.bounds().diagonal())) {
                if (how == "smooth" && part.mesh.face_count() > 20000) continue;
                INFO(file << ", " << how);
                CHECK(broken_clean_law(part.mesh, settings) == "");
                ++checked;
            }
    }
    CHECK(checked > 200);
    std::printf("clean kept its promises over %zu pairs of a part and settings\n", checked);
}
