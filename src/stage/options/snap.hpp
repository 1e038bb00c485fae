#pragma once
// What counts as on a plane, or on the outline of a footprint.

#include "options/declaration.hpp"
#include "stage/context.hpp"

#include <optional>

namespace facetmill {

enum class Snap { automatic, none };

/// Declares snap. what: "a plane", "the outline".
template <class S>
void declare_snap(Declare<S>& d, Snap S::*snap, const std::string& what) {
    d.template choice<Snap>(
         "snap", snap,
         {{"auto", Snap::automatic,
           "positions that are 32-bit floats count as on " + what +
               " within one float's rounding of the part's bounds: the 0.1 of an STL is not the 0.1 of a "
               "pipeline; others within four roundings of a double"},
          {"0", Snap::none, "only what is exactly on it does"}},
         "What counts as on " + what + ".")
        .option()
        .schema = {{"enum", {"auto", "0", 0}}};
}

/// How far 32-bit floats are apart where the mesh is, when that may be seen beside its size and most of its
/// positions are such numbers; else none.
std::optional<double> seen_rounding(const Mesh& mesh);

/// Warns (W-SNAPPED) of vertices that count as on a plane or an outline though they may be that far away.
/// what: "the outline".
void warn_of_snapping(const std::string& part, std::size_t vertices, double apart, const std::string& what,
                      Context& context);

} // namespace facetmill
