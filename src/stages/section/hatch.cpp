#include "stages/section/hatch.hpp"

#include "base/portable_math.hpp"

namespace facetmill {

void declare_hatch(Declare<HatchOption>& d) {
    d.option("spacing", &HatchOption::spacing, "The distance between lines.").above(0).primary();
    d.option("angle", &HatchOption::angle, "The angle from the frame's u axis to the lines, anticlockwise.");
    d.choice<polygon::Keep>("keep", &HatchOption::keep,
                            {{"inside", polygon::Keep::inside, "hatch the material"},
                             {"outside", polygon::Keep::outside, "hatch around it, within its bounds"}},
                            "Which parts of the lines are kept.");
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

} // namespace facetmill
