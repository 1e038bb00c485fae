#include "geometry/intersect/self_intersections.hpp"

#include "base/progress.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/intersect/contacts.hpp"
#include "geometry/intersect/disjoint_triangles.hpp"
#include "geometry/intersect/plain_stars.hpp"
#include "geometry/spatial/box_pairs.hpp"
#include "mesh/surface.hpp"
#include "parallel/parallel.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <iterator>
#include <memory>

namespace facetmill {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Corners = std::array<Vec3, 3>;

/// Reorders the vertices of two triangles so that shared vertices come first, in the same order. Returns
/// their number.
int share(std::array<Index, 3>& a, std::array<Index, 3>& b) {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = shared; j < 3; ++j)
            if (a[i] == b[j]) {
                std::swap(a[i], a[shared]);
                std::swap(b[j], b[shared]);
                ++shared;
                break;
            }
    return static_cast<int>(shared);
}

Point point(const Vec3& p) { return {p.x, p.y, p.z}; }

/// Whether two triangles with area meet elsewhere than in their first `shared` corners. Exact.
bool meet(const Corners& a, const Corners& b, int shared) {
    const Point a0 = point(a[0]), a1 = point(a[1]), a2 = point(a[2]), b2 = point(b[2]);
    if (shared ==
        2) // triangles with a common edge meet elsewhere only if they are folded flat onto each other
        return CGAL::coplanar(a0, a1, a2, b2) && CGAL::coplanar_orientation(a0, a1, a2, b2) == CGAL::POSITIVE;
    const Point b0 = point(b[0]), b1 = point(b[1]);
    const Triangle ta(a0, a1, a2), tb(b0, b1, b2);
    if (shared == 1) // if they have another common point than the vertex, one such point is on the opposite
                     // edge of a or b
        return CGAL::do_intersect(Segment(a1, a2), tb) || CGAL::do_intersect(Segment(b1, b2), ta);
    return CGAL::do_intersect(ta, tb);
}

} // namespace

/// The triangles to test; a polygon gives several.
class SelfIntersectionSearch::Search {
    struct Facet {
        std::array<Index, 3> vertices;
        Index face;
    };

    using Pairs = std::vector<std::pair<Index, Index>>;

    /// The first pairs of many, and their total number.
    struct First {
        std::size_t count = 0;
        Pairs pairs;

        void add(std::pair<Index, Index> pair, std::size_t limit) {
            ++count;
            if (limit == 0) return;
            pairs.push_back(pair);
            trim(limit);
        }
        void add(const First& others, std::size_t limit) {
            count += others.count;
            pairs.insert(pairs.end(), others.pairs.begin(), others.pairs.end());
            trim(limit);
        }
        /// Calls keep(limit) once the list is twice as long, so that the cost per pair is small.
        void trim(std::size_t limit) {
            if (pairs.size() / 2 >= limit && pairs.size() >= 4096) keep(limit);
        }
        /// Keeps only the first `limit` pairs, unsorted.
        void keep(std::size_t limit) {
            if (pairs.size() <= limit) return;
            const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(limit);
            std::nth_element(pairs.begin(), end, pairs.end());
            pairs.erase(end, pairs.end());
        }
    };

    /// Pairs that intersect, and pairs that only touch.
    struct Kinds {
        First real, touching;
        std::size_t box_pairs = 0;
    };

  public:
    explicit Search(const Mesh& mesh, const Box& frame = {})
        : Search(surface_of(mesh), mesh.face_count(), frame) {}
    Search(Surface surface, std::size_t faces, const Box& frame = {})
        : face_count_(faces), surface_(std::move(surface)), pairs_(with_boxes({}), {}, frame) {
        number_facets();
    }

    const Box& frame() const { return pairs_.all(); }
    void choose(const std::vector<std::uint8_t>& among) { pairs_.choose(of_triangles(among)); }

    /// Uses the given plain stars, or computes the current ones before all neighbours are tested.
    void set_plain_stars(const SelfIntersectionSettings& settings) {
        if (!settings.stars.empty())
            plain_ = settings.stars;
        else if (settings.among.empty())
            plain_ = plain_stars(surface_);
        else
            plain_.clear();
        note_plain_vertices();
    }

    /// Returns false if polygons now have another number of triangles, which makes the update impossible.
    bool move_to(const Mesh& mesh, const std::vector<std::uint8_t>& moved) {
        plain_.clear();
        plain_vertices_.clear();
        if (surface_.faces.empty()) {
            surface_.positions = mesh.positions;
            pairs_.move_to(with_boxes(moved), moved);
            return true;
        }
        Surface now = surface_of(mesh);
        if (now.faces != surface_.faces) return false;
        surface_ = std::move(now);
        const std::vector<std::uint8_t> triangles = of_triangles(moved);
        pairs_.move_to(with_boxes(triangles), triangles);
        number_facets();
        return true;
    }

