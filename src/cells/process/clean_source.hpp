#pragma once
// A mesh in which some faces are replaced, for the result of clean.

#include "cells/sources/face_source.hpp"

#include <memory>

namespace facetmill::cells {

/// The faces of a source with their numbers, the last 32 bits of each record. by_place: merges vertices at
/// the same position; otherwise uses the source's vertices.
[[nodiscard]] std::shared_ptr<FaceSource> numbered_source(std::shared_ptr<FaceSource> plain, bool by_place);

/// The numbers in the records of a numbered source.
[[nodiscard]] std::vector<std::uint32_t> numbers_in(const FaceSource& numbered, io::Span records);
/// The records without numbers, as in the plain source.
[[nodiscard]] io::Bytes plain_records(const FaceSource& numbered, io::Span records);

struct Replacement {
    std::vector<std::uint32_t> gone; ///< numbers of faces, ascending
    Piece come;                      ///< their replacements
    Box bounds;                      ///< bounds of the remaining and the new faces
};

/// The remaining faces of a numbered source of `faces` faces, then the new faces. Vertices are identified as
/// in a Piece.
[[nodiscard]] std::shared_ptr<FaceSource> replaced_source(std::shared_ptr<FaceSource> numbered,
                                                          std::uint32_t faces, Replacement by);

} // namespace facetmill::cells
