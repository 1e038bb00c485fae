#pragma once
// Named, typed arrays for the vertices, wedges or faces of a mesh.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace facetmill {

enum class Domain { vertex, wedge, face };

/// The meaning of the numbers, which decides how they are mixed.
enum class Role {
    generic,      ///< mixed linearly (integers: rounded; see Provenance)
    normal,       ///< unit vector, 3 components; mixed, then renormalised
    tangent,      ///< unit vector and a sign, 4 components; the first parent gives the sign
    uv,           ///< 2 components
    colour,       ///< 3 or 4 components
    joints,       ///< 4 integers; belongs to the weights of the same set
    weights,      ///< 4 numbers summing to one over all sets
    morph_vector, ///< a displacement (morph target of positions, normals or tangents), mixed linearly
    index, ///< an identifier (primitive, group, cut_id); never mixed, because the first parent gives the
           ///< value
};

/// An array of one component type, with count * components numbers, element by element.
using AttributeData =
    std::variant<std::vector<float>, std::vector<double>, std::vector<std::uint8_t>, std::vector<std::int8_t>,
                 std::vector<std::uint16_t>, std::vector<std::int16_t>, std::vector<std::uint32_t>,
                 std::vector<std::int32_t>>;

/// An attribute of a mesh. Names follow glTF if it defines one (NORMAL, TEXCOORD_0, COLOR_0, JOINTS_0,
/// WEIGHTS_0, TANGENT). Otherwise they are the file's own (quality, confidence).
struct Attribute {
    std::string name;
    Domain domain = Domain::wedge;
    Role role = Role::generic;
    int components = 1;
    bool normalised = false; ///< integers are fractions of their type's maximum, as in glTF
    AttributeData data;

    /// The number of elements: numbers / components.
    std::size_t size() const;
    /// The type as text: "float32", "uint8" ...
    const char* type() const;
    /// Component c of element i as a number; a fraction if normalised.
    double value(std::size_t i, int c) const;
    /// Sets component c of element i. Integers are rounded to nearest, ties up, and clamped to their type's
    /// range.
    void set_value(std::size_t i, int c, double x);
    /// Element i becomes a copy of element old[i].
    void select(std::span<const std::uint32_t> old);
    /// Changes the number of elements. New elements are zero.
    void resize(std::size_t count);
};

/// x as a component of type T. Integers are rounded to nearest, ties up, and clamped. NaN becomes 0.
template <class T>
T as_component(double x) {
    if constexpr (std::is_integral_v<T>) {
        constexpr double low = std::numeric_limits<T>::min(), high = std::numeric_limits<T>::max();
        return x >= high  ? std::numeric_limits<T>::max()
               : x > low  ? static_cast<T>(std::floor(x + 0.5))
               : x <= low ? std::numeric_limits<T>::min()
                          : T{0};
    } else {
        return static_cast<T>(x);
    }
}

/// The name of a domain for users.
[[nodiscard]] const char* to_string(Domain domain);

} // namespace facetmill