    SelfIntersections run(const SelfIntersectionSettings& settings) const {
        const std::size_t most = settings.max_box_pairs;
        if (most == SIZE_MAX) return run(settings.limit, settings.separate_touching);
        const std::size_t count = pairs_.for_each(most, [](std::size_t, std::size_t) {});
        if (count <= most) return run(settings.limit, settings.separate_touching);
        SelfIntersections none_looked_at;
        none_looked_at.box_pairs = count;
        none_looked_at.too_many = true;
        return none_looked_at;
    }

    SelfIntersections run(std::size_t limit, bool apart) const {
        // Two polygons may meet in several of their triangles: all pairs are needed to count each once.
        const bool polygons = !surface_.faces.empty();
        const std::size_t kept = polygons ? SIZE_MAX : limit;
        const TouchTest touching(surface_);
        const auto look_at = [&](Kinds& found, std::size_t i, std::size_t j) {
            const Facet &s = facets_[i], &t = facets_[j];
            const int shared = facets_meet(s, t);
            if (shared < 0) return;
            const bool touch =
                apart && shared < 2 && touching.only_touch(pairs_.items()[i], pairs_.items()[j]);
            (touch ? found.touching : found.real).add(std::minmax(s.face, t.face), kept);
        };
        Kinds all = pairs_.reduce_fours(
            Kinds{},
            [&](Kinds& found, std::size_t i, std::size_t four, unsigned bits) {
                found.box_pairs += static_cast<std::size_t>(std::popcount(bits));
                for (bits &= ~share_plain_star(i, four / 4); bits != 0; bits &= bits - 1)
                    look_at(found, i, four + static_cast<std::size_t>(std::countr_zero(bits)));
            },
            [&](Kinds a, const Kinds& b) {
                a.real.add(b.real, kept);
                a.touching.add(b.touching, kept);
                a.box_pairs += b.box_pairs;
                return a;
            });
        in_order(all.real, polygons);
        in_order(all.touching, polygons);
        if (polygons) { // a pair that intersects in one triangle may touch in others
            const Pairs touch = std::move(all.touching.pairs);
            all.touching.pairs.clear();
            std::set_difference(touch.begin(), touch.end(), all.real.pairs.begin(), all.real.pairs.end(),
                                std::back_inserter(all.touching.pairs));
            all.touching.count = all.touching.pairs.size();
        }
        for (First* first : {&all.real, &all.touching})
            first->pairs.resize(std::min(limit, first->pairs.size()));
        return {all.real.count,     std::move(all.real.pairs),
                all.touching.count, std::move(all.touching.pairs),
                all.box_pairs,      false};
    }

    MeetingFaces faces(std::span<const std::pair<Index, Index>> exempt, std::size_t max_box_pairs) const {
        MeetingFaces known;
        known.faces.resize(face_count_);
        const auto flag = [&](Index f) { return std::atomic_ref(known.faces[f]); };
        constexpr auto relaxed = std::memory_order_relaxed;
        known.box_pairs = pairs_.for_each(max_box_pairs, [&](std::size_t i, std::size_t j) {
            const auto [f, g] = std::minmax(facets_[i].face, facets_[j].face);
            if (flag(f).load(relaxed) && flag(g).load(relaxed)) return;
            const auto is_exempt = [&, pair = std::pair{f, g}] {
                return std::binary_search(exempt.begin(), exempt.end(), pair);
            };
            if (facets_meet(facets_[i], facets_[j], is_exempt) < 0) return;
            flag(f).store(1, relaxed);
            flag(g).store(1, relaxed);
        });
        known.too_many = known.box_pairs > max_box_pairs;
        if (known.too_many) known.faces.clear(); // the faces found so far depend on the threads
        return known;
    }

  private:
    /// Updates the boxes of the flagged triangles, or of all if no flags are given, and returns all boxes.
    std::span<const Box> with_boxes(const std::vector<std::uint8_t>& moved) {
        boxes_.resize(surface_.size());
        parallel_for(boxes_.size(), [&](std::size_t t) {
            if (!moved.empty() && !moved[t]) return;
            boxes_[t] = {};
            const Vec3 &a = surface_.point(t, 0), &b = surface_.point(t, 1), &c = surface_.point(t, 2);
            if (!is_finite(a) || !is_finite(b) || !is_finite(c) || is_degenerate(a, b, c)) return;
            boxes_[t].add(a);
            boxes_[t].add(b);
            boxes_[t].add(c);
        });
        return boxes_;
    }

    void number_facets() {
        facets_.resize(pairs_.items().size());
        parallel_for(facets_.size(), [&](std::size_t i) {
            const Index t = pairs_.items()[i];
            const Index* const c = &surface_.corners[std::size_t{3} * t];
            facets_[i] = {{c[0], c[1], c[2]}, surface_.face(t)};
        });
    }

    /// Converts face flags to triangle flags.
    std::vector<std::uint8_t> of_triangles(const std::vector<std::uint8_t>& among) const {
        if (among.empty() || surface_.faces.empty()) return among;
        std::vector<std::uint8_t> flags(surface_.size());
        for (std::size_t t = 0; t < flags.size(); ++t) flags[t] = among[surface_.face(t)];
        return flags;
    }

