#include "stage/surface_loss.hpp"

#include "base/readable_numbers.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/transform.hpp"
#include "stage/context.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill {

namespace {

bool are_same_parts(const std::vector<PartSurface>& a, const std::vector<PartSurface>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const PartSurface& x, const PartSurface& y) { return x.name == y.name; });
}

PartSurface total(const std::vector<PartSurface>& parts) {
    PartSurface sum;
    for (const PartSurface& p : parts) {
        sum.faces += p.faces;
        sum.area += p.area;
    }
    return sum;
}

/// The share of the area that may go.
double share(MayLose may_lose) {
    switch (may_lose) {
    case MayLose::tenth:
        return 0.1;
    case MayLose::half:
        return 0.5;
    case MayLose::area:
    case MayLose::all:
        break;
    }
    return 1;
}

/// What was lost of one part, empty when that is no more than may be: "none of its 12 faces is left".
std::string loss(const PartSurface& before, const PartSurface& after, MayLose may_lose) {
    if (before.faces == 0 || may_lose == MayLose::all) return {};
    if (after.faces == 0)
        return before.faces == 1 ? "its face is gone"
                                 : fmt::format("none of its {} faces is left", before.faces);
    const double lost = 1 - after.area / before.area;
    if (!(before.area > 0) || !std::isfinite(before.area) || !(lost > share(may_lose))) return {};
    return fmt::format("{} of its area is gone, {:.6g} of {:.6g} left", percentage(lost * 100), after.area,
                       before.area);
}

/// Of the mesh at all these places together. Where one turns and scales alike in all directions, to a
/// millionth, its area is that of the mesh times the square of the scale, so that it is not measured anew.
double area_at(const Mesh& mesh, const std::vector<Transform>& places) {
    constexpr double alike = 1e-6; // float32 rotations; areas are compared in hundredths
    const double own = surface_size(mesh, {}, false).area;
    double area = 0;
    for (const Transform& place : places) {
        const auto stretch = uniform_stretch(place, alike);
        area += stretch ? own * *stretch * *stretch : surface_size(mesh, place, false).area;
    }
    return area;
}

} // namespace

std::vector<PartSurface> surfaces_of_parts(const Scene& scene,
                                           std::span<const std::optional<SurfaceSize>> sizes) {
    const auto places = io::places_of_instances(scene);
    std::vector<PartSurface> surfaces;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        const auto size = sizes.empty() ? std::nullopt : sizes[i];
        PartSurface& surface = surfaces.emplace_back(PartSurface{part.name, part.mesh.face_count(), 0, size});
        if (!places[i].empty()) {
            surface.faces *= places[i].size();
            surface.area = area_at(part.mesh, places[i]);
        } else
            surface.area = size ? size->area : surface_size(part.mesh, part.transform, false).area;
    }
    return surfaces;
}

void warn_of_lost_surface(const std::vector<PartSurface>& before, const std::vector<PartSurface>& after,
                          MayLose may_lose, Context& context) {
    std::vector<std::string> losses;
    if (are_same_parts(before, after)) {
        for (std::size_t i = 0; i < before.size(); ++i)
            if (const auto text = loss(before[i], after[i], may_lose); !text.empty())
                losses.push_back(fmt::format("of part '{}': {}", before[i].name, text));
    } else if (const auto text = loss(total(before), total(after), may_lose); !text.empty())
        losses.push_back("of the scene: " + text);
    if (losses.empty()) return;
    const std::size_t more = losses.size() - 1;
    context.warn("W-SURFACE-LOST",
                 fmt::format("'{}' lost surface {}{}", context.name(), losses.front(),
                             more > 0 ? fmt::format("; and of {} more parts", more) : ""),
                 "validate the scene before this stage; --strict=W-SURFACE-LOST makes it an error");
}

} // namespace facetmill
