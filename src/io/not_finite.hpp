#pragma once
// Vertices with coordinates that are not finite, which no algorithm can process.

#include "io/text.hpp"
#include "mesh/scene.hpp"

#include <cstddef>

namespace facetmill::io {

/// The hint of E-NAN.
inline constexpr const char* drop_not_finite_hint =
    "load: {not_finite: drop} leaves out such vertices and the faces at them";

/// The next coordinate of the text. It must be finite, unless the caller checks it later (any).
[[nodiscard]] inline double coordinate(Text& text, const char* what, bool any) {
    return any ? text.real(what) : text.coordinate(what);
}

/// Counts of dropped vertices, faces and lines.
struct NotFinite {
    std::size_t vertices = 0, faces = 0, lines = 0;
    std::size_t first = 0; ///< number of the first vertex, in the part as read
};

/// Drops the part's vertices with coordinates that are not finite, and the faces and lines that use them.
/// Everything else keeps its order and attributes. Copies nothing if all vertices are finite.
[[nodiscard]] NotFinite drop_not_finite(Part& part);

} // namespace facetmill::io
