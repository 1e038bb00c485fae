#include "geometry/inspect/inspect.hpp"

namespace facetmill {

namespace {

using Kind = PropertyKind;

template <class T>
Property number(std::string_view name, T Properties::*member, std::string_view help,
                Kind kind = Kind::count) {
    return {name, kind, help, [member](const Properties& p) -> std::optional<double> {
                return static_cast<double>(p.*member);
            }};
}

template <class T>
Property number(std::string_view name, std::optional<T> Properties::*member, std::string_view help,
                Kind kind = Kind::count) {
    return {name, kind, help, [member](const Properties& p) -> std::optional<double> {
                if (!(p.*member)) return {};
                return static_cast<double>(*(p.*member));
            }};
}

Property truth(std::string_view name, bool Properties::*member, std::string_view help) {
    return number(name, member, help, Kind::truth);
}

Property costly(Property p) { return p.costly = true, p; }
Property of_scene(Property p) { return p.of_scene = true, p; }
Property of_either_sign(Property p) { return p.lowest = -HUGE_VAL, p; }

/// words: one for each value of the enumeration, in its order.
Property word(Property p, std::vector<std::string_view> words) {
    p.kind = Kind::word, p.words = std::move(words);
    return of_scene(std::move(p));
}

std::vector<std::string_view> units() {
    std::vector<std::string_view> words;
    for (const Unit u :
         {Unit::unknown, Unit::um, Unit::mm, Unit::cm, Unit::m, Unit::km, Unit::inch, Unit::foot})
        words.push_back(to_string(u));
    return words;
}

using P = Properties;

std::vector<Property> basic() {
    return {
        number("vertices", &P::vertices, "Points of the surface, isolated ones included."),
        number("wedges", &P::wedges, "Attribute tuples at vertices: what glTF calls vertices."),
        number("edges", &P::edges, "Pairs of vertices that some face runs along."),
        number("faces", &P::faces, "Polygons of the surface."),
        number("triangles", &P::triangles, "Faces of three corners."),
        number("components", &P::components, "Pieces connected through vertices."),
        of_either_sign(
            number("euler", &P::euler,
                   "V - E + F, without isolated vertices; 2 for a closed surface of genus 0 in one piece.")),
        number("genus", &P::genus,
               "Handles, summed over components, of a closed oriented manifold; else it does not apply."),
        number("boundary_loops", &P::boundary_loops, "Closed chains of boundary edges."),
        number("boundary_edges", &P::boundary_edges, "Edges with a face on one side only."),
        truth("closed", &P::closed, "At every edge the directions of its faces cancel."),
        truth("edge_manifold", &P::edge_manifold, "At most two faces at every edge."),
        truth("vertex_manifold", &P::vertex_manifold, "The faces around every vertex form one fan."),
        truth("oriented", &P::oriented, "Neighbouring faces agree about the outside."),
        number("degenerate_faces", &P::degenerate_faces, "Faces of exactly zero area."),
        number("duplicate_faces", &P::duplicate_faces, "Faces beyond the first with the same vertices."),
        number("isolated_vertices", &P::isolated_vertices, "Vertices that no face uses."),
        costly(number("self_intersections", &P::self_intersections,
                      "Pairs of faces that run into each other, exactly; this one costs time.")),
        costly(number("touching", &P::touching,
                      "Pairs of faces that touch at edges or corners that they do not share, and do not run "
                      "into each other there, exactly; costs the same time.")),
        number("area", &P::area, "Surface area, in square scene units.", Kind::number),
        of_either_sign(
            number("volume", &P::volume,
                   "Enclosed volume, in cubic scene units, negative when inside out; does not apply to an "
                   "open surface.",
                   Kind::number)),
        {"bounds", Kind::box,
         "The box around everything: its lowest corner at least {min: [x, y, z]}, its highest at most {max: "
         "[x, y, z]}.",
         [](const Properties&) { return std::optional<double>(); }},
        word(number("unit", &P::unit, "What the numbers of positions mean."), units()),
        word(number("up", &P::up, "Which axis points up."),
             {to_string(UpAxis::unknown), to_string(UpAxis::y), to_string(UpAxis::z)}),
        of_scene(number("materials", &P::materials, "How many materials there are.")),
        of_scene(number("parts", &P::parts, "How many parts there are.")),
    };
}

std::vector<Property> with_qualities() {
    auto all = basic();
    for (std::size_t q = 0; q < quality_count; ++q) {
        const QualityInfo& info = info_of(static_cast<Quality>(q));
        constexpr Kind kinds[] = {Kind::number, Kind::length, Kind::angle, Kind::count}; // by Measure
        const Kind kind =
            info.join == Join::all ? Kind::truth : kinds[static_cast<std::size_t>(info.measure)];
        Property p{info.name, kind, info.help, [q](const Properties& all) { return all.qualities[q]; }};
        p.quality = static_cast<Quality>(q);
        if (kind == Kind::angle) p.highest = 180;
        if (p.quality == Quality::aspect_ratio) p.lowest = 1;
        all.push_back(std::move(p));
    }
    return all;
}

} // namespace

const std::vector<Property>& property_table() {
    static const std::vector<Property> table =
        with_qualities(); // on first use: it needs another file's table
    return table;
}

const Property* property_named(std::string_view name) {
    for (const auto& p : property_table())
        if (p.name == name) return &p;
    return nullptr;
}

} // namespace facetmill
