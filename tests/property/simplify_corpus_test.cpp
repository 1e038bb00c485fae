// The guarantees of simplification, over a corpus of real meshes.
#include "support/catch.hpp"
#include "support/corpus.hpp"

#include "geometry/inspect.hpp"
#include "geometry/simplify.hpp"
#include "io/codec.hpp"
#include "mesh/invariants.hpp"

#include <iostream>

using namespace facetmill;
namespace fs = std::filesystem;

namespace {

/// Polygons cut, unused vertices gone: what the counts of the result can be compared with.
Mesh comparable(Mesh mesh) {
    mesh = triangulated(mesh);
    drop_unused(mesh);
    return mesh;
}

void check_kept(const Mesh& given, const SimplifyResult& r) {
    CHECK(broken_invariants(r.mesh).empty());
    const Properties before = inspect(comparable(given)), after = inspect(r.mesh);
    CHECK(after.euler == before.euler);
    CHECK(after.components == before.components);
    CHECK(after.closed == before.closed);
    CHECK(after.edge_manifold == before.edge_manifold);
    CHECK(after.vertex_manifold == before.vertex_manifold);
    CHECK(after.oriented == before.oriented);
    CHECK(after.boundary_loops == before.boundary_loops);
    if (before.genus) CHECK(after.genus == before.genus);
    CHECK(after.degenerate_faces <= before.degenerate_faces);
    CHECK(after.duplicate_faces <= before.duplicate_faces);
    CHECK(after.faces <= before.faces);
    if (r.stop == SimplifyResult::Stop::ratio)
        CHECK(static_cast<double>(r.faces_after) <= std::ceil(0.1 * static_cast<double>(r.faces_before)));
}

} // namespace

TEST_CASE("law: simplification keeps topology and soundness over a corpus", "[property]") {
    const auto corpus = test::corpus();
    if (!corpus) return;
    using Method = SimplifySettings::Method;
    int compared = 0;
    for (const auto& path : test::meshes_below(*corpus)) {
        if (fs::file_size(path) >= 4000000) continue; // the large ones would take minutes
        const Scene scene = test::read_or_nothing(path);
        for (const Part& part : scene.parts)
            for (const Method method : {Method::quadric, Method::quadric_endpoints, Method::shortest_edge}) {
                INFO(path.string() << ", part " << part.name << ", method " << static_cast<int>(method));
                check_kept(part.mesh, simplify(part.mesh, {.method = method, .ratio = 0.1}));
                ++compared;
            }
    }
    CHECK(compared > 300);
}
