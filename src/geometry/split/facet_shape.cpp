#include "base/portable_math.hpp"
#include "geometry/split/split.hpp"
#include "mesh/topology.hpp"

#include "base/parallel.hpp"

namespace facetmill {

namespace {

struct Extremes {
    double squared = 0; ///< of the longest edge
    double cosine = -1; ///< of the smallest angle
};

Extremes join(Extremes a, const Extremes& b) {
    return {std::max(a.squared, b.squared), std::max(a.cosine, b.cosine)};
}

Extremes extremes(const Mesh& mesh, Index f, const Transform& to_world) {
    Extremes e;
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    Vec3 in = to_world.vector(mesh.point(begin) - mesh.point(end - 1));
    for (Index c = begin; c < end; ++c) {
        const Vec3 out = to_world.vector(mesh.point(next_corner(mesh, f, c)) - mesh.point(c));
        const double size = std::sqrt(dot(in, in) * dot(out, out));
        e.squared = std::max(e.squared, dot(out, out));
        if (size > 0) e.cosine = std::max(e.cosine, -dot(in, out) / size);
        in = out;
    }
    return e;
}

} // namespace

FacetShape facet_shape(const Mesh& mesh, const Transform& to_world) {
    if (mesh.face_count() == 0) return {};
    const Extremes all = parallel_reduce(
        mesh.face_count(), Extremes{},
        [&](std::size_t begin, std::size_t end) {
            Extremes e;
            for (std::size_t f = begin; f < end; ++f)
                e = join(e, extremes(mesh, static_cast<Index>(f), to_world));
            return e;
        },
        join);
    return {std::sqrt(all.squared), arc_cosine(all.cosine)};
}

double mean_edge(const Mesh& mesh, const Transform& to_world) {
    const double sum = parallel_reduce(
        mesh.face_count(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double s = 0;
            for (auto f = static_cast<Index>(begin); f < end; ++f)
                for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
                    s += length(to_world.vector(mesh.point(next_corner(mesh, f, c)) - mesh.point(c)));
            return s;
        },
        [](double a, double b) { return a + b; });
    return mesh.corner_count() > 0 ? sum / static_cast<double>(mesh.corner_count()) : 0;
}

} // namespace facetmill
