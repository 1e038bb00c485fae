// The quantisation grid for the positions of a mesh.

#include "io/gltf/draco/draco.hpp"
#include "io/gltf/draco/quantise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace facetmill::io {

void set_draco_grid(const Mesh& mesh, DracoInput& input) {
    const Box box = mesh.bounds();
    const auto not_below = [](double x) {
        const auto rounded = static_cast<float>(x);
        return static_cast<double>(rounded) < x ? std::nextafter(rounded, HUGE_VALF) : rounded;
    };
    float range = 0;
    input.extent = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        input.origin[i] = storable_below(-not_below(-box.min[i]));
        range = std::max(range, not_below(box.max[i] - static_cast<double>(input.origin[i])));
        input.extent = std::max(input.extent, not_below(box.max[i] - box.min[i]));
    }
    input.range = storable_above(input.extent > 0 ? range : 1);
}

void set_whole_steps(DracoInput& input, int bits) {
    input.range = input.extent = static_cast<float>((std::int64_t{1} << bits) - 1);
}

void set_draco_lattice(const Mesh& mesh, const Vec3& origin, double step, DracoInput& input, int bits) {
    const auto range = static_cast<float>(step * (std::ldexp(1.0, bits) - 1));
    if (!(range > 0) || !std::isfinite(range)) return;
    const Box box = mesh.bounds();
    const float stored = storable_above(range);
    std::array<float, 3> low{};
    bool within = true;
    for (std::size_t i = 0; i < 3; ++i) {
        low[i] = storable_below(std::min(static_cast<float>(origin[i]), input.origin[i]));
        within = within && static_cast<float>(box.max[i]) - low[i] <= stored;
    }
    if (within)
        std::copy(low.begin(), low.end(), input.origin);
    else if (!(range > input.range)) // the grid of the lattice's origin does not reach the mesh
        return;
    input.extent = range;
    input.range = stored;
}

} // namespace facetmill::io
