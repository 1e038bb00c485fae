#include "geometry/render/colour_scale.hpp"

#include "geometry/render/srgb.hpp"

#include <limits>

namespace facetmill {

Colour distinct_colour(std::uint64_t number) {
    static constexpr std::array<Colour, 10> colours{{{0.15f, 0.33f, 0.72f},
                                                     {0.85f, 0.30f, 0.05f},
                                                     {0.14f, 0.52f, 0.16f},
                                                     {0.70f, 0.08f, 0.10f},
                                                     {0.36f, 0.18f, 0.62f},
                                                     {0.80f, 0.60f, 0.06f},
                                                     {0.05f, 0.55f, 0.60f},
                                                     {0.80f, 0.25f, 0.52f},
                                                     {0.26f, 0.14f, 0.08f},
                                                     {0.45f, 0.62f, 0.20f}}};
    return colours[number % colours.size()];
}

Colour on_a_scale(double t) {
    if (std::isnan(t)) return missing_colour;
    // Coefficients by power of t, for red, green and blue in sRGB.
    static constexpr double c[7][3] = {{0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
                                       {0.1050930431085774, 1.404613529898575, 1.384590162594685},
                                       {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
                                       {-4.634230498983486, -5.799100973351585, -19.33244095627987},
                                       {6.228269936347081, 14.17993336680509, 56.69055260068105},
                                       {4.776384997670288, -13.74514537774601, -65.35303263337234},
                                       {-5.435455855934631, 4.645852612178535, 26.3124352495832}};
    const double x = std::clamp(t, 0.0, 1.0);
    Colour colour{};
    for (std::size_t i = 0; i < 3; ++i) {
        double sum = 0;
        for (std::size_t k = 7; k-- > 0;) sum = sum * x + c[k][i];
        colour[i] = linear_of(static_cast<std::uint8_t>(std::floor(255 * std::clamp(sum, 0.0, 1.0) + 0.5)));
    }
    return colour;
}

Colour on_a_diverging_scale(double t) {
    if (std::isnan(t)) return missing_colour;
    // Red, green and blue in sRGB at each eighth.
    static constexpr double c[9][3] = {{59, 76, 192},   {98, 130, 234},  {141, 176, 254},
                                       {184, 208, 249}, {221, 221, 221}, {245, 196, 173},
                                       {244, 154, 123}, {222, 96, 77},   {180, 4, 38}};
    const double x = 8 * std::clamp(t, 0.0, 1.0);
    const auto i = std::min(static_cast<std::size_t>(x), std::size_t{7});
    const double part = x - static_cast<double>(i);
    Colour colour{};
    for (std::size_t k = 0; k < 3; ++k)
        colour[k] =
            linear_of(static_cast<std::uint8_t>(std::floor(c[i][k] * (1 - part) + c[i + 1][k] * part + 0.5)));
    return colour;
}

Colour on_the_scale_of(const ValueRange& range, double t) {
    return range.diverging ? on_a_diverging_scale(t) : on_a_scale(t);
}

double in_range(double x, const ValueRange& range) {
    if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
    if (!(range.low < range.high)) return 0.5;
    // Uses halves, because the span of all doubles overflows.
    return (x / 2 - range.low / 2) / (range.high / 2 - range.low / 2);
}

} // namespace facetmill
