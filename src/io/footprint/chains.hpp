#pragma once
// Joins curves at their ends into rings.

#include "geometry/polygon/polygon.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace facetmill::io {

/// A curve as a polyline of two points or more.
struct OpenCurve {
    std::vector<Vec2> points;
    double size = 0; ///< the diagonal of its bounds, or the radius of an arc if that is larger
    std::uint32_t layer = 0;
};

/// A place where curves that enclose nothing look like an outline.
struct OpenOutline {
    Vec2 from, to; ///< the ends that do not meet
};

struct Chains {
    std::vector<std::vector<Vec2>> rings;
    std::vector<Index> open;             ///< curves in no ring, ascending
    std::size_t repeated = 0;            ///< curves that lie on another one
    std::optional<Vec2> branching;       ///< three ends or more meet, so that the rings are ambiguous
    std::optional<OpenOutline> doubtful; ///< the open curves may be an outline
};

/// Ends are the same point if they are equal. Ends that then have no partner meet if they are nearer than
/// 1e-5 of the larger curve's size: files give angles and radii with about six digits. Curves of a layer are
/// joined first, and the rest across layers. Rings touch at most. Curves with an end that meets no other are
/// open. Open curves are doubtful if two of their ends are nearer than a hundredth of the curves, or if a
/// straight line would close the curves around a ring of the result or of `others`. Throws limit (E-SIZE) for
/// too many ends in one place.
[[nodiscard]] Chains join_chains(const std::vector<OpenCurve>& curves,
                                 const std::vector<std::vector<Vec2>>& others, const std::string& name);

/// Removes rings that lie on an earlier one within the rounding above. Returns their number.
std::size_t remove_repeated(std::vector<std::vector<Vec2>>& rings);

} // namespace facetmill::io
