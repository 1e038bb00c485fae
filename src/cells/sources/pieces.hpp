#pragma once
// Small batches of a source's faces, as meshes.

#include "cells/sources/face_source.hpp"

namespace facetmill::cells {

/// The name of a position: a hash, so different positions may share it by chance. -0 equals 0.
[[nodiscard]] std::uint64_t name_of_place(const Vec3& p, std::uint64_t seed = 0);

/// These faces with their vertices, which keep their order.
[[nodiscard]] Piece some_faces(const Piece& all, const std::vector<Index>& faces);

/// The centroid of a face's corners, which decides its cell.
[[nodiscard]] Vec3 centre_of(const Mesh& triangles, std::size_t face);

/// Calls use(records) for batches of faces, in source order. memory: as for each().
void each_batch(FaceSource& source, std::size_t memory, const std::function<void(io::Span)>& use);

} // namespace facetmill::cells
