// Buckets of faces by vertex: their contents, and the number of items per thread.
#include "mesh/buckets.hpp"

#include "mesh/shapes.hpp"
#include "support/catch.hpp"

using namespace facetmill;

namespace {

Buckets<Index> corners_of(const Mesh& mesh) {
    return fill_buckets<Index>(mesh, [&](Index f, auto&& emit) {
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) emit(mesh.vertex(c), c);
    });
}

} // namespace

TEST_CASE("buckets have the items of their vertices, in the order of faces", "[mesh]") {
    for (const Mesh& mesh : {shapes::cube(), shapes::icosphere(5), Mesh{}}) {
        const auto buckets = corners_of(mesh);
        CHECK(buckets.count() == number_of_buckets(mesh.vertex_count()));
        CHECK(buckets.items.size() == mesh.corner_count());
        for (std::size_t b = 0; b < buckets.count(); ++b) {
            const auto items = buckets.of(b);
            CHECK(std::is_sorted(items.begin(), items.end()));
            for (const Index c : items) CHECK(mesh.vertex(c) >> buckets.shift == b);
        }
    }
}

TEST_CASE("small meshes are not handed to other threads, large ones are", "[mesh]") {
    for (const int level : {0, 1, 2, 3}) {
        const auto few = corners_of(shapes::icosphere(level)); // up to 1,280 faces
        CHECK(few.at_once() >= few.count());
    }
    const auto many = corners_of(shapes::icosphere(6)); // 245,760 corners
    CHECK(many.at_once() * 20 < many.count());
    CHECK(many.at_once() >= 16);
}
