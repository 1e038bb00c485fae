#include "geometry/cgal/alpha_wrap.hpp"

#include "base/progress.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>

namespace facetmill {

namespace {

namespace wraps = CGAL::Alpha_wraps_3::internal;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Halfedges = CGAL::Surface_mesh<Point>;
using Points = wraps::Point_set_oracle<Kernel>;
using Segments = wraps::Segment_soup_oracle<Kernel, Points>;
using Triangles = wraps::Triangle_soup_oracle<Kernel, Segments>;
#if CGAL_VERSION_MAJOR < 6
using Wrapper = wraps::Alpha_wrap_3<Triangles>;
#else
using Wrapper = wraps::Alpha_wrapper_3<Triangles>;
#endif

struct TooLarge {};

/// Reports progress, and ends a wrap that gets too large.
class Watch : public wraps::Wrapping_default_visitor {
  public:
    explicit Watch(const WrapSize& size) : size_(size) {}

    template <class Wraps, class Vertex>
    void after_Steiner_point_insertion(const Wraps&, Vertex) {
        if (++vertices_ > size_.max_vertices) throw TooLarge{};
        if (vertices_ % 1024 == 0)
            ProgressScope::report(static_cast<double>(vertices_) /
                                  static_cast<double>(std::max(size_.about_vertices, vertices_) + 1));
    }

  private:
    const WrapSize& size_;
    std::size_t vertices_ = 0;
};

WrappedSurface arrays_of(const Halfedges& mesh) {
    WrappedSurface out;
    out.points.reserve(mesh.number_of_vertices());
    out.triangles.reserve(mesh.number_of_faces());
    for (const auto v : mesh.vertices()) {
        const Point& p = mesh.point(v);
        out.points.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto f : mesh.faces()) {
        std::array<Index, 3> abc{};
        std::size_t k = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
            if (k < 3) abc[k++] = static_cast<Index>(v);
        out.triangles.push_back(abc);
    }
    return out;
}

} // namespace

WrappedSurface alpha_wrap(const WrapInput& input, const WrapSize& size) {
    const auto at = [&](Index v) {
        const Vec3& p = input.positions[v];
        return Point(p.x, p.y, p.z);
    };
    Points points;
    if (!input.points.empty()) {
        std::vector<Point> all;
        all.reserve(input.points.size());
        for (const Index v : input.points) all.push_back(at(v));
        points.add_point_set(all);
    }
    Segments segments(points);
    if (!input.segments.empty()) {
        std::vector<Kernel::Segment_3> all;
        all.reserve(input.segments.size());
        for (const auto& [a, b] : input.segments) all.emplace_back(at(a), at(b));
        segments.add_segment_soup(all);
    }
    Triangles triangles(size.alpha, segments);
    if (!input.triangles.empty()) {
        std::vector<Kernel::Triangle_3> all;
        all.reserve(input.triangles.size());
        for (const auto& [a, b, c] : input.triangles) all.emplace_back(at(a), at(b), at(c));
        triangles.add_triangle_soup(all);
    }
    Wrapper wrapper(triangles);
    Halfedges mesh;
    Watch watch(size);
    try {
        wrapper(size.alpha, size.offset, mesh, CGAL::parameters::visitor(std::ref(watch)));
    } catch (const TooLarge&) {
        return {{}, {}, true};
    }
    return arrays_of(mesh);
}

} // namespace facetmill
