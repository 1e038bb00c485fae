#pragma once
// What counts as on a plane, or on the outline of a footprint.

#include "options/declaration.hpp"

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

} // namespace facetmill
