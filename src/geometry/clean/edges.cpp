// The step of clean that puts vertices on the boundary edges they lie on.
#include "geometry/clean/steps.hpp"
#include "geometry/edit/t_junctions.hpp"

namespace facetmill::clean_steps {

bool resolve_t_junctions(Work& work, double within) {
    auto insertions = find_t_junctions(work.mesh, within);
    if (insertions.empty()) return false;
    work.counts.t_junctions += insertions.size();
    work.mesh = insert_on_edges(work.mesh, std::move(insertions), {}, &work.changes);
    return true;
}

} // namespace facetmill::clean_steps
