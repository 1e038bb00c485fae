#pragma once
// Units and up axes as the choices of an option.

#include "mesh/scene.hpp"
#include "options/declaration.hpp"

namespace facetmill {

/// All units, after the choice for none of them: its name and what it means there.
std::vector<NamedChoice<Unit>> unit_choices(std::string none, std::string none_help);
/// ... and up axes.
std::vector<NamedChoice<UpAxis>> up_choices(std::string none, std::string none_help);

} // namespace facetmill
