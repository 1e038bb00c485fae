#pragma once
// What is left of a mesh outside a convex body that planes bound. For clip only.

#include "geometry/clip/clip.hpp"

namespace facetmill {

/// Clips by all planes at once: the front is what is in front of all of them, as the planes one after the
/// other would leave it, the back is all the rest. The mesh is first scored along the body's faces, and the
/// rest has the front's caps for its own, the other way round: so the two fit exactly, and with caps a closed
/// mesh gives two closed ones. settings.keep is back or both.
ClipResult clip_body(Mesh mesh, const ClipSettings& settings);

} // namespace facetmill
