#include "compare/pmp_peer.hpp"

#include <pmp/algorithms/smoothing.h>
#include <pmp/algorithms/subdivision.h>
#include <pmp/surface_mesh.h>

namespace facetmill::bench {

struct PmpPeer::Own {
    pmp::SurfaceMesh mesh;
};

PmpPeer::PmpPeer(const std::vector<double>& points, const std::vector<std::uint32_t>& corners)
    : own_(std::make_unique<Own>()) {
    const auto scalar = [&](std::size_t i) { return static_cast<pmp::Scalar>(points[i]); };
    for (std::size_t i = 0; i < points.size(); i += 3)
        own_->mesh.add_vertex(pmp::Point(scalar(i), scalar(i + 1), scalar(i + 2)));
    for (std::size_t c = 0; c < corners.size(); c += 3)
        own_->mesh.add_triangle(pmp::Vertex(corners[c]), pmp::Vertex(corners[c + 1]),
                                pmp::Vertex(corners[c + 2]));
}
PmpPeer::~PmpPeer() = default;

void PmpPeer::split_midpoint() { pmp::linear_subdivision(own_->mesh); }
void PmpPeer::smooth(unsigned iterations) { pmp::explicit_smoothing(own_->mesh, iterations, true); }
std::size_t PmpPeer::face_count() const { return own_->mesh.n_faces(); }

} // namespace facetmill::bench
