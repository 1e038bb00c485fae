#pragma once
// Units and up axes as the choices of an option.

#include "mesh/scene.hpp"
#include "options/declaration.hpp"

namespace facetmill {

/// All units, after a choice for no unit with this name and meaning.
[[nodiscard]] std::vector<NamedChoice<Unit>> unit_choices(std::string none, std::string none_help);
/// All up axes, after a choice for no axis with this name and meaning.
[[nodiscard]] std::vector<NamedChoice<UpAxis>> up_choices(std::string none, std::string none_help);

} // namespace facetmill
