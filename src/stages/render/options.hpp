#pragma once
// The options of render.

#include "geometry/render/render.hpp"
#include "stage/stage.hpp"

namespace facetmill {

struct RenderOptions {
    enum class Look { sides, one_sided, absolute, beside };
    enum class Ground { none, white, grey, black };

    PathText path;
    std::int64_t width = 1200, height = 900;
    Viewpoint view = Viewpoint::corner;
    std::optional<Vec3> from;
    Look shading = Look::sides;
    Paint colours = Paint::material;
    std::string attribute;
    EdgeLines edges = EdgeLines::few;
    Ground ground = Ground::none;
    double point = 3;
};

void declare_render(Declare<RenderOptions>& d);
/// What the declaration cannot say: other formats than PNG, and directions that are none.
void verify_render(const RenderOptions& o, const Value& given, Problems& problems);

/// Of the parts that the context selects; the shading of `beside` is the caller's to choose.
PictureSettings picture_settings(const RenderOptions& o, const Scene& scene, const Context& context);

} // namespace facetmill
