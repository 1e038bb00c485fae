#include "geometry/section/cut.hpp"

#include "base/error.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"

#include <bit>
#include <fmt/format.h>

namespace facetmill {

namespace {

struct PlaneCrossing {
    EdgeKey edge;
    bool up;
    double along;
};

/// Cuts faces into pieces. A face with many corners may cross a plane several times. Crossings are ordered
/// along the cut, and each descending crossing is joined with the ascending crossing of the same rank.
class SectionCutter {
  public:
    SectionCutter(const Mesh& mesh, const std::vector<Index>& levels, const StackPlanes& stack,
                  const Plane& plane)
        : mesh_(mesh), levels_(levels), stack_(stack), normal_(plane.normal) {}

    void cut(Index f, std::vector<Piece>& out) {
        Index low = none, high = 0;
        for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
            const Index l = levels_[mesh_.vertex(c)];
            low = std::min(low, l);
            high = std::max(high, l);
        }
        for (Index k = low; k < high; ++k) cut(f, k, out);
    }

  private:
    void cut(Index f, Index k, std::vector<Piece>& out) {
        crossings_.clear();
        const Index begin = mesh_.face_begin(f), end = mesh_.face_end(f);
        for (Index c = begin; c < end; ++c) {
            const Index a = mesh_.vertex(c), b = mesh_.vertex(next_corner(c, begin, end));
            const bool a_above = levels_[a] > k, b_above = levels_[b] > k;
            if (a_above != b_above) crossings_.push_back({{std::min(a, b), std::max(a, b)}, b_above, 0});
        }
        if (crossings_.size() > 2) order(f, k);
        std::size_t down = 0, up = 0;
        for (std::size_t i = 0; i < crossings_.size(); i += 2) {
            while (crossings_[down].up) ++down;
            while (!crossings_[up].up) ++up;
            out.push_back({k, crossings_[down++].edge, crossings_[up++].edge});
        }
    }

    void order(Index f, Index k) {
        corners_.clear();
        for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) corners_.push_back(mesh_.point(c));
        const Vec3 along = cross(normal_, polygon::area_vector(corners_));
        for (auto& x : crossings_) {
            const Vec3 &a = mesh_.positions[x.edge.low], &b = mesh_.positions[x.edge.high];
            const double sa = stack_.side_of(k, a), sb = stack_.side_of(k, b);
            x.along = dot(mix(a, b, sa / (sa - sb)), along);
        }
        std::stable_sort(crossings_.begin(), crossings_.end(),
                         [](const PlaneCrossing& a, const PlaneCrossing& b) { return a.along < b.along; });
    }

    const Mesh& mesh_;
    const std::vector<Index>& levels_;
    const StackPlanes& stack_;
    Vec3 normal_;
    std::vector<PlaneCrossing> crossings_;
    std::vector<Vec3> corners_;
};

/// The number of planes that each vertex is on or above.
std::vector<Index> levels_of(const Mesh& mesh, const StackPlanes& stack) {
    std::vector<Index> levels(mesh.vertex_count());
    parallel_for(levels.size(), [&](std::size_t v) { levels[v] = stack.level(mesh.positions[v]); });
    return levels;
}

} // namespace

std::vector<Piece> pieces_of(const Mesh& mesh, const StackPlanes& stack, const Plane& plane) {
    const std::vector<Index> levels = levels_of(mesh, stack);
    const std::size_t chunks = (mesh.face_count() + default_chunk - 1) / default_chunk;
    std::vector<std::vector<Piece>> found(chunks);
    parallel_chunks(mesh.face_count(), [&](std::size_t begin, std::size_t end) {
        SectionCutter cutter(mesh, levels, stack, plane);
        for (std::size_t f = begin; f < end; ++f)
            cutter.cut(static_cast<Index>(f), found[begin / default_chunk]);
    });
    std::vector<std::size_t> first;
    first.reserve(found.size());
    for (const auto& pieces : found) first.push_back(pieces.size());
    const std::size_t count = exclusive_scan(first);
    if (count > (std::size_t{1} << 30))
        throw Error(ErrorKind::limit, "E-SECTION",
                    fmt::format("the sections would have {} segments, but at most {} are possible", count,
                                std::size_t{1} << 30),
                    "use fewer planes");
    std::vector<Piece> all(count);
    parallel_for(
        chunks,
        [&](std::size_t i) {
            std::copy(found[i].begin(), found[i].end(), all.begin() + static_cast<std::ptrdiff_t>(first[i]));
        },
        1);
    radix_sort(
        all, [](const Piece& p) { return p.plane; }, std::bit_width(stack.size()));
    return all;
}

} // namespace facetmill
