#pragma once
// Sheets as they are tested while their faces are kept apart, and the shares of the moves of their places.

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/parallel.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "mesh/face.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace facetmill {

// Vertices by the place that they start from: what is at one place moves together.

/// Places of all sheets, numbered by their keys.
struct CrumplePlaces {
    Index count = 0;
    std::vector<std::vector<Index>> of_vertex; ///< [sheets][vertices]

    explicit CrumplePlaces(std::span<const CrumpleSheet> sheets);
};

inline constexpr std::uint8_t last_level = 9; ///< of shares: no move at all
/// Of the longest edge of a face: where moves draw two of its corners apart by more, it is nearly sure to
/// meet others, so many that looking for them all would take most of the time.
inline constexpr double max_stretch = 8;
inline constexpr double least_stretch = 1.0 / 64; ///< below, faces keep their shape
/// Pairs of triangles with boxes that meet, for each face, that are looked at in one round: where there are
/// more, faces are drawn out too far to be told apart one by one.
inline constexpr std::size_t pairs_a_round = 24;
/// As many times the pairs before the move are looked at in any case: faces may lie close.
inline constexpr std::size_t times_before_a_round = 2;

inline double share_of(std::uint8_t level) { return level == last_level ? 0 : 1.0 / (1 << level); }

/// A sheet as it is tested: vertices at one place are one.
class TestSheet {
  public:
    TestSheet(const CrumpleSheet& sheet, const std::vector<Index>& places, std::size_t max_pairs)
        : sheet_(sheet), places_(places), max_pairs_(max_pairs) {
        const Mesh& from = *sheet.mesh;
        const std::size_t n = from.vertex_count();
        before_.resize(n);
        parallel_for(n, [&](std::size_t v) { before_[v] = as_float32(from.positions[v]); });
        weld();
        mesh_.face_offsets = from.face_offsets;
        mesh_.corners.resize(from.corner_count());
        parallel_for(from.corner_count(),
                     [&](std::size_t c) { mesh_.corners[c] = first_[from.vertex(static_cast<Index>(c))]; });
        mesh_.positions = before_;
        search_.emplace(mesh_);
        remember_exempt();
        flat_.resize(mesh_.face_count());
        parallel_for(flat_.size(), [&](std::size_t f) { flat_[f] = is_flat(static_cast<Index>(f)); });
    }

    std::size_t exempt() const { return exempt_.size(); }
    std::size_t pairs_before() const { return pairs_before_; }
    const Mesh& mesh() const { return mesh_; }

    /// Puts the vertices whose level has changed where they belong now, and remembers their faces.
    void place(const std::vector<std::uint8_t>& levels, const std::vector<std::uint8_t>& changed) {
        const auto& moves = sheet_.moves.moves;
        parallel_for(mesh_.positions.size(), [&](std::size_t v) {
            const Index from = first_[v];
            if (!changed.empty() && !changed[places_[from]]) return;
            const Vec3& start = sheet_.mesh->positions[from];
            const double share = share_of(levels[places_[from]]);
            mesh_.positions[v] = share == 0 ? before_[from] : as_float32(start + moves[from] * share);
        });
        touched_.assign(mesh_.face_count(), changed.empty());
        parallel_for(changed.empty() ? 0 : touched_.size(), [&](std::size_t f) {
            for (const Index v : mesh_.face_wedges(static_cast<Index>(f)))
                if (changed[places_[v]]) touched_[f] = 1;
        });
        search_->move_to(mesh_, changed.empty() ? std::vector<std::uint8_t>{} : touched_);
    }

    /// The new pairs among faces that were touched, as many as are listed; a face that lost its area is a
    /// pair with itself.
    std::vector<std::pair<Index, Index>> new_pairs() {
        // With so many listed, one new pair at least is among them when there is any.
        auto pairs = find(touched_, exempt_.size() + max_pairs_).pairs;
        std::erase_if(pairs,
                      [&](const auto& p) { return std::binary_search(exempt_.begin(), exempt_.end(), p); });
        for (Index f = 0; f < touched_.size(); ++f)
            if (touched_[f] && !flat_[f] && is_flat(f)) pairs.emplace_back(f, f);
        return pairs;
    }

