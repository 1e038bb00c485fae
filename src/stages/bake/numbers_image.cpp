#include "stages/bake/numbers_image.hpp"

#include "io/images/encode_image.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::bake_stage {

NumberRange range_of(const std::vector<float>& numbers) {
    NumberRange range{HUGE_VAL, -HUGE_VAL};
    for (const float x : numbers) {
        if (!std::isfinite(x)) continue;
        range.least = std::min(range.least, static_cast<double>(x));
        range.largest = std::max(range.largest, static_cast<double>(x));
    }
    return range.least <= range.largest ? range : NumberRange{};
}

io::Bytes numbers_image(const std::vector<float>& numbers, std::size_t components, std::size_t side,
                        const std::vector<NumberRange>& ranges) {
    std::vector<std::uint16_t> levels(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const NumberRange& range = ranges[i % components];
        const double width = range.largest - range.least;
        const double share = width > 0 ? (static_cast<double>(numbers[i]) - range.least) / width : 0;
        // NaN becomes 0.
        levels[i] =
            share > 0 ? static_cast<std::uint16_t>(std::floor(std::min(share, 1.0) * 65535 + 0.5)) : 0;
    }
    return io::encoded_png_16(levels, side, components);
}

} // namespace facetmill::bake_stage
