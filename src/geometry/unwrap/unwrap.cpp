#include "geometry/unwrap/unwrap.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/text/readable_numbers.hpp"
#include "geometry/unwrap/charts.hpp"
#include "geometry/unwrap/hull.hpp"
#include "geometry/unwrap/lattice.hpp"
#include "geometry/unwrap/pack.hpp"
#include "mesh/separate_wedges.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using namespace unwrap_room;

/// Turns the longer side of the smallest rectangle around the chart along x, and moves it to the origin.
PackItem item_of(const UnwrapSurface& surface, Gluing& gluing, const Chart& chart) {
    FlatChart flat(surface, gluing, chart.faces);
    flat.start_from(gluing);
    PackItem out{flat.corners(), flat.points(), flat.border(), {}, 0};
    auto& points = out.points;
    std::vector<Vec2> outline;
    outline.reserve(out.border.size());
    for (const BorderEdge& e : out.border) outline.push_back(points[e.from]);
    const Vec2 u = axis_of_smallest_rectangle(convex_hull_of(outline));
    Vec2 low{HUGE_VAL, HUGE_VAL};
    for (Vec2& p : points) {
        p = {dot(u, p), cross(u, p)};
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    }
    for (Vec2& p : points) {
        p = p - low;
        out.size = {std::max(out.size.x, p.x), std::max(out.size.y, p.y)};
    }
    const auto& c = out.corners;
    for (std::size_t i = 0; i < c.size(); i += 3)
        out.area += cross(points[c[i + 1]] - points[c[i]], points[c[i + 2]] - points[c[i]]) / 2;
    return out;
}

/// Moves the points of all charts to their places, in steps of the lattice.
void place_items(std::vector<PackItem>& flat, const Packing& packing) {
    const double steps = lattice_steps / static_cast<double>(packing.texture);
    const std::size_t failed = parallel_reduce(
        flat.size(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t n = 0;
            for (std::size_t i = begin; i < end; ++i) {
                for (Vec2& p : flat[i].points) p = packing.place(packing.items[i], p) * steps;
                n += !round_to_lattice(flat[i].corners, flat[i].border, flat[i].points);
            }
            return n;
        },
        std::plus<>(), 16);
    if (failed > 0)
        throw Error(
            ErrorKind::limit, "E-UNWRAP-FINE",
            fmt::format("unwrap: float32 cannot hold the texture coordinates of {} charts, because "
                        "their faces are too small",
                        grouped(failed)),
            "remove tiny faces with clean or simplify first, or unwrap fewer parts at once with only");
}

void fill_layout(UnwrapLayout& layout, const UnwrapSurface& surface, const ChartSet& set,
                 const std::vector<PackItem>& flat) {
    const std::size_t faces = surface.face_count();
    std::vector<Index> mesh_of(faces), first_point(flat.size());
    for (Index m = 0; m + 1 < surface.mesh_begin.size(); ++m) {
        UnwrappedMesh& mesh = layout.meshes.emplace_back();
        const Index begin = surface.mesh_begin[m], count = surface.mesh_begin[m + 1] - begin;
        resize_large(mesh.coordinates, std::size_t{6} * count);
        resize_large(mesh.corner_point, std::size_t{3} * count);
        resize_large(mesh.face_chart, count);
        std::fill_n(mesh_of.begin() + begin, count, m);
    }
    std::size_t points = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
        first_point[i] = static_cast<Index>(points);
        points += flat[i].points.size();
    }
    parallel_for(
        flat.size(),
        [&](std::size_t i) {
            const Chart& chart = set.charts[i];
            for (std::size_t k = 0; k < chart.faces.size(); ++k) {
                const Index m = mesh_of[chart.faces[k]], f = chart.faces[k] - surface.mesh_begin[m];
                layout.meshes[m].face_chart[f] = static_cast<Index>(i);
                for (std::size_t j = 0; j < 3; ++j) {
                    const Index p = flat[i].corners[3 * k + j];
                    const Vec2& at = flat[i].points[p];
                    const std::size_t c = std::size_t{3} * f + j;
                    layout.meshes[m].corner_point[c] = first_point[i] + p;
                    layout.meshes[m].coordinates[2 * c] = static_cast<float>(at.x / lattice_steps);
                    layout.meshes[m].coordinates[2 * c + 1] =
                        static_cast<float>((lattice_steps - at.y) / lattice_steps);
                }
            }
        },
        16);
}

