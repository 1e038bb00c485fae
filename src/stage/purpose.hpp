#pragma once
// The purpose that a check found a scene fit for, which its files must fit too.

#include "stage/assertions.hpp"

namespace facetmill {

struct Purpose {
    std::string name; ///< "printing"
    Assertions assertions;
    bool is_solid = false; ///< it forbids self-intersections
};

} // namespace facetmill
