#pragma once
// Sheets as they are tested while their faces are kept apart, and the shares of the moves of their places.

#include "base/error.hpp"
#include "base/math/numbers.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
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

/// A sheet as it is tested: vertices at one place are one. What is searched, some hundred bytes a triangle,
/// is made when it is asked for and, unless it stays, dropped again.
class TestSheet {
  public:
    /// `alike`: another sheet or none; where the two are the same before they move, nothing is searched
    /// twice.
    TestSheet(const CrumpleSheet& sheet, const std::vector<Index>& places, std::size_t max_pairs,
              bool stays_open = true, const TestSheet* alike = nullptr);

    std::size_t exempt() const { return exempt_.size(); }
    std::size_t pairs_before() const { return pairs_before_; }
    std::size_t face_count() const { return from().face_count(); }
    /// As it is before it moves, by the places.
    Mesh mesh_before() const { return mesh_at({}); }

    /// The vertices whose level has changed, or all of them, belong elsewhere now: remembers their faces, and
    /// those that are to be looked at again, as touched. again: [faces], or none.
    void place(const std::vector<std::uint8_t>& levels, const std::vector<std::uint8_t>& changed,
               std::vector<std::uint8_t> again = {});

    /// The new pairs among faces that were touched, as many as are listed; a face that lost its area is a
    /// pair with itself. levels: those at which the sheet was placed; so below.
    std::vector<std::pair<Index, Index>> new_pairs(const std::vector<std::uint8_t>& levels);

    /// [faces] 1 for those of which the moves, by the shares at the levels, draw two corners apart by more
    /// than so many times the longest edge.
    std::vector<std::uint8_t> overstretched(const std::vector<std::uint8_t>& levels, double stretch) const;

    /// Looks at these faces only; the others count as not touched.
    void touch_only(std::vector<std::uint8_t> faces) { touched_ = std::move(faces); }

    /// Those of all new pairs among faces that were touched, unless there is too much to look at.
    MeetingFaces in_trouble(const std::vector<std::uint8_t>& levels);

    /// Marks the places of the faces, and of all that so many rings of faces around them touch. Whether there
    /// are any.
    bool mark(const std::vector<std::uint8_t>& faces, std::size_t rings,
              std::vector<std::uint8_t>& marked) const;

    const std::vector<std::uint8_t>& touched() const { return touched_; }
    /// [vertices] where they are at the levels.
    std::vector<Vec3> positions(const std::vector<std::uint8_t>& levels) const;

  private:
    struct Open {
        explicit Open(Mesh at, const Box& frame) : mesh(std::move(at)), search(mesh, frame) {}
        Mesh mesh; ///< corners go to the first of equal vertices
        SelfIntersectionSearch search;
    };

    const Mesh& from() const { return *sheet_.mesh; }
    /// The first of equal vertices at a corner.
    Index corner(Index c) const { return first_[from().vertex(c)]; }
    Vec3 before(Index vertex) const {
        const auto& [x, y, z] = before_[vertex];
        return {x, y, z};
    }
    /// Where a vertex that is the first of equal ones is at the levels; empty: before it moves.
    Vec3 at(Index vertex, const std::vector<std::uint8_t>& levels) const;
    Mesh mesh_at(const std::vector<std::uint8_t>& levels) const;
    Open& open(const std::vector<std::uint8_t>& levels);
    void close();
    /// first_[v]: the first vertex at the place of v that starts at the same point.
    void weld();
    bool is_same_before(const TestSheet& other) const;
    void remember_exempt();
    SelfIntersections find(Open& in, const std::vector<std::uint8_t>& among, std::size_t limit) const;

    const CrumpleSheet& sheet_;
    const std::vector<Index>& places_;
    std::size_t max_pairs_;
    bool stays_open_;
    std::vector<std::array<float, 3>> before_; ///< [vertices] where they start
    std::vector<Index> first_;                 ///< [vertices]
    std::optional<Open> open_;
    Box frame_;                                   ///< of all triangles that were searched
    std::vector<std::pair<Index, Index>> exempt_; ///< ascending
    std::size_t pairs_before_ = 0;                ///< of triangles with boxes that meet
    std::vector<std::uint8_t> flat_, touched_;    ///< [faces]
};

/// All sheets, ready to be tested; alike ones are searched once before they move. The first stays open, and
/// those that have no more than max_open triangles with all before them.
std::vector<TestSheet> tests_of(std::span<const CrumpleSheet> sheets, const CrumplePlaces& places,
                                std::size_t max_pairs, std::size_t max_open = max_open_triangles);

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
