#pragma once
// What is said of the sections of a scene: their sums beside its volume, and what is wrong with them.

#include "io/drawing/drawing.hpp"
#include "options/fields.hpp"
#include "stage/context.hpp"

#include <functional>

namespace facetmill::section_stage {

/// What one plane cuts.
struct ReportedSection {
    using Listed = std::vector<std::reference_wrapper<const io::DrawnPart>>;

    double height = 0;
    Vec3 origin;
    double area = 0;
    std::size_t contours = 0;
    std::optional<Listed> parts; ///< those with contours, as long as there are few
};

struct SectionReport {
    std::shared_ptr<const io::Drawing> drawing; ///< what the sections refer to
    std::size_t empty = 0, contours = 0, holes = 0, open = 0;
    std::size_t touched = 0;                         ///< contours that shrank to a point or line
    std::array<std::size_t, polygon::kinds> kinds{}; ///< of closed contours
    double area = 0;
    bool oriented = true;
    std::size_t inside_out = 0; ///< outlines that run clockwise
    std::vector<ReportedSection> sections;
    std::optional<double> spacing, area_times_spacing, ratio;
    std::optional<std::optional<double>> volume;
};
void declare_section_report(DeclareFields<SectionReport>& d);

/// The sums over the drawing and, for a stack (spacing above 0, world units), the areas times spacing beside
/// the volume of the parts selected (none: a part is not closed). Warns of contours that are open
/// (W-OPEN-SECTION), turned by nesting (W-UNORIENTED), clockwise (W-INSIDE-OUT) or crossing themselves
/// (W-SECTION-CROSSES).
SectionReport report_of(std::shared_ptr<const io::Drawing> drawing, double spacing,
                        std::optional<double> volume, Context& context);

} // namespace facetmill::section_stage
