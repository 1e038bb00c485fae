#include "stages/section/options.hpp"

#include "base/math/portable_math.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"

#include <fmt/format.h>

namespace facetmill::section_stage {

namespace {

void declare_hatch(Declare<HatchOption>& d) {
    d.option("spacing", &HatchOption::spacing, "The distance between lines.")
        .also_called("layer_height layer step distance interval")
        .above(0)
        .primary();
    d.option("angle", &HatchOption::angle, "The angle from the frame's u axis to the lines, anticlockwise.");
    d.choice<polygon::Keep>(
        "keep", &HatchOption::keep,
        {{"inside", polygon::Keep::inside, "the area inside the section"},
         {"outside", polygon::Keep::outside, "the area around the section, within its bounds"}},
        "The area to hatch.");
}

void declare_layout(Declare<SectionOptions>& d) {
    using Kind = io::DrawingLayout::Kind;
    d.choice<Kind>(
         "layout", &SectionOptions::layout,
         {{"sheets", Kind::sheets, "sections next to each other, filled"},
          {"contours", Kind::contours, "lines over each other, labelled with their heights, as in a map"},
          {"profile", Kind::profile,
           "lines of vertical sections: chainage from 0 to the right, elevation upward"}},
         "How SVG and DXF arrange the sections. Contours and profiles are lines, so an open surface "
         "gives no warning.")
        .also_called("arrange overlay");
    d.option("scale", &SectionOptions::scale, "The print scale: 500 makes an SVG at 1:500.")
        .also_called("map_scale")
        .above(0);
    d.option("exaggeration", &SectionOptions::exaggeration,
             "The vertical exaggeration of profiles in SVG and DXF: 5 draws heights five times as large.")
        .also_called("vertical_exaggeration z_scale")
        .above(0);
}

} // namespace

void declare_section(Declare<SectionOptions>& d) {
    d.group("plane", &SectionOptions::plane, "The plane, or the first plane of a stack. Default: z=50%.",
            declare_plane)
        .also_called(plane_synonyms, plane_is)
        .primary();
    d.option("spacing", &SectionOptions::spacing,
             "The distance between the planes of a stack, along the normal.")
        .also_called("layer_height layer step distance interval")
        .above(0);
    d.option("count", &SectionOptions::count,
             "The number of planes. With spacing, the stack starts at the plane. Without spacing, the extent "
             "is divided into this many equal slices, with a plane in the middle of each.")
        .also_called("slices number layers")
        .between(1, max_planes);
    d.group("hatch", &SectionOptions::hatch,
            "Hatches the sections with parallel lines. Give true, or a map of options.", declare_hatch)
        .option()
        .may_be_true = true;
    declare_layout(d);
    d.option("path", &SectionOptions::path,
             "The drawing to write, to scale, or a list of drawings. The suffix selects the format: .svg, "
             ".dxf, .geojson (lines in world coordinates) or .json.")
        .also_called(path_synonyms);
}

void verify_section(const SectionOptions& o, const Value& given, Problems& problems) {
    if (o.plane) verify_plane(*o.plane, given.mark, problems);
    if (given.find("exaggeration") && o.layout != io::DrawingLayout::Kind::profile)
        add_refusal(needs("exaggeration", "layout: profile"), "section", given, problems);
    for (const auto& path : o.path)
        if (!io::is_drawing(path.text))
            problems.add(mark_at(given, "path"), "E-DRAWING",
                         fmt::format("section: '{}' is not a supported drawing format", path.text),
                         "use .svg, .dxf, .geojson or .json");
}

polygon::HatchSettings resolve_hatch(const HatchOption& option, const Scene& scene, Context& context) {
    const double spacing = context.resolve(option.spacing, scene, "hatch.spacing");
    if (!(spacing > 0))
        throw Error(ErrorKind::stage, "E-HATCH", "the spacing of 'hatch' is 0 in this scene",
                    "the bounding box has no extent: give a length in scene units");
    return {.spacing = spacing,
            .direction = {cosine(option.angle.radians), sine(option.angle.radians)},
            .keep = option.keep};
}

} // namespace facetmill::section_stage