    /// [faces] 1 for those of which the moves, by the shares at the levels, draw two corners apart by more
    /// than so many times the longest edge.
    std::vector<std::uint8_t> overstretched(const std::vector<std::uint8_t>& levels, double stretch) const {
        std::vector<std::uint8_t> faces(mesh_.face_count());
        const auto moved = [&](Index v) { return sheet_.moves.moves[v] * share_of(levels[places_[v]]); };
        parallel_for(faces.size(), [&](std::size_t i) {
            const auto f = static_cast<Index>(i);
            double longest = 0, farthest = 0; // squared
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
                const Index u = mesh_.corners[c], v = mesh_.corners[next_corner(mesh_, f, c)];
                const Vec3 edge = before_[v] - before_[u], apart = moved(v) - moved(u);
                longest = std::max(longest, dot(edge, edge));
                farthest = std::max(farthest, dot(apart, apart));
            }
            faces[f] = farthest > stretch * stretch * longest;
        });
        return faces;
    }

    /// Looks at these faces only; the others count as not touched.
    void touch_only(std::vector<std::uint8_t> faces) { touched_ = std::move(faces); }

    /// Those of all new pairs among faces that were touched, unless there is too much to look at.
    MeetingFaces in_trouble() {
        const std::size_t most =
            std::max(pairs_a_round * mesh_.face_count(), times_before_a_round * pairs_before_);
        auto found = search_->faces(touched_, exempt_, most);
        if (found.too_many) return found;
        parallel_for(found.faces.size(), [&](std::size_t f) {
            if (touched_[f] && !flat_[f] && is_flat(static_cast<Index>(f))) found.faces[f] = 1;
        });
        return found;
    }

    /// Marks the places of the faces, and of all that so many rings of faces around them touch. Whether there
    /// are any.
    bool mark(const std::vector<std::uint8_t>& faces, std::size_t rings,
              std::vector<std::uint8_t>& marked) const {
        if (std::find(faces.begin(), faces.end(), 1) == faces.end()) return false;
        std::vector<std::uint8_t> mine(mesh_.positions.size());
        const auto mark_face = [&](Index f) {
            for (const Index v : mesh_.face_wedges(f)) mine[v] = 1;
        };
        for (Index f = 0; f < faces.size(); ++f)
            if (faces[f]) mark_face(f);
        for (std::size_t ring = 0; ring < rings; ++ring) {
            const std::vector<std::uint8_t> inner = mine;
            for (Index f = 0; f < mesh_.face_count(); ++f)
                for (const Index v : mesh_.face_wedges(f))
                    if (inner[v]) {
                        mark_face(f);
                        break;
                    }
            if (mine == inner) break;
        }
        for (std::size_t v = 0; v < mine.size(); ++v)
            if (mine[v]) marked[places_[v]] = 1;
        return true;
    }

    const std::vector<std::uint8_t>& touched() const { return touched_; }
    const Vec3& position(std::size_t vertex) const { return mesh_.positions[first_[vertex]]; }

  private:
    /// first_[v]: the first vertex at the place of v that starts at the same point.
    void weld() {
        const std::size_t n = before_.size();
        std::vector<Index> order(n);
        for (std::size_t v = 0; v < n; ++v) order[v] = static_cast<Index>(v);
        radix_sort(
            order, [&](Index v) { return places_[v]; }, 32);
        first_.resize(n);
        for (std::size_t i = 0, j = 0; i < n; i = j) {
            for (; j < n && places_[order[j]] == places_[order[i]]; ++j) {
                std::size_t k = i;
                while (!(before_[order[k]] == before_[order[j]])) ++k;
                first_[order[j]] = order[k];
            }
        }
    }

    bool is_flat(Index f) const { return is_degenerate(mesh_, f); }

    void remember_exempt() {
        const auto found = find({}, max_pairs_);
        if (found.count > found.pairs.size())
            throw Error(
                ErrorKind::limit, "E-LIMIT",
                fmt::format("crumple: {} pairs of faces intersect already, and at most {} can be "
                            "distinguished from new ones",
                            found.count, max_pairs_),
                "clean removes duplicate faces; self_intersections: allow does not search for intersections");
        exempt_ = found.pairs;
        pairs_before_ = found.box_pairs;
    }

    SelfIntersections find(const std::vector<std::uint8_t>& among, std::size_t limit) {
        SelfIntersectionSettings settings;
        settings.limit = limit;
        settings.among = among;
        auto found = search_->pairs(settings);
        std::sort(found.pairs.begin(), found.pairs.end());
        return found;
    }

    const CrumpleSheet& sheet_;
    const std::vector<Index>& places_;
    std::size_t max_pairs_;
    std::vector<Vec3> before_; ///< [vertices] rounded
    std::vector<Index> first_; ///< [vertices]
    Mesh mesh_;                ///< corners go to the first of equal vertices
    std::optional<SelfIntersectionSearch> search_;
    std::vector<std::pair<Index, Index>> exempt_; ///< ascending
    std::size_t pairs_before_ = 0;                ///< of triangles with boxes that meet
    std::vector<std::uint8_t> flat_, touched_;    ///< [faces]
};

/// Lowers the marked places by a step of levels; whether any was still above the last.
inline bool lower(const std::vector<std::uint8_t>& marked, std::vector<std::uint8_t>& levels,
                  std::uint8_t step = 1) {
    bool any = false;
    for (std::size_t p = 0; p < marked.size(); ++p)
        if (marked[p] && levels[p] < last_level) {
            levels[p] = static_cast<std::uint8_t>(std::min<int>(last_level, levels[p] + step));
            any = true;
        }
    return any;
}

/// [sheets][faces]
using FacesOfSheets = std::vector<std::vector<std::uint8_t>>;

inline void add(const std::vector<std::uint8_t>& faces, std::vector<std::uint8_t>& to) {
    to.resize(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) to[f] |= faces[f];
}

/// Lowers the places of overstretched faces until there are none, and adds those that there were to `found`.
/// [places] 1 for those that were lowered.
inline std::vector<std::uint8_t> slacken(const std::vector<TestSheet>& tests,
                                         std::vector<std::uint8_t>& levels, double stretch,
                                         FacesOfSheets& found) {
    std::vector<std::uint8_t> lowered(levels.size());
    for (bool any = true; any;) {
        std::vector<std::uint8_t> marked(levels.size());
        any = false;
        for (std::size_t s = 0; s < tests.size(); ++s) {
            const auto faces = tests[s].overstretched(levels, stretch);
            any |= tests[s].mark(faces, 0, marked);
            add(faces, found[s]);
        }
        any = any && lower(marked, levels);
        if (any) add(marked, lowered);
    }
    return lowered;
}

} // namespace facetmill
