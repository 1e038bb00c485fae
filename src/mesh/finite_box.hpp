#pragma once
// Computes the box of points that may not be finite.

#include "base/math/vec.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

/// The box around the finite points among n points at(i); empty if no point is finite. Parallel.
template <class At>
[[nodiscard]] Box box_of_finite(std::size_t n, const At& at) {
    return parallel_reduce(
        n, Box{},
        [&](std::size_t begin, std::size_t end) {
            Box box;
            for (std::size_t i = begin; i < end; ++i)
                if (const Vec3 p = at(i); is_finite(p)) box.add(p);
            return box;
        },
        [](Box a, const Box& b) {
            a.add(b);
            return a;
        });
}

} // namespace facetmill
