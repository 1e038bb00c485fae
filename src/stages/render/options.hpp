#pragma once
// The options of render.

#include "geometry/render/render.hpp"
#include "stage/stage.hpp"

namespace facetmill {

struct RenderOptions {
    enum class Look { sides, one_sided, absolute, beside };
    enum class Ground { none, white, light, grey, dark, black };

    PathText path;
    std::optional<PathText> with;
    std::int64_t width = 1200, height = 900;
    Viewpoint view = Viewpoint::corner;
    std::vector<std::string> views;
    std::optional<Vec3> from;
    std::optional<Angle> perspective;
    std::optional<Vec3> at;
    std::optional<double> zoom;
    Look shading = Look::sides;
    ShadingNormals normals = ShadingNormals::automatic;
    bool occlusion = true, silhouettes = false, legend = true;
    Paint colours = Paint::material;
    std::string attribute, unit;
    ColourRange range;
    EdgeLines edges = EdgeLines::few;
    Ground ground = Ground::none;
    double point = 3;
};

void declare_render(Declare<RenderOptions>& d);
/// Checks formats other than PNG, directions, names of views and sizes of sheets, which the declaration
/// cannot express.
void verify_render(const RenderOptions& o, const Value& given, Problems& problems);

/// The pictures of the parts that the context selects, row by row, with the number per row. They share a
/// scale.
struct Shots {
    std::vector<PictureSettings> settings;
    std::size_t columns = 1;
};
[[nodiscard]] Shots shots_of(const RenderOptions& o, const Scene& scene, const PictureSettings& common);
/// The settings shared by all pictures of a scene.
[[nodiscard]] PictureSettings common_settings(const RenderOptions& o, const Scene& scene,
                                              const Context& context);

/// Converts "auto", "percentile", "all", or two numbers.
template <>
struct OptionType<ColourRange> {
    static constexpr OptionKind kind = OptionKind::range;
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, ColourRange& out, Problems& problems);
    static std::string print(const ColourRange& range);
    static Json schema();
    static std::optional<double> magnitude(const ColourRange&) { return {}; }
};

} // namespace facetmill
