#include "stages/section/report.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "io/drawing/drawing_fields.hpp"

#include <fmt/format.h>

namespace facetmill::section_stage {

namespace {

constexpr const char* stack = "layout is sheets, and there are several planes or spacing is given";

void add(SectionReport& report, const Section& s) {
    report.area += s.area;
    report.touched += s.collapsed;
    report.oriented = report.oriented && s.oriented;
    report.contours += s.contours.size();
    report.inside_out += s.inside_out();
    for (const Contour& c : s.contours) {
        report.length += c.length;
        report.holes += c.role == ContourRole::hole;
        report.open += c.role == ContourRole::open;
        if (c.role != ContourRole::open) ++report.kinds[static_cast<std::size_t>(c.kind)];
    }
}

/// listed: the number of contours listed so far.
ReportedSection reported(const io::Sheet& sheet, std::size_t& listed) {
    constexpr std::size_t max_listed = 200; // JSON drawings list all contours
    ReportedSection section{sheet.height, sheet.frame.origin, 0, 0, {}};
    ReportedSection::Listed parts;
    for (const auto& part : sheet.parts) {
        const std::size_t count = part.section.contours.size();
        section.area += part.section.area;
        section.contours += count;
        listed += count;
        if (listed <= max_listed && count > 0) parts.emplace_back(part);
    }
    if (!parts.empty()) section.parts = std::move(parts);
    return section;
}

void add_volume(SectionReport& report, double spacing, std::optional<double> volume) {
    report.spacing = spacing;
    report.area_times_spacing = report.area * spacing;
    report.volume = volume;
    if (volume && *volume != 0) report.ratio = *report.area_times_spacing / *volume;
}

constexpr const char* hint_for_open = "use only the lines of a terrain or a sheet, which has no inside, or "
                                      "make it a solid with thicken; close the "
                                      "holes of a solid with clean: {holes: minimal}";

/// In an open surface, a clockwise outline may be a pit of a terrain.
void warn_of_clockwise(const SectionReport& report, bool closed, Context& context) {
    const bool one = report.inside_out == 1;
    const std::string outlines = counted(report.inside_out, "outline");
    const char* runs =
        one ? "runs clockwise, so its area is negative" : "run clockwise, so their areas are negative";
    if (closed)
        context.warn("W-INSIDE-OUT",
                     fmt::format("{} {}: the mesh is inside out where the plane cuts it", outlines, runs),
                     "use orient first");
    else if (report.open == 0)
        context.warn("W-OPEN-SECTION",
                     fmt::format("{} {}: the mesh is open, so the area may be meaningless", outlines, runs),
                     hint_for_open);
}

void warn(const SectionReport& report, const std::function<bool()>& is_closed, Context& context) {
    if (report.open > 0)
        context.warn("W-OPEN-SECTION",
                     fmt::format("{} of {} open: the mesh has a boundary where the plane cuts it",
                                 report.open, counted(report.contours, "contour")),
                     hint_for_open);
    if (!report.oriented)
        context.warn("W-UNORIENTED",
                     "neighbouring faces are inconsistent, so nesting decided which contours are outlines "
                     "and which are holes",
                     "use orient first");
    if (report.inside_out > 0) warn_of_clockwise(report, report.open == 0 && is_closed(), context);
    const auto crossed = report.kinds[static_cast<std::size_t>(polygon::Kind::self_intersecting)];
    if (crossed > 0)
        context.warn("W-SECTION-CROSSES",
                     fmt::format("{} {} around counts as inside", counted(crossed, "contour"),
                                 crossed == 1 ? "intersects itself: every region that it winds"
                                              : "intersect themselves: every region that they wind"),
                     "use clean: {self_intersections: all} first, to unite overlapping bodies");
}

// --- fields

void declare_kinds(DeclareFields<SectionReport>& d) {
    for (int k = 0; k < polygon::kinds; ++k)
        d.field(
            polygon::to_string(static_cast<polygon::Kind>(k)),
            [k](const SectionReport& r) { return r.kinds[static_cast<std::size_t>(k)]; },
            "The number of contours of this kind.");
}

void declare_part(DeclareFields<std::reference_wrapper<const io::DrawnPart>>& d) {
    const auto section = [](const io::DrawnPart& part) -> const Section& { return part.section; };
    d.embed(section, io::declare_section_fields);
    d.field("part", &io::DrawnPart::name, "The name of the part.");
}

void declare_sheet(DeclareFields<ReportedSection>& d) {
    d.field("height", &ReportedSection::height, "The distance from the first plane, along the normal.")
        .unit("scene units");
    d.field("origin", &ReportedSection::origin, "The origin of the plane's frame, in world space.");
    d.field("area", &ReportedSection::area, "The area of all parts.").unit("square scene units");
    d.field("contours", &ReportedSection::contours, "The area of all parts.");
    d.list("parts", &ReportedSection::parts, "The sections of single parts.", declare_part)
        .only_when("the plane has contours and is among the first 200 planes");
}

std::optional<SectionFrame> first_frame(const SectionReport& r) {
    return r.drawing && !r.drawing->sheets.empty() ? std::optional(r.drawing->sheets.front().frame)
                                                   : std::nullopt;
}

// --- lines

/// A count with its noun; empty for 0.
std::string some(std::size_t n, const char* one, const char* several) {
    return n == 0 ? std::string() : grouped(n) + " " + noun_for(n, one, several);
}

std::vector<std::string> lines_of(const SectionReport& r) {
    const Unit known = r.drawing->unit;
    const std::string in = known == Unit::unknown ? "" : std::string(" ") + to_string(known);
    std::string what = some(r.contours, "contour", "contours");
    const bool lines_only = r.drawing->layout.is_of_lines();
    if (r.empty > 0 && lines_only) what = join_texts({what, fmt::format("{} empty", grouped(r.empty))});
    if (lines_only)
        return {fmt::format("{}: length {}{}, {}", some(r.sections.size(), "section", "sections"),
                            readable(r.length), in, what)};
    const std::string of = join_texts({some(r.holes, "hole", "holes"), some(r.open, "open", "open")});
    if (!of.empty()) what += " (" + of + ")";
    if (r.empty > 0) what = join_texts({what, fmt::format("{} empty", grouped(r.empty))});
    std::vector<std::string> lines{fmt::format("{}: area {}{}{}, {}",
                                               some(r.sections.size(), "section", "sections"),
                                               readable(r.area), in, in.empty() ? "" : "2", what)};
    const auto& parts = r.sections[0].parts;
    if (r.sections.size() == 1 && parts && parts->size() == 1 && parts->front().get().section.moments) {
        const Section& section = parts->front().get().section;
        const auto& m = *section.moments;
        lines.push_back(fmt::format("centroid {}, second moments about it {} to {}{}{}",
                                    readable(section.frame.point(m.centroid)), readable(m.axes.smallest),
                                    readable(m.axes.largest), in, in.empty() ? "" : "4"));
    }
    if (r.spacing) {
        std::string line = fmt::format("areas times spacing {}", readable(r.area_times_spacing));
        if (*r.volume) line += fmt::format(", volume {}", readable(**r.volume));
        lines.push_back(line);
    }
    return lines;
}

} // namespace

void declare_section_report(DeclareFields<SectionReport>& d) {
    d.field(
        "planes", [](const SectionReport& r) { return r.sections.size(); }, "The number of planes.");
    d.field("empty", &SectionReport::empty, "Planes that do not intersect the scene.");
    d.field("contours", &SectionReport::contours, "Contours in all planes.");
    d.field("holes", &SectionReport::holes, "Contours that are holes.");
    d.field("open", &SectionReport::open, "Contours that are not closed.");
    d.field("touched", &SectionReport::touched,
            "Contours that are only a point or a line, where the plane touches the mesh.");
    const auto self = [](const SectionReport& r) -> const SectionReport& { return r; };
    d.object("kinds", self, "Closed contours, counted by kind.", declare_kinds);
    d.field("area", &SectionReport::area, "The area in all planes, with holes subtracted.")
        .unit("square scene units");
    d.field("length", &SectionReport::length, "The length of all contours.").unit("scene units");
    d.object("frame", first_frame, "The area in the first plane.", io::declare_frame_fields)
        .only_when("the section has a plane");
    d.list("sections", &SectionReport::sections, "The section of each plane.", declare_sheet);
    d.field("spacing", &SectionReport::spacing, "The distance between the planes.")
        .unit("scene units")
        .only_when(stack);
    d.field("area_times_spacing", &SectionReport::area_times_spacing,
            "An estimate of the volume: the sum of areas times spacing.")
        .unit("cubic scene units")
        .only_when(stack);
    d.field("volume", &SectionReport::volume, "The volume of the parts.")
        .unit("cubic scene units")
        .only_when(stack)
        .null_when("a part is not closed");
    d.field("ratio", &SectionReport::ratio, "The estimate divided by the volume.")
        .only_when("the section has several planes and the volume is known");
    d.tell(lines_of);
}

SectionReport report_of(std::shared_ptr<const io::Drawing> drawing, double spacing,
                        std::optional<double> volume, const std::function<bool()>& is_closed,
                        Context& context) {
    SectionReport report;
    std::size_t listed = 0;
    for (const auto& sheet : drawing->sheets) {
        const std::size_t before = report.contours;
        for (const auto& part : sheet.parts) add(report, part.section);
        report.empty += report.contours == before;
        report.sections.push_back(reported(sheet, listed));
    }
    report.drawing = std::move(drawing);
    if (spacing > 0) add_volume(report, spacing, volume);
    if (!report.drawing->layout.is_of_lines()) warn(report, is_closed, context);
    return report;
}

} // namespace facetmill::section_stage
