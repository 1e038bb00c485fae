#pragma once
// The range of numbers that the colours of a picture span.

#include "mesh/scene.hpp"

#include <functional>

namespace facetmill {

/// The numbers for the first and the last colour. Numbers beyond the range get these colours too.
struct ColourRange {
    enum class Kind {
        automatic,  ///< `all`, or `percentile` if the percentiles cover less than half of the span
        percentile, ///< from the 1st to the 99th percentile
        all,        ///< from the smallest to the largest number
        given,
    };
    Kind kind = Kind::automatic;
    double min = 0, max = 0; ///< the range for Kind::given
    bool diverging = false;  ///< uses different colours below and above the middle; unless it is given, the
                             ///< range is symmetric about 0
    double lost = 0; ///< for Kind::automatic: the rounding error relative to the largest number; smaller
                     ///< differences get the same colour
};

struct ValueRange {
    bool known = false;       ///< whether any numbers exist
    double low = 0, high = 0; ///< the first and the last colour
    double min = 0, max = 0;  ///< the range of all numbers
    bool diverging = false;   ///< see ColourRange
    bool percentiles = false; ///< low and high are the 1st and 99th percentile; if diverging, plus and minus
                              ///< the 99th percentile of the absolute values
    std::size_t missing = 0;  ///< elements whose value is not finite
    std::vector<std::uint64_t>
        identifiers{}; ///< the identifiers of an identifier attribute, ascending; empty if too many
    bool beyond() const { return min < low || max > high; } ///< whether some numbers lie outside the range
};

/// The attribute with this name and at least one component. Searches faces, then wedges, then vertices; null
/// if absent.
[[nodiscard]] const Attribute* attribute_to_show(const Mesh& mesh, const std::string& name);

/// The range of the finite values of the attribute's first component over the parts selected by `shows`
/// (empty: all). Applies to numbers, not to identifiers. Each element counts once. O(n).
[[nodiscard]] ValueRange value_range(const Scene& scene, const std::string& attribute,
                                     const ColourRange& wanted,
                                     const std::function<bool(const Part&)>& shows);

} // namespace facetmill
