#include "stage/surface_loss.hpp"

#include "base/text/readable_numbers.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"
#include "stage/context.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

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

/// The share of the area that may be lost.
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

/// Describes the loss of a part: "none of its 12 faces is left". Empty if the loss is allowed.
std::string loss(const PartSurface& before, const PartSurface& after, MayLose may_lose) {
    if (before.faces == 0 || may_lose == MayLose::all) return {};
    if (after.faces == 0)
        return before.faces == 1 ? "it lost its only face"
                                 : fmt::format("it lost all of its {} faces", before.faces);
    const double lost = 1 - after.area / before.area;
    if (!(before.area > 0) || !std::isfinite(before.area) || !(lost > share(may_lose))) return {};
    return fmt::format("it lost {} of its area, {:.6g} of {:.6g} remain", percentage(lost * 100), after.area,
                       before.area);
}

/// The area of a mesh by direction: the sum over its faces of the area times the products of the normal's
/// coordinates.
class FacingArea {
  public:
    FacingArea() = default;
    explicit FacingArea(const Mesh& mesh) {
        *this = parallel_reduce(
            mesh.face_count(), FacingArea{},
            [&](std::size_t begin, std::size_t end) {
                FacingArea all;
                for (auto f = static_cast<Index>(begin); f < end; ++f) all.add(area_vector(mesh, f) / 2);
                return all;
            },
            [](const FacingArea& a, const FacingArea& b) { return a.plus(b); });
    }

    /// The area after a transform. Exact for uniform scaling; otherwise an upper estimate by the mean of
    /// squares. Does not read the mesh.
    double at(const Transform& place) const {
        const Vec3 rows[] = {{place.m[0][0], place.m[0][1], place.m[0][2]},
                             {place.m[1][0], place.m[1][1], place.m[1][2]},
                             {place.m[2][0], place.m[2][1], place.m[2][2]}};
        double squares = 0; // sum of the squares of the transformed normals
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 c = cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
            for (std::size_t k = 0; k < 3; ++k) squares += c[k] * dot(by_[k], c);
        }
        return std::sqrt(area_ * squares);
    }

  private:
    void add(const Vec3& area) {
        const double size = length(area);
        if (!(size > 0)) return;
        area_ += size;
        for (std::size_t k = 0; k < 3; ++k) by_[k] += area * (area[k] / size);
    }
    FacingArea plus(const FacingArea& b) const {
        FacingArea sum = *this;
        sum.area_ += b.area_;
        for (std::size_t k = 0; k < 3; ++k) sum.by_[k] += b.by_[k];
        return sum;
    }

    double area_ = 0;
    Vec3 by_[3];
};

/// A part with all its instances.
struct AtPlaces {
    std::optional<FacingArea> facing;
    double area = 0, count = 0;
};

} // namespace

std::vector<PartSurface> surfaces_of_parts(const Scene& scene,
                                           std::span<const std::optional<SurfaceSize>> sizes) {
    std::map<std::size_t, AtPlaces> instanced;
    io::for_each_place_of_instances(scene, [&](std::size_t i, const Transform& place, double times) {
        AtPlaces& all = instanced[i];
        if (!all.facing) all.facing = FacingArea(scene.parts[i].mesh);
        all.area += times * all.facing->at(place);
        all.count += times;
    });
    std::vector<PartSurface> surfaces;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        const auto size = sizes.empty() ? std::nullopt : sizes[i];
        PartSurface& surface = surfaces.emplace_back(PartSurface{part.name, part.mesh.face_count(), 0, size});
        if (const auto all = instanced.find(i); all != instanced.end()) {
            surface.faces *= static_cast<std::size_t>(all->second.count);
            surface.area = all->second.area;
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
                 "validate the scene before this stage; --strict=W-SURFACE-LOST turns this into an error");
}

} // namespace facetmill
