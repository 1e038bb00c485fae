#pragma once
// The scan as OpenMesh holds it, for a comparison side by side.

#include "support/meshes.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <benchmark/benchmark.h>

namespace facetmill::bench {

using OpenMeshTriangles = OpenMesh::TriMesh_ArrayKernelT<>;

/// A mesh of triangles.
inline OpenMeshTriangles to_openmesh(const Mesh& mesh) {
    OpenMeshTriangles theirs;
    for (const Vec3& p : mesh.positions)
        theirs.add_vertex({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    const auto vertex = [&](Index c) {
        return OpenMeshTriangles::VertexHandle(static_cast<int>(mesh.vertex(c)));
    };
    for (Index c = 0; c < mesh.corner_count(); c += 3)
        theirs.add_face(vertex(c), vertex(c + 1), vertex(c + 2));
    return theirs;
}

/// How all of these are timed: in milliseconds, by the clock, and the processor time of all threads beside
/// it.
inline void as_process(benchmark::internal::Benchmark* benchmark) {
    benchmark->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

} // namespace facetmill::bench
