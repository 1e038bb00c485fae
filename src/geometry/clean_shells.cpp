// Steps of clean that look at whole pieces, or at pairs of faces anywhere.
#include "geometry/clean_steps.hpp"

namespace facetmill::clean_steps {

bool remove_inner_shells(Work&) { return false; }
bool resolve_self_intersections(Work&) { return false; }

} // namespace facetmill::clean_steps
