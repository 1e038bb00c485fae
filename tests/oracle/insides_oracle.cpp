#include "oracle/insides_oracle.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <cmath>

namespace facetmill::oracle {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Triangle = Kernel::Triangle_3;

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

Triangle triangle(const std::array<Vec3, 3>& t) { return {point(t[0]), point(t[1]), point(t[2])}; }

Triangle shrunken(const std::array<Vec3, 3>& t) {
    const Triangle all = triangle(t);
    const Kernel::Point_3 middle = CGAL::centroid(all[0], all[1], all[2]);
    const Kernel::FT share = 1 - Kernel::FT(std::ldexp(1.0, -60));
    const auto moved = [&](int i) { return middle + (all[i] - middle) * share; };
    return {moved(0), moved(1), moved(2)};
}

} // namespace

bool insides_meet(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
    return CGAL::do_intersect(shrunken(a), triangle(b)) || CGAL::do_intersect(triangle(a), shrunken(b));
}

} // namespace facetmill::oracle
