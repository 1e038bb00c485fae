#include "diff/sides.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/component_volumes.hpp"
#include "mesh/face.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// A connected component of the surface, or the whole surface.
struct Component {
    std::string part;
    Index face = none; ///< its first face
    double area = 0, volume = 0;
    Vec3 materials, middle; ///< sums of area vectors, and of face centres weighted by area
};

void add_part(const Part& part, std::vector<Component>& components) {
    const Mesh& mesh = part.mesh;
    const Transform t = part.transform;
    const double sign = t.determinant() < 0 ? -0.5 : 0.5; // a mirrored part keeps its front side
    const Components of = face_components(mesh, false);
    const std::size_t before = components.size();
    components.resize(before + of.count);
    const auto place = [&](Index c) { return t.point(mesh.point(c)); };
    const auto volumes = six_volumes(mesh, of, place);
    for (std::size_t i = 0; i < of.count; ++i) components[before + i].volume = volumes[i] * sign / 3;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        Component& component = components[before + of.of_face[f]];
        if (component.face == none) {
            component.part = part.name;
            component.face = f;
        }
        const Vec3 area = area_vector(mesh, f, t) * sign;
        component.area += length(area);
        component.materials += area;
        const Vec3 corners = corner_sum_at(mesh, f, place);
        component.middle += corners * (length(area) / mesh.face_size(f));
    }
}

std::vector<Component> components_of(const Scene& scene) {
    std::vector<Component> components;
    for (const Part& part : scene.parts) add_part(part, components);
    return components;
}

/// Closed components, whose area vectors cancel, are compared by volume; open surfaces by the sum of area
/// vectors.
bool turned(const Component& a, const Component& b) {
    const auto open = [](const Component& p) { return length(p.materials) > 1e-6 * p.area; };
    const auto solid = [](const Component& p) {
        return std::abs(p.volume) > 1e-12 * p.area * std::sqrt(p.area);
    };
    if (open(a) || open(b)) return open(a) && open(b) && dot(a.materials, b.materials) < 0;
    return solid(a) && solid(b) && (a.volume < 0) != (b.volume < 0);
}

bool same_place(const Component& a, const Component& b) {
    if (!(std::abs(a.area - b.area) <= 1e-3 * a.area)) return false;
    return length(a.middle / a.area - b.middle / b.area) <= 1e-2 * std::sqrt(a.area);
}

/// All components together. Each volume has its own origin, which matters only for open components.
Component whole(const std::vector<Component>& components) {
    Component sum;
    for (const Component& p : components) {
        sum.area += p.area;
        sum.volume += p.volume;
        sum.materials += p.materials;
    }
    return sum;
}

} // namespace

Turned turned_round(const Scene& a, const Scene& b) {
    const auto first = components_of(a), second = components_of(b);
    const auto has_area = [](const Component& p) { return p.area > 0; };
    const bool alike = std::equal(first.begin(), first.end(), second.begin(), second.end(),
                                  [&](const Component& p, const Component& q) {
                                      return has_area(p) == has_area(q) && (!has_area(p) || same_place(p, q));
                                  });
    if (!alike) return {turned(whole(first), whole(second)), {}};
    std::size_t count = 0;
    const Component* where = nullptr;
    for (std::size_t i = 0; i < first.size(); ++i)
        if (turned(first[i], second[i]) && count++ == 0) where = &first[i];
    if (count == 0) return {};
    return {true, fmt::format("{} of {} components, the first at face {} of '{}'", count, first.size(),
                              where->face, where->part)};
}

} // namespace facetmill::report
