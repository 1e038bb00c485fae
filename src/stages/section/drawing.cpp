#include "stages/section/drawing.hpp"

#include "mesh/placement.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

constexpr double most_lines = 5e6;

/// Refuses to draw more lines than anybody can look at, or memory can hold.
void check_hatching(const std::vector<Section>& sections, double spacing) {
    double lines = 0;
    for (const Section& s : sections) {
        Box box;
        for (const Vec2& p : s.points) box.add(Vec3{p.x, p.y, 0});
        if (!box.empty()) lines += box.diagonal() / spacing;
    }
    if (!(lines <= most_lines))
        throw Error(ErrorKind::limit, "E-HATCH",
                    fmt::format("hatching all sections would take about {:.0f} lines, and at most {:.0f} "
                                "are drawn",
                                lines, most_lines),
                    "choose a larger spacing, or fewer planes");
}

} // namespace

Stack stack_for(const Scene& scene, const Plane& plane, const std::optional<Length>& given,
                const std::optional<std::int64_t>& count, Context& context) {
    if (!given && !count) return {};
    std::optional<double> spacing;
    if (given) spacing = context.resolve(*given, scene, "spacing");
    if (spacing && !(*spacing > 0))
        throw Error(ErrorKind::stage, "E-SECTION", "'spacing' must be above zero, and it is 0 in this scene",
                    "give a length in scene units, or count");
    Extent extent;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) extent.add(extent_along(plane, part.mesh, effective(part)));
    return stack_of(extent, spacing, count);
}

io::Drawing draw_sections(const Scene& scene, const Plane& plane, const Stack& stack,
                          const std::optional<polygon::HatchSettings>& hatching, Context& context) {
    io::Drawing drawing{context.name(), scene.unit, {}};
    const SectionFrame frame = frame_of(plane);
    for (const double h : stack.heights) {
        drawing.sheets.push_back({h, frame, {}});
        drawing.sheets.back().frame.origin += frame.normal * h;
    }
    for (const Part& part : scene.parts) {
        if (!context.selects(part, scene)) continue;
        auto sections = section(part.mesh, {plane, stack.heights, effective(part), part.cuts.get()});
        if (hatching && sections.size() > 1) check_hatching(sections, hatching->spacing);
        for (std::size_t k = 0; k < sections.size(); ++k) {
            std::vector<polygon::Segment> lines;
            if (hatching) lines = polygon::hatch(sections[k].filled(), *hatching);
            drawing.sheets[k].parts.push_back({part.name, std::move(sections[k]), std::move(lines)});
        }
    }
    return drawing;
}

} // namespace facetmill
