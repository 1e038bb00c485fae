// What mesh.hpp and scene.hpp say is compiled elsewhere: by itself, since GCC 14 leaves out the constructors
// by copying that were already used in the same compilation.
#include "mesh/mesh.hpp"
#include "mesh/scene.hpp"

template class std::vector<facetmill::Attribute>;
template class std::vector<facetmill::Primitive>;
template class std::vector<facetmill::Part>;
template class std::vector<facetmill::Material>;
