#include "stages/measure/report.hpp"

#include "base/math/portable_math.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/measure/statistics_fields.hpp"
#include "geometry/polygon/polygon.hpp"
#include "geometry/triangulate/face_kinds_fields.hpp"
#include "io/rows.hpp"
#include "stages/measure/robot_text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::measure_stage {

namespace {

constexpr double degrees = 180 / pi;
constexpr const char* unknown =
    "there is nothing to measure, or the result is outside the range of 64-bit floats";

std::optional<Vec3> known_point(bool known, const Vec3& p) {
    return known && is_finite(p) ? std::optional(p) : std::nullopt;
}

/// amount: the area or volume of the body with this inertia, at density 1.
std::optional<PrincipalInertia> principal(const Symmetric& i, double amount, double density) {
    if (!is_finite({i.xx, i.yy, i.zz}) || !is_finite({i.xy, i.xz, i.yz})) return {};
    const Eigen3 e = eigen(i);
    PrincipalInertia p;
    p.axes = e.vectors;
    for (std::size_t k = 0; k < 3; ++k) {
        p.moments[k] = e.values[k] * density;
        const double square = amount != 0 ? e.values[k] / amount : 0;
        // Bodies with area or volume have nonzero moments, except below the range of doubles.
        if (square > 0)
            p.radii[k] = std::sqrt(square);
        else if (amount == 0)
            p.radii[k] = 0;
    }
    return p;
}

std::array<Vec3, 3> rows_of(const Symmetric& m, double factor) {
    return {Vec3{m.xx, m.xy, m.xz} * factor, Vec3{m.xy, m.yy, m.yz} * factor,
            Vec3{m.xz, m.yz, m.zz} * factor};
}

// --- fields

void declare_principal(DeclareFields<PrincipalInertia>& d) {
    using P = PrincipalInertia;
    d.field("moments", &P::moments, "The principal moments of inertia, in ascending order.");
    d.field("axes", &P::axes, "The directions of the principal axes, a right-handed frame.");
    d.field("radii_of_gyration", &P::radii,
            "The radii of gyration about the principal axes. Null when too small for a 64-bit float.")
        .unit("scene units");
}

constexpr const char* out_of_range = "the moments are outside the range of 64-bit floats";

void declare_shell(DeclareFields<ShellMass>& d) {
    d.field("area", &ShellMass::area, "The area of the surface.").unit("square scene units");
    const auto centroid = [](const ShellMass& s) { return known_point(s.area > 0, s.centroid); };
    d.field("centroid", centroid, "The centroid of the surface, weighted by area.").null_when(unknown);
    const auto inertia = [](const ShellMass& s) { return rows_of(inertia_of(s.spread), 1); };
    d.field("inertia", inertia,
            "The inertia tensor about the centroid, as three rows, with a mass of 1 per square scene unit.");
    const auto of_shell = [](const ShellMass& s) { return principal(inertia_of(s.spread), s.area, 1); };
    d.object("principal", of_shell,
             "The principal moments and axes of the surface. For a planar polygon: its smallest and largest "
             "second moments of area, and their sum, the polar moment about the normal.",
             declare_principal)
        .null_when(out_of_range);
}

void declare_solid(DeclareFields<MeasuredSolid>& d) {
    d.field("volume", &MeasuredSolid::volume,
            "The volume. Negative if the surface is inside out. Space in several shells counts once.")
        .unit("cubic scene units");
    d.field("mass", &MeasuredSolid::mass, "The volume times the density.");
    d.field("centroid", &MeasuredSolid::centroid, "The centroid of the volume.").null_when(unknown);
    d.field("inertia", &MeasuredSolid::inertia, "The inertia tensor about the centroid, as three rows.");
    d.object("principal", &MeasuredSolid::principal, "The principal moments and axes.", declare_principal)
        .null_when(out_of_range);
}

NamedCounts kinds_of(const FaceResult& faces) {
    NamedCounts counts;
    for (int k = 0; k < polygon::kinds; ++k) {
        const auto kind = static_cast<polygon::Kind>(k);
        if (faces.kinds.count(kind) > 0)
            counts.emplace_back(polygon::to_string(kind), faces.kinds.count(kind));
    }
    return counts;
}

void declare_faces(DeclareFields<FaceResult>& d) {
    std::vector<std::string> names;
    names.reserve(polygon::kinds);
    for (int k = 0; k < polygon::kinds; ++k)
        names.push_back(polygon::to_string(static_cast<polygon::Kind>(k)));
    d.object("area", &FaceResult::area, "The areas of the faces.", statistics_fields("square scene units"));
    d.object("angle", &FaceResult::angle, "The inner angles of the faces.",
             statistics_fields("degrees", degrees));
    d.object("aspect_ratio", &FaceResult::aspect_ratio,
             "The aspect ratios of the triangles: the longest edge over the inradius, scaled to 1 for an "
             "equilateral triangle.",
             statistics_fields());
    d.field(
         "signed_area", &FaceResult::signed_area,
         "The signed areas of the faces projected along x, y and z, added up. Faces that run anticlockwise, "
         "seen from the positive side of the axis, count as positive. Zero for a closed surface.")
        .unit("square scene units");
    d.counts("kinds", kinds_of, names, "The number of faces of each kind that occurs.");
    d.field(
        "non_planar", [](const FaceResult& f) { return f.kinds.non_planar; },
        "Faces with a corner farther from their plane than float32 rounding can explain.");
    d.field(
         "farthest_from_plane", [](const FaceResult& f) { return f.kinds.deviation; },
         "The largest distance of a corner from the plane of its face.")
        .unit("scene units");
}

void declare_edges(DeclareFields<EdgeResult>& d) {
    d.object("length", &EdgeResult::length, "The lengths of the edges.", statistics_fields("scene units"));
    d.object("turn", &EdgeResult::turn,
             "The angles between the normals of the two faces at each edge, negative at concave edges.",
             statistics_fields("degrees", degrees));
    d.field("convex", &EdgeResult::convex, "Convex edges.");
    d.field("concave", &EdgeResult::concave, "Concave edges.");
    d.field("flat", &EdgeResult::flat, "Edges between coplanar faces.");
    d.field("feature", &EdgeResult::feature,
            "Convex or concave edges whose angle is larger than feature_angle.");
    d.field("boundary", &EdgeResult::boundary, "Edges with one face.");
    d.field("non_manifold", &EdgeResult::non_manifold, "Edges with three or more faces.");
}

void declare_curvature(DeclareFields<CurvatureResult>& d) {
    d.object("gaussian", &CurvatureResult::of_gaussian,
             "The Gaussian curvature of vertices that are not on a boundary.",
             statistics_fields("per square scene unit"));
    d.object("mean", &CurvatureResult::of_mean,
             "The mean curvature of vertices that are not on a boundary. Positive where the surface bulges "
             "outward.",
             statistics_fields("per scene unit"));
    d.field(
        "total_in_turns", [](const CurvatureResult& c) { return c.total / (2 * pi); },
        "The sum of the angle defects of all vertices, in full turns. It is the Euler number of a manifold.");
}

void declare_attribute(DeclareFields<KeptAttribute>& d) {
    d.field("name", &KeptAttribute::name, "The name of the part.");
    d.field("of", &KeptAttribute::elements, "The elements that have the attribute: faces or vertices.");
    d.field("unit", &KeptAttribute::unit, "The unit of the values. Empty if they have no unit.");
    d.field("missing", &KeptAttribute::missing, "Faces or vertices without a value.");
    d.object("values", &KeptAttribute::values, "Statistics of the other values.", statistics_fields(""));
}

constexpr const char* open = "the surface is open, or its shells overlap and could not be united";

void declare_part(DeclareFields<MeasuredPart>& d) {
    d.field("part", &MeasuredPart::part, "The name of the part.");
    d.object("shell", &MeasuredPart::shell, "The surface without thickness.", declare_shell);
    d.object("solid", &MeasuredPart::solid, "The inside, filled with the density.", declare_solid)
        .null_when(open);
    d.object("faces", &MeasuredPart::faces, "Statistics of the faces.", declare_faces);
    d.object("edges", &MeasuredPart::edges, "Statistics of the edges.", declare_edges);
    d.object("curvature", &MeasuredPart::curvature, "The curvature at the vertices.", declare_curvature);
    d.list("attributes", &MeasuredPart::attributes, "The requested attributes, in the requested order.",
           declare_attribute);
}

void declare_total(DeclareFields<MeasureReport::Total>& d) {
    d.object("shell", &MeasureReport::Total::shell, "The surfaces of all parts.", declare_shell);
    d.object("solid", &MeasureReport::Total::solid, "The solids of all parts.", declare_solid)
        .null_when("a part is open, or the scene has no parts");
}

// --- lines

/// Example: "area 6 mm2, volume 1 mm3, centroid 0.5 0.5 0.5".
std::string mass_text(const ShellMass& shell, const std::optional<MeasuredSolid>& solid,
                      const MeasureReport& report) {
    const std::string unit = report.unit == "unknown" ? "" : " " + report.unit;
    std::string text = fmt::format("area {}{}", readable(shell.area), unit.empty() ? "" : unit + "2");
    if (!solid)
        return text + fmt::format(", open (no volume), centroid {}",
                                  readable(known_point(shell.area > 0, shell.centroid)));
    text += fmt::format(", volume {}{}", readable(solid->volume), unit.empty() ? "" : unit + "3");
    if (report.density != 1) text += ", mass " + readable(solid->mass);
    return text + fmt::format(", centroid {}", readable(solid->centroid));
}

/// Example: "wall_thickness 1.9 to 2 mm (mean 1.95), none at 12 faces".
std::string attribute_text(const KeptAttribute& kept) {
    const std::string unit = kept.unit.empty() ? "" : fmt::format(" in {}", kept.unit);
    const std::string range = kept.values.count > 0 ? range_text(kept.name.c_str(), kept.values) + unit
                                                    : fmt::format("{} nowhere", kept.name);
    return kept.missing == 0 ? range : fmt::format("{}, none at {} {}", range, kept.missing, kept.elements);
}

std::vector<std::string> lines_of(const MeasureReport& report) {
    constexpr std::size_t few = 5; // parts listed individually
    const auto& parts = report.parts;
    if (parts.empty()) return {"nothing to measure"};
    std::vector<std::string> lines{mass_text(report.total.shell, report.total.solid, report)};
    if (parts.size() > 1) {
        for (std::size_t i = 0; i < std::min(few, parts.size()); ++i)
            lines.push_back(parts[i].part + ": " + mass_text(parts[i].shell, parts[i].solid, report));
        if (parts.size() > few) lines.push_back(fmt::format("and {} more parts", parts.size() - few));
        return lines;
    }
    const EdgeResult& edges = parts[0].edges;
    lines.push_back(
        join_texts({range_text("edges", edges.length), range_text("angles", parts[0].faces.angle, degrees)}));
    lines.push_back(fmt::format("{} convex, {} concave, {} flat and {} boundary edges, {} feature edges",
                                readable(double(edges.convex)), readable(double(edges.concave)),
                                readable(double(edges.flat)), readable(double(edges.boundary)),
                                readable(double(edges.feature))));
    for (const KeptAttribute& kept : parts[0].attributes) lines.push_back(attribute_text(kept));
    std::erase(lines, "");
    return lines;
}

} // namespace