void measure_layout(UnwrapLayout& layout, const UnwrapSurface& surface, const ChartSet& set,
                    const std::vector<PackItem>& flat, const Packing& packing) {
    layout.charts = set.charts.size();
    layout.texture = packing.texture;
    const double texels = packing.scale * static_cast<double>(packing.cell);
    layout.texels_per_unit = texels / surface.unit;
    double squares = 0, area = 0, covered = 0;
    for (const Chart& chart : set.charts) {
        const UnwrapStretch& s = chart.measure.stretch;
        squares += chart.measure.area * s.l2 * s.l2;
        area += chart.measure.area;
        layout.stretch.largest = std::max(layout.stretch.largest, s.largest);
        layout.stretch.ratio = std::max(layout.stretch.ratio, s.ratio);
    }
    layout.stretch.l2 = area > 0 ? std::sqrt(squares / area) : 1;
    for (const PackItem& f : flat) covered += f.area;
    const double side = static_cast<double>(packing.texture) / texels;
    layout.used = covered / (side * side);
    for (Index c = 0; c < surface.twin.size(); ++c)
        if (surface.twin[c] != none && c < surface.twin[c] && !set.gluing.glued[c])
            layout.cut_length += surface.edge_length(c) * surface.unit;
    for (const std::uint8_t thin : surface.is_thin) layout.thin_faces += thin;
}

} // namespace

UnwrapLayout unwrap(std::span<const UnwrapInput> inputs, const UnwrapSettings& settings) {
    UnwrapLayout layout;
    layout.texture = settings.texture;
    ProgressSteps steps({1, 8, 4, 1});
    const UnwrapSurface surface = surface_of(inputs);
    steps.next();
    ChartSet set = make_charts(surface, settings.max_stretch);
    steps.next();
    std::vector<PackItem> flat(set.charts.size());
    parallel_for(
        flat.size(), [&](std::size_t i) { flat[i] = item_of(surface, set.gluing, set.charts[i]); }, 16);
    Packing packing;
    if (!flat.empty()) {
        UnwrapSettings scaled = settings;
        scaled.texels_per_unit *= surface.unit;
        packing = pack(flat, scaled);
        measure_layout(layout, surface, set, flat, packing);
        steps.next();
        place_items(flat, packing);
    }
    fill_layout(layout, surface, set, flat);
    return layout;
}

AttributeChanges put_coordinates(Mesh& mesh, const UnwrappedMesh& coordinates, int set, bool keep) {
    AttributeChanges changes;
    const std::string prefix = "TEXCOORD_", name = prefix + std::to_string(set);
    const auto moved = [&](const std::string& old) {
        for (int n = 63; n >= set; --n)
            if (old == prefix + std::to_string(n)) return prefix + std::to_string(n + 1);
        return old;
    };
    if (keep && mesh.find(name, Domain::wedge)) {
        for (Attribute& a : mesh.attributes)
            if (a.domain == Domain::wedge) a.name = moved(a.name);
        for (Primitive& p : mesh.primitives)
            for (std::string& a : p.attributes) a = moved(a);
    }
    for (const Domain d : {Domain::vertex, Domain::wedge, Domain::face}) mesh.drop(name, d);
    (void)separate_wedges(mesh, coordinates.corner_point);
    std::vector<float> values(2 * mesh.wedge_count());
    for (std::size_t c = 0; c < mesh.corner_count(); ++c)
        for (std::size_t k = 0; k < 2; ++k)
            values[2 * mesh.corners[c] + k] = coordinates.coordinates[2 * c + k];
    mesh.attributes.push_back({name, Domain::wedge, Role::uv, 2, false, std::move(values)});
    for (Primitive& p : mesh.primitives)
        if (!p.attributes.empty() && !p.lists(name)) p.attributes.push_back(name);
    changes = kept_changes(mesh.attributes);
    merge_changes(changes, {{name, Domain::wedge, AttributeChange::Kind::recomputed, "from new charts"}});
    return changes;
}

} // namespace facetmill
