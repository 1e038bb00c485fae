#pragma once
// What places on a mesh are known by: hashes of positions, so that neither the numbers nor the order of
// faces, corners and vertices matter. Equal coordinates give equal keys, and only they (but for chance, at
// 64 bits); 0 and -0 are equal, and so are all numbers that are none.

#include "mesh/mesh.hpp"

namespace facetmill {

std::uint64_t key_of_point(const Vec3& p);
/// The ends in any order.
std::uint64_t key_of_edge(const Vec3& a, const Vec3& b);
/// The set of the face's corners, whatever their order and direction.
std::uint64_t key_of_face(const Mesh& mesh, Index f);
std::uint64_t key_of_pair(const Mesh& mesh, Index f, Index g);
/// [of_face's numbers below count] The lowest position (x first, then y and z) of each piece.
std::vector<std::uint64_t> keys_of_pieces(const Mesh& mesh, const std::vector<Index>& of_face,
                                          std::size_t count);

} // namespace facetmill
