#pragma once
// A run in cells as several processes, which meet in a folder of kept cells: one makes the cells, others
// simplify some of them each, and a last one, a run as any, takes up what they left.

#include <cstddef>
#include <string>

namespace facetmill::cells {

struct CellJob {
    std::size_t number = 0, of = 0; ///< one of those that simplify, from 1; 0: the one that makes the cells
    bool makes_cells() const { return of == 0; }
};

/// What tells a job that simplifies from the others.
std::string name_of(const CellJob& job);
/// The file that says that a job that simplifies is done. Which stations it settles depends on the mesh and
/// the number of jobs alone.
std::string stamp_of(const CellJob& job);

} // namespace facetmill::cells
