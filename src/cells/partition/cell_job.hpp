#pragma once
// A run in cells by several processes that share a folder of kept cells. The first makes the cells, others
// each simplify a share of them, and a last ordinary run uses their results.

#include <cstddef>
#include <string>

namespace facetmill::cells {

struct CellJob {
    std::size_t number = 0, of = 0; ///< the job that simplifies, from 1; 0: the job that makes the cells
    bool makes_cells() const { return of == 0; }
};

/// A name that distinguishes simplifying jobs.
[[nodiscard]] std::string name_of(const CellJob& job);
/// The stamp file of a finished simplifying job. Its stations depend only on the mesh and the number of
/// jobs.
[[nodiscard]] std::string stamp_of(const CellJob& job);

} // namespace facetmill::cells
