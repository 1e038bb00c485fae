#pragma once
// Parts with one and the same mesh, as the instances of a glTF mesh are: what is done to one of them need not
// be done again.

#include "mesh/scene.hpp"

#include <array>
#include <cstdint>
#include <map>

namespace facetmill {

/// Alike for numbers that are equal, and for two that are no numbers (NaN) of the same bits, which have no
/// order among the others and so cannot be keys themselves.
[[nodiscard]] std::uint64_t key_of(double number);

/// The keys of where the axes of a space point in the world, and how long they are: the same for spaces that
/// differ by a move.
[[nodiscard]] std::array<std::uint64_t, 9> axes_in_world(const Transform& to_world);

/// Parts whose meshes are equal to the bit, with attributes and primitives, wherever they are. O(data).
struct DistinctParts {
    std::vector<std::size_t> first{};   ///< [parts] the first one equal to each, often itself
    std::vector<std::size_t> uses = {}; ///< [parts] the parts that it is the first of; 0 for repeats

    DistinctParts() = default;
    explicit DistinctParts(const Scene& scene);
    /// Those of them that have equal keys, too.
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
