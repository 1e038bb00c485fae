#include "stages/section/options.hpp"

#include "base/math/portable_math.hpp"
#include "io/drawing/drawing.hpp"
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
    d.choice<polygon::Keep>("keep", &HatchOption::keep,
                            {{"inside", polygon::Keep::inside, "hatch the material"},
                             {"outside", polygon::Keep::outside, "hatch around it, within its bounds"}},
                            "Which parts of the lines are kept.");
}

} // namespace

void declare_section(Declare<SectionOptions>& d) {
    d.group("plane", &SectionOptions::plane, "The plane, or the first of a stack; z=50% unless given.",
            declare_plane)
        .also_called(plane_synonyms, plane_is)
        .primary();
    d.option("spacing", &SectionOptions::spacing,
             "The distance between the planes of a stack, along the normal.")
        .also_called("layer_height layer step distance interval")
        .above(0);
    d.option("count", &SectionOptions::count,
             "The number of planes: with spacing, starting at the plane; without it, in the middle of this "
             "many equal slices of the extent.")
        .also_called("slices number layers")
        .between(1, max_planes);
    d.group("hatch", &SectionOptions::hatch, "Parallel lines, clipped to the sections: true, or how.",
            declare_hatch)
        .option()
        .may_be_true = true;
    d.option("path", &SectionOptions::path,
             "The drawing to write, to scale, or a list of drawings; the suffix decides the format: .svg, "
             ".dxf or .json.")
        .also_called(path_synonyms);
}

void verify_section(const SectionOptions& o, const Value& given, Problems& problems) {
    if (o.plane) verify_plane(*o.plane, given.mark, problems);
    for (const auto& path : o.path)
        if (!io::is_drawing(path.text))
            problems.add(mark_at(given, "path"), "E-DRAWING",
                         fmt::format("section: drawings are not written as '{}'", path.text),
                         "the formats are .svg, .dxf and .json");
}

polygon::HatchSettings resolve_hatch(const HatchOption& option, const Scene& scene, Context& context) {
    const double spacing = context.resolve(option.spacing, scene, "hatch.spacing");
    if (!(spacing > 0))
        throw Error(ErrorKind::stage, "E-HATCH", "the spacing of 'hatch' comes to 0 in this scene",
                    "its bounding box has no extent: give a length in scene units");
    return {.spacing = spacing,
            .direction = {cosine(option.angle.radians), sine(option.angle.radians)},
            .keep = option.keep};
}

} // namespace facetmill::section_stage