MeasuredSolid measured(const SolidMass& solid, double density) {
    const Symmetric i = inertia_of(solid.spread);
    return {solid.volume, solid.volume * density, known_point(solid.volume != 0, solid.centroid),
            rows_of(i, density), principal(i, solid.volume, density)};
}

void declare_measure_report(DeclareFields<MeasureReport>& d) {
    d.field("unit", &MeasureReport::unit, "The unit of the scene, or unknown.");
    d.field("density", &MeasureReport::density, "The given density.");
    d.object("total", &MeasureReport::total, "The results of all parts together.", declare_total);
    d.list("parts", &MeasureReport::parts, "The results of each part.", declare_part);
    d.tell(lines_of);
}

void warn_of_inside_out(const std::string& part, const MassResult& mass, Context& context) {
    if (mass.solid && mass.solid->volume < 0)
        context.warn("W-INSIDE-OUT",
                     fmt::format("part '{}' is inside out: its volume and inertia are negative", part),
                     "use orient to turn it outward");
}

void correct_for_shells(const std::string& part, const Mesh& mesh, MassResult& mass, Context& context) {
    if (!mass.solid) return;
    const double sum = mass.solid->volume;
    const auto shells = overlapping_shells(mesh, sum);
    if (!shells) return;
    mass.solid = shells->solid;
    const std::string result = mass.solid ? "the solid has " + readable(mass.solid->volume)
                                          : std::string("they could not be united, so no solid is reported");
    context.warn("W-SHELLS",
                 fmt::format("closed shells of part '{}' {} each other: the sum of their volumes, {}, counts "
                             "space several times; {}",
                             part, shells->unites ? "pass through" : "lie within", readable(sum), result),
                 shells->unites ? "use orient, then clean: {self_intersections: union}, to unite them"
                                : "use orient to turn inner shells inward, as cavities");
}

namespace {

std::string text_of(const MeasureTables& tables, const std::string& path, bool faces) {
    if (faces) return tables.faces;
    const io::RowFormat format = io::row_format(path);
    std::string text = tables.models.empty() ? "" : io::row_heading(tables.models.front(), format);
    for (const Json& row : tables.models) text += io::row_line(row, format);
    return text;
}

} // namespace

void write_results(const MeasureOptions& o, const MeasureReport& report, const MeasureTables& tables,
                   Context& context) {
    const Fields fields = fields_of<MeasureReport>(declare_measure_report);
    for (const auto& path : o.path) {
        const RobotFormat robot = robot_format(path);
        if (robot != RobotFormat::none && report.unit == to_string(Unit::unknown))
            context.warn("W-UNITS", fmt::format("the scene has no unit, so {} takes it as metres", path.text),
                         "use load: {unit: mm}");
        const std::string text = robot != RobotFormat::none ? robot_text(robot, report)
                                 : is_table(path)           ? text_of(tables, path.text, o.per == Per::face)
                                                            : fields.json(&report).dump(2) + "\n";
        context.output(path.text, std::as_bytes(std::span(text)));
    }
}

} // namespace facetmill::measure_stage
