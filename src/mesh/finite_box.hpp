#pragma once
// The box around points some of which may not be finite.

#include "base/parallel.hpp"
#include "base/vec.hpp"

namespace facetmill {

/// The box around the points that are finite, in parallel; empty where none is.
inline Box box_of_finite(std::span<const Vec3> points) {
    return parallel_reduce(
        points.size(), Box{},
        [&](std::size_t begin, std::size_t end) {
            Box box;
            for (std::size_t i = begin; i < end; ++i)
                if (is_finite(points[i])) box.add(points[i]);
            return box;
        },
        [](Box a, const Box& b) {
            a.add(b);
            return a;
        });
}

} // namespace facetmill
