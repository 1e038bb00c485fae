#include "io/ply/table.hpp"

#include "io/attributes.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <type_traits>

namespace facetmill::io::ply {

namespace {

/// Converts a number of the file to T, and clamps it to T's range.
template <class T, class S>
T fitted(S value) {
    if constexpr (std::is_same_v<T, S> || std::is_floating_point_v<T>) {
        return static_cast<T>(value);
    } else {
        const auto x = static_cast<double>(value);
        constexpr auto low = static_cast<double>(std::numeric_limits<T>::min());
        constexpr auto high = static_cast<double>(std::numeric_limits<T>::max());
        return x >= low ? static_cast<T>(std::min(x, high))
                        : std::numeric_limits<T>::min(); // NaN becomes the lowest value
    }
}

/// Interleaves columns of numbers of type T.
template <class T>
std::vector<T> interleaved(const Table& table, const std::vector<std::size_t>& columns) {
    std::vector<T> all(table.count() * columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
        std::visit(
            [&](const auto& values) {
                parallel_for(table.count(),
                             [&](std::size_t i) { all[i * columns.size() + c] = fitted<T>(values[i]); });
            },
            table.columns[columns[c]].values);
    return all;
}

Attribute attribute_of(const Table& table, const std::vector<std::size_t>& columns, std::string name,
                       Domain domain) {
    Attribute a;
    a.name = std::move(name);
    a.domain = domain;
    a.components = static_cast<int>(columns.size());
    const AttributeData& first = table.columns[columns[0]].values;
    std::visit(
        [&](const auto& values) {
            using T = typename std::decay_t<decltype(values)>::value_type;
            a.data = interleaved<T>(table, columns);
        },
        first);
    a.role = role_of(a.name, a.components, a.data);
    a.normalised =
        a.data.index() > 1 && (a.role == Role::colour || a.role == Role::uv || a.role == Role::weights);
    return a;
}

constexpr float most_byte = 255, most_word = 65535;

/// The value of full brightness: 1, 255 or 65535. The header does not give it. All numbers of the file decide
/// together. Overbright fractions up to 2 stay fractions.
float full_brightness(const std::vector<float>& values) {
    constexpr float overbright = 2;
    float largest = 0;
    for (const float x : values)
        if (std::isfinite(x)) largest = std::max(largest, x);
    return largest > overbright && largest <= most_byte  ? most_byte
           : largest > most_byte && largest <= most_word ? most_word
                                                         : 1;
}

bool same_type(const Table& table, const std::vector<std::size_t>& columns) {
    for (const std::size_t c : columns)
        if (table.property(c).type != table.property(columns[0]).type) return false;
    return true;
}

} // namespace

std::vector<std::size_t> Table::take(std::initializer_list<std::string_view> names, bool list) {
    std::vector<std::size_t> found;
    for (const auto name : names)
        for (std::size_t p = 0; p < columns.size(); ++p)
            if (!taken[p] && property(p).name == name && property(p).list == list) {
                found.push_back(p);
                break;
            }
    if (found.size() != names.size()) return {};
    for (const std::size_t p : found) taken[p] = true;
    return found;
}

void add_colours(Table& table, Mesh& mesh, Domain domain, bool are_fractions) {
    for (const auto& [r, g, b, a] :
         {std::array{"red", "green", "blue", "alpha"}, std::array{"r", "g", "b", "a"},
          std::array{"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}}) {
        auto columns = table.take({r, g, b, a});
        if (columns.empty()) columns = table.take({r, g, b});
        if (columns.empty()) continue;
        const Type type = table.property(columns[0]).type;
        Attribute colour{"COLOR_0", domain, Role::colour, static_cast<int>(columns.size()), false, {}};
        if (same_type(table, columns) && type == Type::uint16) {
            colour.data = interleaved<std::uint16_t>(table, columns);
            colour.normalised = true;
        } else if (same_type(table, columns) && type == Type::uint8) {
            colour.data = interleaved<std::uint8_t>(table, columns);
            colour.normalised = true;
        } else if (auto values = interleaved<float>(table, columns);
                   type == Type::float32 || type == Type::float64) {
            const float full = are_fractions ? 1 : full_brightness(values);
            for (float& x : values) x /= full;
            colour.data = std::move(values);
        } else {
            if (full_brightness(values) == most_word)
                colour.data = interleaved<std::uint16_t>(table, columns);
            else
                colour.data = interleaved<std::uint8_t>(table, columns);
            colour.normalised = true;
        }
        add_attribute(mesh, std::move(colour));
        return;
    }
}

void add_normals(Table& table, Mesh& mesh) {
    if (const auto columns = table.take({"nx", "ny", "nz"}); !columns.empty())
        add_attribute(mesh,
                      {"NORMAL", Domain::wedge, Role::normal, 3, false, interleaved<float>(table, columns)});
}

void add_uvs(Table& table, Mesh& mesh) {
    for (const auto& [u, v] : texture_points) {
        const auto columns = table.take({u, v});
        if (columns.empty()) continue;
        auto uv = interleaved<float>(table, columns);
        for (std::size_t i = 1; i < uv.size(); i += 2) uv[i] = 1 - uv[i];
        add_attribute(mesh, {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uv)});
        return;
    }
}

void add_others(Table& table, Mesh& mesh, Domain domain) {
    for (std::size_t p = 0; p < table.columns.size(); ++p) {
        if (table.taken[p] || table.property(p).list) continue;
        std::vector<std::size_t> columns{p};
        std::string name = table.property(p).name;
        if (name.ends_with("_0")) {
            const std::string stem = name.substr(0, name.size() - 2);
            for (std::size_t q = p + 1; q < table.columns.size() && columns.size() < 16; ++q)
                if (!table.taken[q] && !table.property(q).list &&
                    table.property(q).type == table.property(p).type &&
                    table.property(q).name == fmt::format("{}_{}", stem, columns.size()))
                    columns.push_back(q);
            if (columns.size() > 1) name = stem;
        }
        for (const std::size_t q : columns) table.taken[q] = true;
        add_attribute(mesh, attribute_of(table, columns, name, domain));
    }
}

} // namespace facetmill::io::ply
