#pragma once
// The options of section.

#include "geometry/section/section.hpp"
#include "io/drawing/drawing.hpp"
#include "stage/options/plane.hpp"
#include "stage/stage.hpp"

namespace facetmill::section_stage {

struct HatchOption {
    Length spacing = Length::percent(1);
    Angle angle = Angle::degrees(45);
    polygon::Keep keep = polygon::Keep::inside;
};

struct SectionOptions {
    std::optional<PlaneOption> plane;
    std::optional<Length> spacing;
    std::optional<std::int64_t> count;
    std::optional<HatchOption> hatch;
    io::DrawingLayout::Kind layout = io::DrawingLayout::Kind::sheets;
    double scale = 1, exaggeration = 1;
    std::vector<PathText> path;
};

void declare_section(Declare<SectionOptions>& d);
/// Checks planes, layouts and names of drawings, which the declaration cannot express.
void verify_section(const SectionOptions& o, const Value& given, Problems& problems);

/// The hatch lines of a scene; all sections of a stack share them. Throws a stage error (E-HATCH) if the
/// spacing resolves to 0.
[[nodiscard]] polygon::HatchSettings resolve_hatch(const HatchOption& option, const Scene& scene,
                                                   Context& context);

} // namespace facetmill::section_stage
