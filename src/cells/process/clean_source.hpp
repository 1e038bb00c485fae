#pragma once
// A mesh with some of its faces in another form, as clean leaves it.

#include "cells/sources/face_source.hpp"

#include <memory>

namespace facetmill::cells {

/// The faces of a source with their numbers, which come last in a record as 32 bits. by_place: vertices at
/// one place are one; else as the source has them.
std::shared_ptr<FaceSource> numbered_source(std::shared_ptr<FaceSource> plain, bool by_place);

/// The numbers in the records of a numbered source.
std::vector<std::uint32_t> numbers_in(const FaceSource& numbered, io::Span records);
/// ... and the records of the plain one.
io::Bytes plain_records(const FaceSource& numbered, io::Span records);

struct Replacement {
    std::vector<std::uint32_t> gone; ///< numbers of faces, ascending
    Piece come;                      ///< faces in their place
    Box bounds;                      ///< of all that stays and comes
};

/// What stays of a numbered source of `faces` faces, then what comes. Vertices are one as in a Piece.
std::shared_ptr<FaceSource> replaced_source(std::shared_ptr<FaceSource> numbered, std::uint32_t faces,
                                            Replacement by);

} // namespace facetmill::cells
