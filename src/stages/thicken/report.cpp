#include "stages/thicken/report.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "mesh/unit_text.hpp"

#include <fmt/format.h>

namespace facetmill::thicken_stage {

namespace {

/// Reads a member of the surface's result, if the part is a surface.
template <class T>
auto of_surface(T ThickenResult::*member) {
    return [member](const ThickenedPart& part) {
        const auto* surface = std::get_if<ThickenedSurface>(&part);
        return surface ? std::optional<T>(surface->result.*member) : std::nullopt;
    };
}
std::optional<ThickenResult::Wall> wall_of(const ThickenedPart& part) {
    const auto* surface = std::get_if<ThickenedSurface>(&part);
    return surface ? surface->result.wall : std::nullopt;
}

void declare_wall(DeclareFields<ThickenResult::Wall>& d) {
    d.field("min", &ThickenResult::Wall::thinnest, "The smallest thickness.").unit("scene units");
    d.field("mean", &ThickenResult::Wall::mean, "The mean thickness.").unit("scene units");
}

void declare_hole(DeclareFields<DrainHole>& d) {
    d.field("from", &DrainHole::from, "The start of its axis, in the cavity.").unit("scene units");
    d.field("to", &DrainHole::to, "The end of its axis, outside.").unit("scene units");
    d.field("vent", &DrainHole::vent, "Whether the hole is a vent at the highest point.");
}

/// Reads a member of the result of drain, if there is one.
template <class T>
auto of_drain(T DrainResult::*member) {
    return [member](const ThickenedPart& part) {
        const auto* surface = std::get_if<ThickenedSurface>(&part);
        return surface && surface->drained ? std::optional<T>((*surface->drained).*member) : std::nullopt;
    };
}

void declare_drained(DeclareFields<ThickenedPart>& d) {
    constexpr const char* drain = "drain is given";
    d.list("drain_holes", of_drain(&DrainResult::holes), "Each hole that drain makes.", declare_hole)
        .only_when(drain);
    d.field("cavities", of_drain(&DrainResult::cavities), "The cavities of the solid.").only_when(drain);
    d.field("closed_cavities", of_drain(&DrainResult::closed_cavities), "Cavities without a hole.")
        .only_when(drain);
}

void declare_part(DeclareFields<ThickenedPart>& d) {
    constexpr const char* surface = "a surface got a thickness";
    d.field(
        "part", [](const ThickenedPart& p) { return std::visit([](const auto& x) { return x.part; }, p); },
        "The name of the part.");
    d.field("wall_faces", of_surface(&ThickenResult::wall_faces), "Faces of the walls along boundary edges.")
        .only_when(surface);
    d.field("limited_vertices", of_surface(&ThickenResult::limited), "Vertices that miter_limit limited.")
        .only_when(surface);
    d.field("unmoved_vertices", of_surface(&ThickenResult::still),
            "Vertices that did not move because they have no normal.")
        .only_when(surface);
    d.field("unbalanced_edges", of_surface(&ThickenResult::unbalanced),
            "Edges where the solid stays open because the surface is not oriented.")
        .only_when(surface);
    d.field("filled_components", of_surface(&ThickenResult::filled),
            "Closed components that became solid because they have no room for a cavity.")
        .only_when(surface);
    d.field("turned_faces", of_surface(&ThickenResult::turned),
            "Faces of the front and the back that the offset inverted. The wall folds at these faces.")
        .only_when(surface);
    d.field("resolved", of_surface(&ThickenResult::resolved),
            "Whether self_intersections: resolve rebuilt the solid. If true, turned_faces is 0.")
        .only_when(surface);
    d.field("buried_components", of_surface(&ThickenResult::buried),
            "Closed components of the solid inside the walls of others.")
        .only_when(surface);
    d.object("wall_thickness", wall_of, "The wall thickness from the front to the back.", declare_wall)
        .only_when("a surface got a thickness and is not filled");
    const auto pairs = [](const ThickenedPart& p) {
        const auto* s = std::get_if<ThickenedSurface>(&p);
        return s && s->looked && s->has_faces ? std::optional(s->result.self_intersections) : std::nullopt;
    };
    d.field("self_intersections", pairs, "Pairs of faces that intersect. Pairs that only touch do not count.")
        .only_when("self_intersections is not ignore and the part has faces")
        .null_when("the search was skipped because the part is smaller than its thickness");
    declare_drained(d);
    constexpr const char* edges = "edges became cylinders";
    d.field("cylinders", where_it_is(&ThickenedEdges::cylinders), "Edges that became cylinders.")
        .only_when(edges);
    d.field("without_length", where_it_is(&ThickenedEdges::without_length),
            "Edges of length 0, which get no cylinder.")
        .only_when(edges);
}

std::string line_of(const ThickenedEdges& edges) {
    return fmt::format("{}: {}", edges.part, counted(edges.cylinders, "cylinder"));
}

std::string line_of(const ThickenedSurface& surface) {
    const ThickenResult& r = surface.result;
    std::string line = surface.part + ":";
    if (r.wall)
        line += fmt::format(" wall thickness at least {0:.6g} {2}, mean {1:.6g} {2},", r.wall->thinnest,
                            r.wall->mean, unit_text(surface.unit));
    if (r.filled > 0) line += fmt::format(" {} filled,", counted(r.filled, "component"));
    if (r.turned > 0) line += fmt::format(" {} turned over,", counted(r.turned, "face"));
    if (r.resolved) line += " folds resolved,";
    if (r.self_intersections)
        line += fmt::format(" {},", counted(*r.self_intersections, "self-intersection"));
    if (surface.drained) line += fmt::format(" {},", counted(surface.drained->holes.size(), "drain hole"));
    line.pop_back();
    return line;
}

} // namespace

void declare_thicken_report(DeclareFields<ThickenReport>& d) {
    d.list("parts", &ThickenReport::parts, "Every thickened part.", declare_part);
    d.tell([](const ThickenReport& report) {
        std::vector<std::string> lines;
        for (const auto& part : report.parts) {
            const auto* surface = std::get_if<ThickenedSurface>(&part);
            if (!surface || surface->has_faces)
                lines.push_back(std::visit([](const auto& p) { return line_of(p); }, part));
        }
        return lines;
    });
}

void warn_of_cavities(const Part& part, const DrainResult& drained, Context& context) {
    const auto warn = [&](const std::string& what, const char* hint) {
        context.warn("W-THICKEN-DRAIN", fmt::format("thicken: part '{}' {}", part.name, what), hint);
    };
    if (drained.failure)
        warn("gets no drain holes: " + *drained.failure,
             "use thicken: {self_intersections: resolve}, or clean the part first");
    else if (drained.cavities == 0)
        warn("has no cavity to drain", "use a smaller thickness, or leave drain out");
    else if (drained.closed_cavities > 0)
        warn(fmt::format("has {} that no drain hole fits into",
                         counted(drained.closed_cavities, "cavity", "cavities")),
             "give drain a smaller diameter");
}

void warn_of_walls(const Part& part, const ThickenResult& r, const WallAskedFor& wall,
                   const ThickenOptions& o, Context& context) {
    const double thickness = wall.thickness;
    const char* unit = unit_text(wall.unit);
    const bool resolves = o.self_intersections == ThickenOptions::SelfIntersections::resolve;
    const std::string way_out =
        resolves ? "" : "thicken: {self_intersections: resolve} rebuilds the solid without them; or ";
    if (r.unbalanced > 0)
        context.warn("W-THICKEN-OPEN",
                     fmt::format("thicken: part '{}' is open at {}, where its surface is not oriented",
                                 part.name, counted(r.unbalanced, "edge")),
                     "use orient first; a Moebius strip cannot be oriented");
    if (r.wall && r.wall->thinnest < 0.5 * thickness)
        context.warn(
            "W-THICKEN-THIN",
            fmt::format("thicken: the wall of part '{}' is only {:.6g} {} thick instead of {:.6g} {}",
                        part.name, r.wall->thinnest, unit, thickness, unit),
            "the surface curves or folds within the thickness; try the other side or a smaller thickness");
    if (r.self_intersections.value_or(0) > 0)
        context.warn("W-THICKEN",
                     fmt::format("thicken: {} pairs of faces of part '{}' intersect", *r.self_intersections,
                                 part.name),
                     way_out + "use a smaller thickness, the other side, or a smoother surface (relax)");
    if (r.turned > 0)
        context.warn(
            "W-THICKEN",
            fmt::format("thicken: {} faces of the walls of part '{}' are inverted, the first at {}: there is "
                        "no room for {:.6g} {}",
                        r.turned, part.name, readable(*r.first_turned), thickness, unit),
            way_out +
                "use a smaller thickness, the other side, or larger and smoother faces (simplify, relax)");
    if (r.buried > 0)
        context.warn(
            "W-THICKEN",
            fmt::format("thicken: {} closed components of part '{}' lie inside the walls of others", r.buried,
                        part.name),
            way_out +
                "use a smaller thickness, or separate the components and thicken each of them (separate)");
    if (r.changed_topology)
        context.warn(
            "W-THICKEN-TOPOLOGY",
            fmt::format("thicken: a side of the wall of part '{}' has the Euler number {}, but its "
                        "surface has {}: holes, handles or pieces appeared or vanished where walls meet",
                        part.name, r.changed_topology->side, r.changed_topology->surface),
            "look at the cavity with section, and use a smaller thickness if it is not as expected");
    if (o.looks() && !r.self_intersections)
        context.warn("W-THICKEN",
                     fmt::format("thicken: part '{}' is smaller than its thickness, {:.6g} {}, so "
                                 "self-intersections were not searched for",
                                 part.name, thickness, unit),
                     "check the unit of the thickness");
}

} // namespace facetmill::thicken_stage
