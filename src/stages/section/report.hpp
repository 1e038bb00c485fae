#pragma once
// The report on a scene's sections: their sums, the scene's volume, and defects of the sections.

#include "io/drawing/drawing.hpp"
#include "options/fields.hpp"
#include "stage/context.hpp"

#include <functional>

namespace facetmill::section_stage {

/// The section by a single plane.
struct ReportedSection {
    using Listed = std::vector<std::reference_wrapper<const io::DrawnPart>>;

    double height = 0;
    Vec3 origin;
    double area = 0;
    std::size_t contours = 0;
    std::optional<Listed> parts; ///< parts with contours, unless these are too many
};

struct SectionReport {
    std::shared_ptr<const io::Drawing> drawing; ///< keeps the referenced sections alive
    std::size_t empty = 0, contours = 0, holes = 0, open = 0;
    std::size_t touched = 0;                         ///< contours that shrank to a point or line
    std::array<std::size_t, polygon::kinds> kinds{}; ///< counts of closed contours by kind
    double area = 0, length = 0;
    bool oriented = true;
    std::size_t inside_out = 0; ///< clockwise outlines
    std::vector<ReportedSection> sections;
    std::optional<double> spacing, area_times_spacing, ratio;
    std::optional<std::optional<double>> volume;
};
void declare_section_report(DeclareFields<SectionReport>& d);

/// The sums over the drawing. For a stack (spacing above 0, world units), also the areas times the spacing,
/// and the volume of the selected parts for comparison. volume: none if a part is not closed. Warns, unless
/// the layout is of lines, of contours that are open (W-OPEN-SECTION), reversed by nesting (W-UNORIENTED),
/// clockwise (W-INSIDE-OUT) or self-crossing (W-SECTION-CROSSES). is_closed: whether all selected parts are;
/// called if outlines are clockwise.
[[nodiscard]] SectionReport report_of(std::shared_ptr<const io::Drawing> drawing, double spacing,
                                      std::optional<double> volume, const std::function<bool()>& is_closed,
                                      Context& context);

} // namespace facetmill::section_stage
