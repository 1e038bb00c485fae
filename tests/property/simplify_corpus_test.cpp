// The guarantees of simplification, over a corpus of real meshes.
#include "support/catch.hpp"
#include "support/corpus.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/simplify/simplify.hpp"
#include "io/codec.hpp"
#include "mesh/invariants.hpp"

#include <algorithm>
#include <array>
#include <set>

using namespace facetmill;
namespace fs = std::filesystem;

namespace {

/// The mesh with triangulated polygons and without unused vertices, comparable with the counts of the
/// result.
Mesh comparable(Mesh mesh) {
    mesh = triangulated(mesh);
    drop_unused(mesh);
    return mesh;
}

/// The most triangles that a ratio of 10 % leaves.
std::size_t target(const SimplifyResult& r) {
    return static_cast<std::size_t>(std::ceil(0.1 * static_cast<double>(r.faces_before)));
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
    // Triangulation keeps manifold edges, so the input mesh gives a condition too.
    if (inspect(given).edge_manifold) CHECK(after.edge_manifold);
    CHECK(after.boundary_loops == before.boundary_loops);
    if (before.genus) CHECK(after.genus == before.genus);
    CHECK(after.degenerate_faces <= before.degenerate_faces);
    CHECK(after.duplicate_faces <= before.duplicate_faces);
    CHECK(after.faces <= before.faces);
    if (r.stop == SimplifyResult::Stop::ratio)
        CHECK(static_cast<double>(r.faces_after) <= std::ceil(0.1 * static_cast<double>(r.faces_before)));
}

/// Conditions that hold even with topology: allow, for closedness, flips and duplicates.
void check_allowed(const Mesh& given, const SimplifyResult& r) {
    CHECK(broken_invariants(r.mesh).empty());
    const Properties before = inspect(comparable(given)), after = inspect(r.mesh);
    if (before.closed) CHECK(after.closed);
    CHECK(after.components <= before.components);
    CHECK(after.boundary_edges <= before.boundary_edges);
    CHECK(after.degenerate_faces <= before.degenerate_faces);
    CHECK(after.duplicate_faces <= before.duplicate_faces);
    CHECK(after.faces <= before.faces);
    CHECK((r.stop != SimplifyResult::Stop::ratio || r.faces_after <= target(r)));
}

/// Conditions for clusters: every face has three distinct vertices, no face occurs twice on one side, and no
/// vertex is outside.
void check_clustered(const Mesh& given, const SimplifyResult& r) {
    CHECK(broken_invariants(r.mesh).empty());
    const Properties before = inspect(comparable(given)), after = inspect(r.mesh);
    CHECK(after.faces <= before.faces);
    CHECK((r.stop != SimplifyResult::Stop::ratio || r.faces_after <= target(r)));
    const Box box = given.bounds();
    for (const Vec3& p : r.mesh.positions) // each in the cell of some vertices
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(p[i] >= box.min[i] - *r.cell);
            CHECK(p[i] <= box.max[i] + *r.cell);
        }
    std::set<std::array<Index, 3>> seen;
    for (Index f = 0; f < r.mesh.face_count(); ++f) {
        std::array<Index, 3> v{r.mesh.vertex(3 * f), r.mesh.vertex(3 * f + 1), r.mesh.vertex(3 * f + 2)};
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        CHECK((v[0] != v[1] && v[1] != v[2] && v[2] != v[0]));
        CHECK(seen.insert(v).second);
    }
}

/// Calls check(part) for the triangle parts of the corpus that are not too large. Returns their number.
template <class Check>
int over_corpus(const fs::path& corpus, Check&& check) {
    int compared = 0;
    for (const auto& path : test::meshes_below(corpus)) {
        if (fs::file_size(path) >= 4000000) continue; // larger files would take minutes
        for (const Part& part : test::read_or_nothing(path).parts) {
            INFO(path.string() << ", part " << part.name);
            check(part.mesh);
            ++compared;
        }
    }
    return compared;
}

} // namespace

TEST_CASE("law: what holds where topology may go does over a corpus", "[property]") {
    const auto corpus = test::corpus();
    if (!corpus) return;
    CHECK(over_corpus(*corpus, [](const Mesh& mesh) {
              check_allowed(mesh,
                            simplify(mesh, {.topology = SimplifySettings::Topology::allow, .ratio = 0.1}));
          }) > 100);
}

TEST_CASE("law: what holds of clusters does over a corpus", "[property]") {
    const auto corpus = test::corpus();
    if (!corpus) return;
    CHECK(over_corpus(*corpus, [](const Mesh& mesh) {
              const auto r = simplify(mesh, {.method = SimplifySettings::Method::cluster, .ratio = 0.1});
              if (r.stop != SimplifyResult::Stop::nothing) check_clustered(mesh, r);
          }) > 100);
}

TEST_CASE("law: simplification keeps topology and soundness over a corpus", "[property]") {
    const auto corpus = test::corpus();
    if (!corpus) return;
    using enum SimplifySettings::Method;
    const int compared = over_corpus(*corpus, [](const Mesh& mesh) {
        for (const auto method : {quadric, quadric_endpoints, shortest_edge}) {
            INFO("method " << static_cast<int>(method));
            check_kept(mesh, simplify(mesh, {.method = method, .ratio = 0.1}));
        }
    });
    CHECK(compared > 100);
}
