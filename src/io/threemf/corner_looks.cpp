#include "io/threemf/corner_looks.hpp"

#include "io/attributes.hpp"

#include <cmath>

namespace facetmill::io::threemf {

void CornerLooks::set(std::size_t corner, const Group& group, std::uint32_t index, const Kinds& kinds) {
    Look look;
    if (kinds.coloured) look.colour = group.colours[index];
    if (kinds.textured) look.point = {group.points[index][0], 1 - group.points[index][1]};
    for (float& x : look.point)
        if (std::isnan(x)) x = 0; // looks must have an order
    any_coloured_ = any_coloured_ || kinds.coloured;
    any_textured_ = any_textured_ || kinds.textured;
    const auto [at, fresh] = numbers_.try_emplace(look, static_cast<std::uint32_t>(looks_.size()));
    if (fresh) looks_.push_back(look);
    of_corner_[corner] = at->second;
}

void CornerLooks::add_to(Mesh& mesh) {
    if (!any_coloured_ && !any_textured_) return;
    const std::vector<std::uint64_t> keys(of_corner_.begin(), of_corner_.end());
    Wedges wedges = make_wedges(mesh.positions.size(), std::move(mesh.corners), keys);
    mesh.corners = std::move(wedges.corners);
    mesh.wedge_vertex = std::move(wedges.wedge_vertex);
    std::vector<std::uint8_t> colours;
    std::vector<float> points;
    for (const std::uint64_t key : wedges.keys) {
        const Look& look = looks_[key == no_key ? 0 : key];
        if (any_coloured_) colours.insert(colours.end(), look.colour.begin(), look.colour.end());
        if (any_textured_) points.insert(points.end(), look.point.begin(), look.point.end());
    }
    if (any_coloured_)
        mesh.attributes.push_back({"COLOR_0", Domain::wedge, Role::colour, 4, true, std::move(colours)});
    if (any_textured_)
        mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(points)});
}

} // namespace facetmill::io::threemf
