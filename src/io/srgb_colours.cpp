#include "io/srgb_colours.hpp"

#include "geometry/render/srgb.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace facetmill::io {

namespace {

constexpr std::size_t first_alpha = 3; ///< components from here on are alpha, which has no encoding

bool is_colour(const Attribute& a) {
    return a.name == "COLOR_0" && a.role == Role::colour &&
           (a.normalised || std::holds_alternative<std::vector<float>>(a.data) ||
            std::holds_alternative<std::vector<double>>(a.data));
}

bool has_colours(const Scene& scene) {
    return std::any_of(scene.parts.begin(), scene.parts.end(), [](const Part& part) {
        const auto& all = part.mesh.attributes;
        return std::any_of(all.begin(), all.end(), is_colour);
    });
}

/// Replaces the numbers by converted(number, whether it is alpha).
template <class T, class Convert>
void convert_numbers(Attribute& a, const Convert& converted) {
    const auto n = static_cast<std::size_t>(a.components);
    std::vector<T> numbers(a.size() * n);
    parallel_for(a.size(), [&](std::size_t i) {
        for (std::size_t c = 0; c < n; ++c)
            numbers[i * n + c] = converted(a.value(i, static_cast<int>(c)), c >= first_alpha);
    });
    a.data = std::move(numbers);
}

template <class T>
T as_fraction(double x) {
    return as_component<T>(x * static_cast<double>(std::numeric_limits<T>::max()));
}

void make_linear(Attribute& a) {
    if (std::holds_alternative<std::vector<std::uint8_t>>(a.data))
        return convert_numbers<std::uint16_t>(a, [](double x, bool alpha) {
            return as_fraction<std::uint16_t>(alpha ? x : linear_fraction(x));
        });
    convert_numbers<float>(
        a, [](double x, bool alpha) { return static_cast<float>(alpha ? x : linear_fraction(x)); });
    a.normalised = false;
}

void make_srgb(Attribute& a) {
    if (a.normalised)
        return convert_numbers<std::uint8_t>(a, [](double x, bool alpha) {
            return alpha ? as_fraction<std::uint8_t>(x) : srgb_of(static_cast<float>(x));
        });
    convert_numbers<float>(
        a, [](double x, bool alpha) { return static_cast<float>(alpha ? x : srgb_fraction(x)); });
}

template <class Change>
void change_colours(Scene& scene, const Change& change) {
    for (Part& part : scene.parts)
        for (Attribute& a : part.mesh.attributes)
            if (is_colour(a)) change(a);
}

} // namespace

void make_colours_linear(Scene& scene) { change_colours(scene, make_linear); }

decltype(Codec::read) with_linear_colours(decltype(Codec::read) read) {
    return [read = std::move(read)](const Input& input, const ReadSettings& settings, ReadLog& log) {
        Scene scene = read(input, settings, log);
        change_colours(scene, make_linear);
        return scene;
    };
}

decltype(Codec::write) with_srgb_colours(decltype(Codec::write) write) {
    return [write = std::move(write)](const Scene& scene, const WriteSettings& settings) {
        if (!has_colours(scene)) return write(scene, settings);
        Scene encoded = scene;
        change_colours(encoded, make_srgb);
        return write(encoded, settings);
    };
}

} // namespace facetmill::io
