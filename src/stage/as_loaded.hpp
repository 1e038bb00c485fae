#pragma once
// The scene as loaded, which stages compare with.

#include "mesh/surface.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// The surface of the scene after the last load; without faces where nothing was loaded. It lives as long as
/// the run holds it: until the next load.
inline const Surface& surface_as_loaded(Context& context) {
    static const Surface nothing;
    const Surface* loaded = context.loaded();
    return loaded ? *loaded : nothing;
}

} // namespace facetmill
