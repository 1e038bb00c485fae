#pragma once
// Finds parts with equal meshes, for example instances of a glTF mesh, so that each mesh is processed once.

#include "mesh/scene.hpp"

#include <array>
#include <cstdint>
#include <map>

namespace facetmill {

/// A key that is equal for equal numbers, and for NaNs with the same bits. NaNs cannot be keys themselves,
/// because they have no order.
[[nodiscard]] std::uint64_t key_of(double number);

/// The keys of the directions and lengths of a space's axes in the world. They are equal for spaces that
/// differ only by a translation.
[[nodiscard]] std::array<std::uint64_t, 9> axes_in_world(const Transform& to_world);

/// Parts with bit-equal meshes, attributes and primitives, at any position. O(data).
struct DistinctParts {
    std::vector<std::size_t> first{}; ///< [parts] the first equal part, often the part itself
    std::vector<std::size_t> uses =
        {}; ///< [parts] the number of parts of which it is the first; 0 for repeats

    DistinctParts() = default;
    explicit DistinctParts(const Scene& scene);
    /// Equal parts that also have equal keys.
    template <class KeyOf>
    DistinctParts split_by(KeyOf&& key_of) const {
        std::map<std::pair<std::size_t, decltype(key_of(std::size_t{0}))>, std::size_t> known;
        DistinctParts parts(std::vector<std::size_t>(first.size()));
        for (std::size_t p = 0; p < first.size(); ++p)
            parts.first[p] = known.try_emplace({first[p], key_of(p)}, p).first->second;
        parts.count();
        return parts;
    }

  private:
    friend DistinctParts distinct_geometry(const Scene& scene);
    DistinctParts(const Scene& scene, bool with_primitives);
    explicit DistinctParts(std::vector<std::size_t> first_of_each) : first(std::move(first_of_each)) {}
    void count();
};

/// ... whose meshes are equal except for the data of their primitives, such as materials.
[[nodiscard]] DistinctParts distinct_geometry(const Scene& scene);

/// ... which differ by a move only: in the world they have the same shape.
[[nodiscard]] DistinctParts distinct_shapes(const Scene& scene);

} // namespace facetmill
