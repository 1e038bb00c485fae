#include "geometry/transfer/transfer.hpp"

#include "geometry/spatial/closest_point.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

/// How far a wedge at a seam is looked up towards the centres of its faces, as a share of the way.
constexpr double towards_faces = 1e-4;

/// The query that finds the source of an element.
struct Lookup {
    Vec3 at;             ///< the element
    Vec3 asked;          ///< next to the element, on its own side of a seam
    Vec3 middle;         ///< the mean of the centres of its faces
    Index region = none; ///< required region; none: any
};

/// Finds sources in the regions of one mesh.
class SourceFinder {
  public:
    SourceFinder(const Mesh& from, const FaceTree& tree, const SourceRegions& regions)
        : from_(from), tree_(tree), regions_(regions) {
        for (Index f = 0; f < regions.from.size(); ++f) {
            if (regions.from[f] >= any_face_.size()) any_face_.resize(std::size_t{regions.from[f]} + 1, none);
            if (any_face_[regions.from[f]] == none) any_face_[regions.from[f]] = f;
        }
    }

    /// [lookups] the source faces. distances: receives the distances of the query points.
    std::vector<Index> faces_of(const std::vector<Lookup>& lookups, std::vector<double>* distances) const {
        std::vector<Vec3> points(lookups.size());
        parallel_for(points.size(), [&](std::size_t i) { points[i] = lookups[i].asked; });
        const std::vector<Closest> found = closest_points(tree_, points);
        std::vector<Index> faces(found.size());
        if (distances) distances->resize(found.size());
        parallel_for(found.size(), [&](std::size_t i) {
            faces[i] = face_for(lookups[i], found[i]);
            if (distances) (*distances)[i] = found[i].distance;
        });
        return faces;
    }

    void add_mixes(const std::vector<Lookup>& lookups, const std::vector<Index>& faces, bool of_wedges,
                   Provenance& to) const {
        const std::size_t n = lookups.size();
        to.mix_sources.resize(3 * n);
        to.mix_weights.resize(3 * n);
        to.mix_offsets.resize(n + 1);
        parallel_for(n, [&](std::size_t i) {
            const Index c = 3 * faces[i];
            const std::array<double, 3> w =
                barycentric_weights({from_.point(c), from_.point(c + 1), from_.point(c + 2)}, lookups[i].at);
            std::array<Index, 3> order{0, 1, 2};
            std::sort(order.begin(), order.end(),
                      [&](Index a, Index b) { return w[a] != w[b] ? w[a] > w[b] : a < b; });
            for (std::size_t k = 0; k < 3; ++k) {
                const Index wedge = from_.corners[c + order[k]];
                to.mix_sources[3 * i + k] = of_wedges ? wedge : from_.vertex_of_wedge(wedge);
                to.mix_weights[3 * i + k] = w[order[k]];
            }
            to.mix_offsets[i + 1] = static_cast<Index>(3 * (i + 1));
        });
    }

  private:
    Index face_for(const Lookup& lookup, const Closest& found) const {
        const Index region = lookup.region;
        const auto fits = [&](Index face) {
            return face != none && (region == none || regions_.from[face] == region);
        };
        if (fits(found.face)) return found.face;
        for (const double share : {0.01, 0.1, 0.5, 1.0}) {
            const Index face = closest_point(tree_, mix(lookup.at, lookup.middle, share)).face;
            if (fits(face)) return face;
        }
        if (region != none && region < any_face_.size() && any_face_[region] != none)
            return any_face_[region];
        return found.face != none ? found.face : 0;
    }

    const Mesh& from_;
    const FaceTree& tree_;
    const SourceRegions& regions_;
    std::vector<Index> any_face_; ///< [regions] the first face
};

/// The lookups of the elements that corners belong to, at their positions.
class Lookups {
  public:
    Lookups(const Mesh& to, const SourceRegions& regions) : to_(to), regions_(regions) {}

    std::vector<Lookup> of_vertices() const {
        std::vector<Lookup> all(to_.vertex_count());
        parallel_for(all.size(),
                     [&](std::size_t v) { all[v].at = all[v].asked = all[v].middle = to_.positions[v]; });
        return all;
    }

