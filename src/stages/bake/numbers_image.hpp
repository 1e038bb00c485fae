#pragma once
// Numbers as images of 16 bits.

#include "io/bytes.hpp"

namespace facetmill::bake_stage {

struct NumberRange {
    double least = 0, largest = 0;
};

/// The range of finite numbers; 0 to 0 if there are none.
[[nodiscard]] NumberRange range_of(const std::vector<float>& numbers);

/// A square PNG of 16 bits: grey for one component, colours for three. Each range goes from black to white.
[[nodiscard]] io::Bytes numbers_image(const std::vector<float>& numbers, std::size_t components,
                                      std::size_t side, const std::vector<NumberRange>& ranges);

} // namespace facetmill::bake_stage
