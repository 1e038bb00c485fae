// Instantiates the extern templates of mesh.hpp and scene.hpp. A separate file, because GCC 14 omits copy
// constructors that were already used in the same compilation.
#include "mesh/mesh.hpp"
#include "mesh/scene.hpp"

template class std::vector<facetmill::Attribute>;
template class std::vector<facetmill::Primitive>;
template class std::vector<facetmill::Part>;
template class std::vector<facetmill::Material>;
