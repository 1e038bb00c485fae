#pragma once
// What the benchmarks run on: a closed scan, or a closed surface as rough as one.

#include "geometry/crumple/crumple.hpp"
#include "io/codec.hpp"
#include "mesh/shapes.hpp"

#include <benchmark/benchmark.h>
#include <cstdlib>

namespace facetmill::bench {

/// FACETMILL_SCAN names a mesh file (its first part is taken); without it, a crumpled sphere of 1.3 million
/// faces.
inline const Mesh& closed_scan() {
    static const Mesh mesh = [] {
        if (const char* path = std::getenv("FACETMILL_SCAN")) {
            io::ReadLog log;
            return io::read_scene(io::Input::open(path), {}, log).parts.at(0).mesh;
        }
        CrumpleSettings settings;
        settings.amplitude = 1e-4;
        return crumple(shapes::icosphere(8), settings).mesh;
    }();
    return mesh;
}

/// How all of these are timed: in milliseconds, by the clock, and the processor time of all threads beside
/// it.
inline void as_process(benchmark::internal::Benchmark* benchmark) {
    benchmark->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

} // namespace facetmill::bench
