#pragma once
// Sheets in a form for repeated intersection tests, and the shares of the moves of their positions.

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

// Groups vertices by their initial position: coincident vertices move together.

/// Places of all sheets, numbered by their keys.
struct CrumplePlaces {
    Index count = 0;
    std::vector<std::vector<Index>> of_vertex; ///< [sheets][vertices] positions

    explicit CrumplePlaces(std::span<const CrumpleSheet> sheets);
};

inline constexpr std::uint8_t last_level = 9; ///< the level of share 0, no move
/// Relative to the longest edge of a face. If moves stretch a face by more than this, it almost certainly
/// intersects others. Finding all of them would take most of the time.
inline constexpr double max_stretch = 8;
inline constexpr double least_stretch = 1.0 / 64; ///< below this, faces keep their shape
/// Box pairs per face that are examined in a round. With more, faces are stretched too far to be examined
/// individually.
inline constexpr std::size_t pairs_a_round = 24;
/// In any case, this many times the box pairs before the move are examined, because faces may be close
/// together.
inline constexpr std::size_t times_before_a_round = 2;

[[nodiscard]] inline double share_of(std::uint8_t level) {
    return level == last_level ? 0 : 1.0 / (1 << level);
}

/// A sheet for tests: coincident vertices are merged. The search structure, about a hundred bytes a
/// triangle, is built on request and dropped again unless it is kept open.
class TestSheet {
  public:
    /// `alike`: another sheet, or null. If both are equal before they move, its search is reused.
    TestSheet(const CrumpleSheet& sheet, const std::vector<Index>& places, std::size_t max_pairs,
              bool stays_open = true, const TestSheet* alike = nullptr);

    std::size_t exempt() const { return exempt_.size(); }
    std::size_t pairs_before() const { return pairs_before_; }
    std::size_t face_count() const { return from().face_count(); }
    /// The mesh before the moves, with coincident vertices merged.
    Mesh mesh_before() const { return mesh_at({}); }

    /// Moves the vertices whose level changed, or all. Marks their faces, and the faces in `again`, as
    /// touched. again: [faces], or none.
    void place(const std::vector<std::uint8_t>& levels, const std::vector<std::uint8_t>& changed,
               std::vector<std::uint8_t> again = {});

    /// The new pairs among touched faces, as many as are listed; a face that lost its area is paired with
    /// itself. levels: the levels of the last place(), also for the following functions.
    std::vector<std::pair<Index, Index>> new_pairs(const std::vector<std::uint8_t>& levels);

    /// [faces] 1 if the moves at these levels separate two corners by more than `stretch` times the longest
    /// edge.
    std::vector<std::uint8_t> overstretched(const std::vector<std::uint8_t>& levels, double stretch) const;

    /// Limits the search to these faces; all others count as untouched.
    void touch_only(std::vector<std::uint8_t> faces) { touched_ = std::move(faces); }

    /// The faces of all new pairs among touched faces, unless too many pairs would have to be examined.
    MeetingFaces in_trouble(const std::vector<std::uint8_t>& levels);

    /// Marks the positions of the faces, and of `rings` rings of faces around them. Returns whether any was
    /// marked.
    bool mark(const std::vector<std::uint8_t>& faces, std::size_t rings,
              std::vector<std::uint8_t>& marked) const;

    const std::vector<std::uint8_t>& touched() const { return touched_; }
    /// [vertices] The positions at these levels.
    std::vector<Vec3> positions(const std::vector<std::uint8_t>& levels) const;

  private:
    struct Open {
        explicit Open(Mesh at, const Box& frame) : mesh(std::move(at)), search(mesh, frame) {}
        Mesh mesh; ///< corners use the first of equal vertices
        SelfIntersectionSearch search;
    };

    const Mesh& from() const { return *sheet_.mesh; }
    /// The first of equal vertices at a corner.
    Index corner(Index c) const { return first_[from().vertex(c)]; }
    Vec3 before(Index vertex) const {
        const auto& [x, y, z] = before_[vertex];
        return {x, y, z};
    }
    /// The position of a vertex at these levels. The vertex must be the first of its group. Empty levels:
    /// before the moves.
    Vec3 at(Index vertex, const std::vector<std::uint8_t>& levels) const;
    Mesh mesh_at(const std::vector<std::uint8_t>& levels) const;
    Open& open(const std::vector<std::uint8_t>& levels);
    void close();
    /// Sets first_[v]: the first vertex with v's position that starts at the same point.
    void weld();
    bool is_same_before(const TestSheet& other) const;
    void remember_exempt();
    SelfIntersections find(Open& in, const std::vector<std::uint8_t>& among, std::size_t limit) const;

    const CrumpleSheet& sheet_;
    const std::vector<Index>& places_;
    std::size_t max_pairs_;
    bool stays_open_;
    std::vector<std::array<float, 3>> before_; ///< [vertices] initial positions
    std::vector<Index> first_;                 ///< [vertices] first equal vertex
    std::optional<Open> open_;
    Box frame_;                                   ///< box of all triangles that were searched
    std::vector<std::pair<Index, Index>> exempt_; ///< ascending
    std::size_t pairs_before_ = 0;                ///< pairs of triangles with boxes that meet
    std::vector<std::uint8_t> flat_, touched_;    ///< [faces]
};

/// All sheets, ready to be tested; identical sheets are searched once before they move. The first sheet
/// stays open, and each sheet that has at most max_open triangles together with all before it.
[[nodiscard]] std::vector<TestSheet> tests_of(std::span<const CrumpleSheet> sheets,
                                              const CrumplePlaces& places, std::size_t max_pairs,
                                              std::size_t max_open = max_open_triangles);

/// Lowers the marked positions by `step` levels. Returns whether any position was above the last level.
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

/// Lowers the positions of overstretched faces until none are left, and adds these faces to `found`.
/// [positions] 1 if lowered.
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
