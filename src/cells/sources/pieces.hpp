#pragma once
// Faces of a source in handfuls, as meshes.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

/// A name for a place, the same for equal positions (-0 is 0): a hash, so others may have it by chance.
std::uint64_t name_of_place(const Vec3& p, std::uint64_t seed = 0);

/// These faces, with the vertices that they use, which keep their order.
Piece some_faces(const Piece& all, const std::vector<Index>& faces);

/// The middle of each face's corners, which says what cell it goes to.
Vec3 centre_of(const Mesh& triangles, std::size_t face);

/// Calls use(records) for some faces at a time, in the order of the source. memory: as for each().
void each_batch(FaceSource& source, std::size_t memory, const std::function<void(io::Span)>& use);

} // namespace facetmill::cells
