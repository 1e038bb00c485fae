#pragma once
// Vertices of a file whose coordinates are not finite numbers, which no algorithm can work with.

#include "io/text.hpp"
#include "mesh/scene.hpp"

#include <cstddef>

namespace facetmill::io {

/// The hint of E-NAN.
inline constexpr const char* drop_not_finite_hint =
    "load: {not_finite: drop} leaves out such vertices and the faces at them";

/// The next number of the text: a finite one, or any that is to be looked at later.
inline double coordinate(Text& text, const char* what, bool any) {
    return any ? text.real(what) : text.coordinate(what);
}

/// Of the vertices that were left out.
struct NotFinite {
    std::size_t vertices = 0, faces = 0, lines = 0;
    std::size_t first = 0; ///< number of the first vertex in the part, as it was read
};

/// Leaves out the vertices of the part whose coordinates are not finite, with the faces and lines that use
/// them. All else keeps its order and its attributes; nothing is copied when there are none.
NotFinite drop_not_finite(Part& part);

} // namespace facetmill::io
