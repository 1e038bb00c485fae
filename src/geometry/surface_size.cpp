#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/moved.hpp"

namespace facetmill {

namespace {

struct Sums {
    double area = 0, volume = 0;
    std::uint64_t boundary = 0; ///< each directed edge once, its reverse as the negative
};

void add_face(Sums& sums, const Mesh& mesh, Index f, const Transform& to_world, const Vec3& origin) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    const auto place = [&](Index c) { return to_world.point(mesh.point(c)) - origin; };
    const Vec3 first = place(begin);
    for (Index c = begin + 1; c + 1 < end; ++c) {
        const Vec3 a = place(c), b = place(c + 1), normal = cross(a - first, b - first);
        sums.area += length(normal) / 2;
        sums.volume += dot(first, normal) / 6;
    }
}

void add_boundary(Sums& sums, const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    for (Index c = begin, last = end - 1; c < end; last = c++) {
        const std::uint64_t from = mesh.vertex(last), to = mesh.vertex(c);
        const std::uint64_t edge = hashed(std::min(from, to), std::max(from, to));
        sums.boundary += from < to ? edge : from > to ? -edge : 0;
    }
}

} // namespace

SurfaceSize surface_size(const Mesh& mesh, const Transform& to_world, std::optional<bool> closed) {
    const Vec3 origin = to_world.point(box_of(mesh.positions).centre());
    const bool usable = is_finite(origin);
    const Sums sums = parallel_reduce(
        mesh.face_count(), Sums{},
        [&](std::size_t begin, std::size_t end) {
            Sums s;
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                add_face(s, mesh, f, to_world, usable ? origin : Vec3{});
                if (!closed) add_boundary(s, mesh, f);
            }
            return s;
        },
        [](Sums a, const Sums& b) {
            return Sums{a.area + b.area, a.volume + b.volume, a.boundary + b.boundary};
        });
    SurfaceSize size{sums.area, {}};
    if (closed.value_or(sums.boundary == 0) && mesh.face_count() > 0)
        size.volume = to_world.determinant() < 0 ? -sums.volume : sums.volume;
    return size;
}

} // namespace facetmill
