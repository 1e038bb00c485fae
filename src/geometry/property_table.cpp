#include "geometry/inspect.hpp"

namespace facetmill {

namespace {

template <class T>
Property number(std::string_view name, T Properties::*member, std::string_view help) {
    return {name, false, false, help, [member](const Properties& p) -> std::optional<double> {
                return static_cast<double>(p.*member);
            }};
}

template <class T>
Property number(std::string_view name, std::optional<T> Properties::*member, std::string_view help,
                bool costly = false) {
    return {name, false, costly, help, [member](const Properties& p) -> std::optional<double> {
                if (!(p.*member)) return {};
                return static_cast<double>(*(p.*member));
            }};
}

Property truth(std::string_view name, bool Properties::*member, std::string_view help) {
    return {name, true, false, help,
            [member](const Properties& p) -> std::optional<double> { return p.*member ? 1 : 0; }};
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
        number("euler", &P::euler,
               "V - E + F, without isolated vertices; 2 for a closed surface of genus 0 in one piece."),
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
        number("self_intersections", &P::self_intersections,
               "Pairs of faces that intersect, exactly; this one costs time.", true),
        number("area", &P::area, "Surface area, in square scene units."),
        number("volume", &P::volume,
               "Enclosed volume, in cubic scene units, negative when inside out; does not apply to an open "
               "surface."),
    };
}

std::vector<Property> with_qualities() {
    auto all = basic();
    for (std::size_t q = 0; q < quality_count; ++q) {
        const QualityInfo& info = info_of(static_cast<Quality>(q));
        all.push_back({info.name, info.join == Join::all, false, info.help,
                       [q](const Properties& p) { return p.qualities[q]; }, static_cast<Quality>(q)});
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
