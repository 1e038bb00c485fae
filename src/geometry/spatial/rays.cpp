#include "geometry/spatial/rays.hpp"

#include "geometry/spatial/rays_walk.hpp"

namespace facetmill {

namespace {

std::vector<Hit> searched(const FaceTree& tree, const Line& line, bool all) {
    if (!rays::is_line(line)) return {};
    rays::LineSearch search(tree, line, all);
    while (search.step()) {
    }
    return search.hits();
}

} // namespace

int passes(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) {
    return from == to ? 0 : rays::LineSigns(from, to).passes(a, b, c);
}

std::optional<Hit> first_hit(const FaceTree& tree, const Line& line) {
    const auto hits = searched(tree, line, false);
    return hits.empty() ? std::nullopt : std::optional(hits[0]);
}

std::vector<Hit> all_hits(const FaceTree& tree, const Line& line) { return searched(tree, line, true); }

int winding_beside(const FaceTree& tree, const Vec3& from, int winding_there, const Vec3& to) {
    const Line line{from, to};
    if (!rays::is_line(line)) return winding_there;
    const rays::LineTest test(line);
    rays::LineWalk walk(tree, line);
    int left = 0;
    while (walk.step([&](Index triangle) {
        if (const auto hit = test.hit(tree, triangle)) left += hit->way;
        return HUGE_VAL;
    })) {
    }
    return winding_there - left;
}

} // namespace facetmill
