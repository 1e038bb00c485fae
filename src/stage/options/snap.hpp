#pragma once
// The option that treats nearby vertices as on a plane or outline.

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
           "32-bit float positions count as on " + what +
               " within one float's rounding of the part's bounds, because 0.1 in an STL differs slightly "
               "from 0.1 in a pipeline. Other positions count within four roundings of a double"},
          {"0", Snap::none, "only exact positions count"}},
         "The positions that count as on " + what + ".")
        .option()
        .schema = {{"enum", {"auto", "0", 0}}};
}

/// The float32 step at the mesh's position, if it is visible relative to the mesh's size and most positions
/// are float32 numbers; otherwise none.
[[nodiscard]] std::optional<double> seen_rounding(const Mesh& mesh);

/// Warns (W-SNAPPED) about vertices that were up to this distance away and treated as on a plane or outline.
/// what: "the outline".
void warn_of_snapping(const std::string& part, std::size_t vertices, double apart, const std::string& what,
                      Context& context);

} // namespace facetmill
