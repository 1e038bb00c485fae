#pragma once
// The JSON type used throughout: keys keep their order, so reports read as they were written.

#include <nlohmann/json.hpp>

namespace facetmill {
using Json = nlohmann::ordered_json;
}
