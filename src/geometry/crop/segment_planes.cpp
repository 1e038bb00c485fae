#include "geometry/crop/segment_planes.hpp"

#include "geometry/crop/outline_walls.hpp"

namespace facetmill {

SegmentPlanes::SegmentPlanes(const CropView& view, const CutMemory& memory) {
    for (const auto& e : view.footprint().tree().edges())
        planes.push_back(
            pulled_back(upright_plane(view.settings().axis, e.a, e.b), view.settings().to_world));
    std::vector<Plane> all;
    for (const auto& entry : memory.entries) all.push_back(entry.plane);
    const std::size_t known = all.size();
    all.insert(all.end(), planes.begin(), planes.end());
    const auto same = first_same_planes(all);
    std::vector<Index> number(all.size());
    sharing.assign(known, 1);
    for (std::size_t i = 0; i < all.size(); ++i) {
        number[i] = i < known ? static_cast<Index>(i) : number[same[i]];
        if (i < known) continue;
        if (same[i] == i) {
            number[i] = static_cast<Index>(sharing.size());
            first.push_back(static_cast<Index>(i - known));
            sharing.push_back(0);
        }
        ++sharing[number[i]];
        numbers.push_back(number[i]);
    }
}

} // namespace facetmill
