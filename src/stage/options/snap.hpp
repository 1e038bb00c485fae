#pragma once
// The option that treats nearby vertices as on a plane or outline.

#include "options/declaration.hpp"
#include "stage/context.hpp"

#include <string>

namespace facetmill {

enum class Snap { automatic, none };

/// Declares snap. what: "a plane", "the outline".
template <class S>
void declare_snap(Declare<S>& d, Snap S::*snap, const std::string& what) {
    d.template choice<Snap>(
         "snap", snap,
         {{"auto", Snap::automatic,
           "32-bit float positions count as on " + what +
               " if their rounding error explains the distance, because 0.1 in an STL differs slightly from "
               "0.1 in a pipeline. 64-bit positions count within four steps of a 64-bit float"},
          {"0", Snap::none, "only exact positions count"}},
         "The positions that count as on " + what + ".")
        .option()
        .schema = {{"enum", {"auto", "0", 0}}};
}

/// Vertices treated as on a plane or an outline.
struct Snapped {
    std::size_t vertices = 0;
    double by = 0;   ///< the largest distance
    double size = 0; ///< of the part: the diagonal of its bounds, in the same space
};

/// Warns (W-SNAPPED) if the distance is visible relative to the part's size. what: "the outline".
void warn_of_snapping(const std::string& part, const Snapped& snapped, const std::string& what,
                      Context& context);

} // namespace facetmill
