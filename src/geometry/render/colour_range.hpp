#pragma once
// The range of numbers that the colours of a picture span.

#include "mesh/scene.hpp"

#include <functional>

namespace facetmill {

/// Which numbers get the first and the last colour; those beyond get the same as these.
struct ColourRange {
    enum class Kind {
        automatic,  ///< all, or the percentiles if these cover less than half of the span
        percentile, ///< from the 1st to the 99th percentile
        all,        ///< the smallest and the largest
        given,
    };
    Kind kind = Kind::automatic;
    double min = 0, max = 0; ///< of Kind::given
    bool diverging = false;  ///< uses different colours below and above the middle; unless it is given, the
                             ///< range is symmetric about 0
    double lost = 0; ///< of Kind::automatic: the rounding error relative to the largest number; smaller
                     ///< differences get the same colour
};

struct ValueRange {
    bool known = false;                       ///< there are numbers at all
    double low = 0, high = 0;                 ///< the first and the last colour
    double min = 0, max = 0;                  ///< of all numbers
    bool diverging = false;                   ///< of ColourRange
    bool percentiles = false;                 ///< low and high are the 1st and 99th percentile, or
                                              ///< of diverging ones the 99th of the amounts
    std::size_t missing = 0;                  ///< elements whose value is not finite
    std::vector<std::uint64_t> identifiers{}; ///< of an attribute of such, ascending; none where many differ
    bool beyond() const { return min < low || max > high; } ///< some numbers lie outside
};

/// The attribute of that name that has numbers at all: of faces, else of wedges, else of vertices; or null.
[[nodiscard]] const Attribute* attribute_to_show(const Mesh& mesh, const std::string& name);

/// The range of the finite values of the attribute's first component over the parts that `shows` takes
/// (empty: all), where it holds numbers, not identifiers. Each element counts once. O(n).
[[nodiscard]] ValueRange value_range(const Scene& scene, const std::string& attribute,
                                     const ColourRange& wanted,
                                     const std::function<bool(const Part&)>& shows);

} // namespace facetmill