    std::vector<Lookup> of_wedges() const {
        std::vector<Lookup> all(to_.wedge_count());
        std::vector<Index> wedges_of(to_.vertex_count());
        std::vector<std::uint8_t> used(all.size());
        std::vector<std::uint8_t> several(all.size()); // in several regions, with continuous values
        for (Index w = 0; w < all.size(); ++w) ++wedges_of[to_.vertex_of_wedge(w)];
        for (Index f = 0; f < to_.face_count(); ++f) {
            const Vec3 middle = corner_mean(to_, f);
            const Index region = regions_.to.empty() ? none : regions_.to[f];
            for (Index c = to_.face_begin(f); c < to_.face_end(f); ++c) {
                const Index w = to_.corners[c];
                if (!used[w]) { // one face, because the mean of several is off a curved surface
                    used[w] = 1;
                    all[w].middle = middle;
                    all[w].region = region;
                } else if (all[w].region != region) {
                    several[w] = 1;
                }
            }
        }
        parallel_for(all.size(), [&](std::size_t w) {
            const Index v = to_.vertex_of_wedge(static_cast<Index>(w));
            Lookup& wedge = all[w];
            wedge.at = wedge.asked = to_.positions[v];
            if (!used[w]) wedge.middle = wedge.at;
            if (several[w]) wedge.region = none;
            if (wedges_of[v] > 1) wedge.asked = mix(wedge.at, wedge.middle, towards_faces);
        });
        return all;
    }

    std::vector<Lookup> of_faces() const {
        std::vector<Lookup> all(to_.face_count());
        parallel_for(all.size(), [&](std::size_t f) {
            all[f].at = all[f].asked = all[f].middle = corner_mean(to_, static_cast<Index>(f));
            if (!regions_.to.empty()) all[f].region = regions_.to[f];
        });
        return all;
    }

  private:
    const Mesh& to_;
    const SourceRegions& regions_;
};

} // namespace

std::array<double, 3> barycentric_weights(const FaceTree::Triangle& t, const Vec3& p) {
    const Vec3 q = closest_on_triangle(p, t.a, t.b, t.c);
    const Vec3 ab = t.b - t.a, ac = t.c - t.a, aq = q - t.a, n = cross(ab, ac);
    const double nn = dot(n, n);
    std::array<double, 3> w{1, 0, 0};
    if (nn > 0) {
        w[1] = std::clamp(dot(cross(aq, ac), n) / nn, 0.0, 1.0);
        w[2] = std::clamp(dot(cross(ab, aq), n) / nn, 0.0, 1.0 - w[1]);
        w[0] = 1 - w[1] - w[2];
        return w;
    }
    const bool along_b = dot(ab, ab) >= dot(ac, ac);
    const Vec3& side = along_b ? ab : ac;
    if (const double square = dot(side, side); square > 0) {
        const double s = std::clamp(dot(aq, side) / square, 0.0, 1.0);
        w = {1 - s, along_b ? s : 0, along_b ? 0 : s};
    }
    return w;
}

NearestSources nearest_sources(const Mesh& from, const FaceTree& tree, const Mesh& to,
                               const SourceRegions& regions) {
    const SourceFinder finder(from, tree, regions);
    const Lookups lookups(to, regions);
    NearestSources result;
    const auto vertices = lookups.of_vertices();
    finder.add_mixes(vertices, finder.faces_of(vertices, &result.distances), false,
                     result.provenance.vertices);
    if (has_attributes(from, Domain::wedge)) {
        const auto wedges = lookups.of_wedges();
        finder.add_mixes(wedges, finder.faces_of(wedges, nullptr), true, result.provenance.wedges);
    } else // inherit_attributes asks only for their number
        result.provenance.wedges.copies.assign(to.wedge_count(), 0);
    if (has_attributes(from, Domain::face))
        result.provenance.faces = finder.faces_of(lookups.of_faces(), nullptr);
    return result;
}

std::size_t faces_across_charts(const Mesh& from, const Mesh& to, const MeshProvenance& provenance) {
    DisjointSets charts(from.wedge_count());
    for (Index f = 0; f < from.face_count(); ++f)
        for (const Index w : from.face_wedges(f)) charts.join(from.corners[from.face_begin(f)], w);
    const auto chart = [&](Index wedge) {
        return charts.find(provenance.wedges.mix_sources[provenance.wedges.mix_offsets[wedge]]);
    };
    std::size_t count = 0;
    for (Index f = 0; f < to.face_count(); ++f) {
        const auto wedges = to.face_wedges(f);
        count += std::any_of(wedges.begin(), wedges.end(),
                             [&](Index w) { return chart(w) != chart(wedges.front()); });
    }
    return count;
}

} // namespace facetmill
