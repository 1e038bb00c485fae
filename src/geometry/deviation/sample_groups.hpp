#pragma once
// Splits neighbouring points into groups small enough to be processed together.

#include "base/math/vec.hpp"

#include <algorithm>
#include <span>

namespace facetmill {

/// Decides whether to retry an attempt that often fails. After failures, attempts become rarer, down to one
/// in 32.
class Attempts {
  public:
    bool next() {
        if (left_out_ == 0) return true;
        --left_out_;
        return false;
    }
    void note(bool success) {
        constexpr std::size_t most_often = 5;
        in_vain_ = success ? 0 : std::min(in_vain_ + 1, most_often);
        left_out_ = (std::size_t{1} << in_vain_) - 1;
    }

  private:
    std::size_t in_vain_ = 0, left_out_ = 0;
};

/// Splits the items across the middle of the longest side of their box; returns the size of the first part.
template <class T>
[[nodiscard]] std::size_t halved(std::span<T> some) {
    Box box;
    for (const T& item : some) box.add(item.point);
    const Vec3 sides = box.extent();
    const std::size_t axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
    const double middle = box.centre()[axis];
    const auto upper =
        std::partition(some.begin(), some.end(), [&](const T& item) { return item.point[axis] < middle; });
    const auto half = static_cast<std::size_t>(upper - some.begin());
    return half == 0 || half == some.size() ? some.size() / 2 : half; // all points coincide
}

} // namespace facetmill