    Corners corners(const std::array<Index, 3>& v) const {
        return {surface_.positions[v[0]], surface_.positions[v[1]], surface_.positions[v[2]]};
    }

    static void in_order(First& first, bool once) {
        std::sort(first.pairs.begin(), first.pairs.end());
        if (!once) return;
        first.pairs.erase(std::unique(first.pairs.begin(), first.pairs.end()), first.pairs.end());
        first.count = first.pairs.size();
    }

    /// The number of vertices that both share, if they meet elsewhere; otherwise -1.
    int facets_meet(const Facet& s, const Facet& t) const {
        return facets_meet(s, t, [] { return false; });
    }
    /// Treats facets as disjoint when passes() holds, which is called only if the signs of doubles leave it
    /// open.
    template <class Passes>
    int facets_meet(const Facet& s, const Facet& t, Passes&& passes) const {
        if (s.face == t.face) return -1;
        auto u = s.vertices, v = t.vertices;
        const int shared = share(u, v);
        if (shared == 3) return passes() ? -1 : shared;
        const Corners a = corners(u), b = corners(v);
        return !surely_disjoint(a, b, shared) && !passes() && meet(a, b, shared) ? shared : -1;
    }

    /// The plain vertices of four consecutive facets, a lane for each facet. Vertices that are not plain
    /// have no number.
    using PlainVertices = std::array<Int4, 3>;
    static constexpr std::int32_t nothing = -1;

    void note_plain_vertices() {
        plain_vertices_.clear();
        if (plain_.empty()) return;
        plain_vertices_.resize((facets_.size() + 3) / 4);
        parallel_for(plain_vertices_.size(), [&](std::size_t n) {
            for (std::size_t lane = 0; lane < 4; ++lane)
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t i = 4 * n + lane;
                    const Index v = i < facets_.size() ? facets_[i].vertices[k] : none;
                    const bool is_plain = v < plain_.size() && plain_[v] != Star::unknown && v <= INT32_MAX;
                    plain_vertices_[n][k][lane] = is_plain ? static_cast<std::int32_t>(v) : nothing;
                }
        });
    }

    /// A bit for each of the four facets from 4 n on: 1 if it shares a plain vertex with facet i.
    unsigned share_plain_star(std::size_t i, std::size_t n) const {
        if (plain_vertices_.empty()) return 0;
        const PlainVertices &own = plain_vertices_[i / 4], &four = plain_vertices_[n];
        Int4 shared{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t v = own[k][i % 4];
            const Int4 all = Int4{} + (v == nothing ? nothing - 1 : v);
            shared |= (four[0] == all) | (four[1] == all) | (four[2] == all);
        }
        return bits_of(shared);
    }

    std::size_t face_count_;
    Surface surface_;
    std::vector<Box> boxes_; ///< [triangles] boxes
    BoxPairs pairs_;
    std::vector<Facet> facets_;                 ///< facets along the Morton curve
    std::vector<Star> plain_;                   ///< [vertices] result of plain_stars, or empty
    std::vector<PlainVertices> plain_vertices_; ///< per four facets, or empty
};

SelfIntersectionSearch::SelfIntersectionSearch(const Mesh& mesh, const Box& frame)
    : search_(std::make_unique<Search>(mesh, frame)) {}
SelfIntersectionSearch::SelfIntersectionSearch(Surface surface, std::size_t faces)
    : search_(std::make_unique<Search>(std::move(surface), faces)) {}
SelfIntersectionSearch::SelfIntersectionSearch(SelfIntersectionSearch&&) noexcept = default;
SelfIntersectionSearch& SelfIntersectionSearch::operator=(SelfIntersectionSearch&&) noexcept = default;
SelfIntersectionSearch::~SelfIntersectionSearch() = default;

void SelfIntersectionSearch::move_to(const Mesh& mesh, const std::vector<std::uint8_t>& moved) {
    if (!search_->move_to(mesh, moved)) search_ = std::make_unique<Search>(mesh);
}

const Box& SelfIntersectionSearch::frame() const { return search_->frame(); }

SelfIntersections SelfIntersectionSearch::pairs(const SelfIntersectionSettings& settings) {
    search_->choose(settings.among);
    search_->set_plain_stars(settings);
    return search_->run(settings);
}

MeetingFaces SelfIntersectionSearch::faces(const std::vector<std::uint8_t>& among,
                                           std::span<const std::pair<Index, Index>> exempt,
                                           std::size_t max_box_pairs) {
    search_->choose(among);
    return search_->faces(exempt, max_box_pairs);
}

SelfIntersections find_self_intersections(Surface surface, std::size_t faces,
                                          const SelfIntersectionSettings& settings) {
    ProgressSteps steps({1, 3});
    SelfIntersectionSearch search(std::move(surface), faces);
    steps.next();
    return search.pairs(settings);
}

SelfIntersections find_self_intersections(const Mesh& mesh, const SelfIntersectionSettings& settings) {
    return find_self_intersections(surface_of(mesh), mesh.face_count(), settings);
}

} // namespace facetmill
