#pragma once
// The scene as loaded, for comparison by stages.

#include "mesh/surface.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// The surface of the scene after the last load; without faces before the first load. The run owns it until
/// the next load.
inline const Surface& surface_as_loaded(Context& context) {
    static const Surface nothing;
    const Surface* loaded = context.loaded();
    return loaded ? *loaded : nothing;
}

} // namespace facetmill
