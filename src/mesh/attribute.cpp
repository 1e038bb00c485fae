#include "mesh/attribute.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

std::size_t Attribute::size() const {
    return std::visit([&](const auto& v) { return v.size() / static_cast<std::size_t>(components); }, data);
}

const char* Attribute::type() const {
    static constexpr const char* names[] = {"float32", "float64", "uint8",  "int8",
                                            "uint16",  "int16",   "uint32", "int32"};
    return names[data.index()];
}

double Attribute::value(std::size_t i, int c) const {
    return std::visit(
        [&](const auto& v) {
            using T = typename std::decay_t<decltype(v)>::value_type;
            const double x = static_cast<double>(
                v[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)]);
            if constexpr (std::is_integral_v<T>)
                return normalised ? std::max(x / static_cast<double>(std::numeric_limits<T>::max()), -1.0)
                                  : x;
            else
                return x;
        },
        data);
}

void Attribute::set_value(std::size_t i, int c, double x) {
    std::visit(
        [&](auto& v) {
            using T = typename std::decay_t<decltype(v)>::value_type;
            if constexpr (std::is_integral_v<T>)
                if (normalised) x *= static_cast<double>(std::numeric_limits<T>::max());
            v[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)] = as_component<T>(x);
        },
        data);
}

void Attribute::select(std::span<const std::uint32_t> old) {
    const auto k = static_cast<std::size_t>(components);
    std::visit(
        [&](auto& v) {
            std::decay_t<decltype(v)> selected(old.size() * k);
            parallel_for(old.size(),
                         [&](std::size_t i) { std::copy_n(&v[old[i] * k], k, &selected[i * k]); });
            v = std::move(selected);
        },
        data);
}

void Attribute::resize(std::size_t count) {
    std::visit([&](auto& v) { v.resize(count * static_cast<std::size_t>(components)); }, data);
}

const char* to_string(Domain domain) {
    return domain == Domain::vertex ? "vertex" : domain == Domain::wedge ? "wedge" : "face";
}

} // namespace facetmill
