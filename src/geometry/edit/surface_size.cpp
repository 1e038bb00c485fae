#include "base/math/random.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/fetch_points.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

namespace {

struct SizeSums {
    double area = 0, volume = 0;
    std::uint64_t boundary = 0; ///< sum over directed edges, where a reversed edge counts negative
};

/// The sums to compute in addition to the area.
struct Wanted {
    bool volume = true, boundary = false;
};

/// place(corner): its position relative to a point near the surface.
template <class Place>
void add_face(SizeSums& sums, const Mesh& mesh, Index f, std::vector<Vec3>& corners, bool volume,
              Place&& place) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    const Vec3 first = place(begin);
    Vec3 twice;
    for (Index c = begin + 1; c + 1 < end; ++c) {
        const Vec3 a = place(c), b = place(c + 1), normal = cross(a - first, b - first);
        twice += normal;
        if (volume) sums.volume += dot(first, normal) / 6;
    }
    if (end - begin == 3) {
        sums.area += safe_length(twice) / 2;
        return;
    }
    corners.clear();
    for (Index c = begin; c < end; ++c) corners.push_back(place(c));
    sums.area += covered_area(corners);
}

void add_boundary(SizeSums& sums, const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    std::uint64_t from = mesh.vertex(end - 1);
    for (Index c = begin; c < end; ++c) {
        const std::uint64_t to = mesh.vertex(c);
        const std::uint64_t edge = mixed_bits(std::min(from, to) << 32 | std::max(from, to));
        sums.boundary += from < to ? edge : from > to ? -edge : 0;
        from = to;
    }
}

template <class Place>
SizeSums sums_of(const Mesh& mesh, Wanted wanted, Place&& place) {
    return parallel_reduce(
        mesh.face_count(), SizeSums{},
        [&](std::size_t begin, std::size_t end) {
            SizeSums s;
            std::vector<Vec3> corners;
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                fetch_points_soon(mesh, f);
                add_face(s, mesh, f, corners, wanted.volume, place);
                if (wanted.boundary) add_boundary(s, mesh, f);
            }
            return s;
        },
        [](SizeSums a, const SizeSums& b) {
            return SizeSums{a.area + b.area, a.volume + b.volume, a.boundary + b.boundary};
        });
}

SizeSums far_sums_of(const Mesh& mesh, Wanted wanted, const Transform& to_world, const PowerScale& scale,
                     const Vec3& origin) {
    const Vec3 from = scale(origin);
    return sums_of(mesh, wanted, [&](Index c) { return scale(to_world.point(mesh.point(c))) - from; });
}

/// A box that contains the transformed corners of the other box, and so its transformed contents.
Box box_after(const Box& box, const Transform& to_world) {
    Box all;
    if (box.empty()) return all;
    for (const double x : {box.min.x, box.max.x})
        for (const double y : {box.min.y, box.max.y})
            for (const double z : {box.min.z, box.max.z}) all.add(to_world.point({x, y, z}));
    return all;
}

/// A surface relative to its centre, scaled so that products neither overflow nor underflow.
struct Sight {
    Sight(const Mesh& mesh, const Transform& to_world) {
        const Box box = box_of(mesh.positions);
        world = box_after(box, to_world);
        even = even_scale(world);
        const Vec3 centre = to_world.point(box.centre());
        origin = is_finite(centre) ? centre : Vec3{};
    }
    Box world;
    PowerScale even;
    Vec3 origin;
};

SizeSums sums_seen(const Mesh& mesh, Wanted wanted, const Transform& to_world, const Sight& sight) {
    const Vec3 origin = sight.origin;
    if (sight.even.none() && to_world.identity())
        return sums_of(mesh, wanted, [&](Index c) { return mesh.point(c) - origin; });
    if (sight.even.none())
        return sums_of(mesh, wanted, [&](Index c) { return to_world.point(mesh.point(c)) - origin; });
    SizeSums sums = far_sums_of(mesh, wanted, to_world, sight.even, origin);
    sums.area = unscaled(sums.area, 2 * sight.even.powers[0]);
    return sums;
}

} // namespace

SurfaceSize surface_size(const Mesh& mesh, const Transform& to_world, std::optional<bool> closed) {
    const Sight sight(mesh, to_world);
    SizeSums sums = sums_seen(mesh, {closed.value_or(true), !closed}, to_world, sight);
    SurfaceSize size{sums.area, {}};
    if (!closed.value_or(sums.boundary == 0) || mesh.face_count() == 0) return size;
    const PowerScale axes = axis_scale(sight.world);
    if (!axes.none())
        sums.volume = unscaled(far_sums_of(mesh, {}, to_world, axes, sight.origin).volume, axes.volume());
    size.volume = to_world.determinant() < 0 ? -sums.volume : sums.volume;
    return size;
}

} // namespace facetmill
