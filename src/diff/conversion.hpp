#pragma once
// Detects two scenes that differ only by a unit or an up axis.

#include "io/convert.hpp"

#include <string>

namespace facetmill::report {

/// The conventions of two scenes before the second was converted to the first.
struct Origin {
    io::Convention a, b;      ///< stated in the files
    io::Conversion of_second; ///< the applied conversion, from these and the command line
};

/// A hint if the boxes differ by a unit factor, a rotation about the axes, or both: "the bounding boxes match
/// if the first file is scaled by 0.001 ...". Empty if the boxes are equal, or no such conversion makes them
/// equal (corners within a hundredth of the diagonal). For conventions that a file does not state, the
/// command line's value may be wrong, so the hint refers to the original files. O(faces).
[[nodiscard]] std::string conversion_hint(const Scene& a, const Scene& b, const Origin& origin);

} // namespace facetmill::report
