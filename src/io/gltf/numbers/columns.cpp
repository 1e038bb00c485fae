#include "io/gltf/numbers/columns.hpp"

#include "io/gltf/document/accessor.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace facetmill::io::gltf {

namespace {

/// "TEXCOORD_" followed by a number without leading zeros.
bool numbered(std::string_view name, std::string_view prefix) {
    if (name.substr(0, prefix.size()) != prefix) return false;
    const std::string_view digits = name.substr(prefix.size());
    return !digits.empty() && digits.size() < 4 &&
           digits.find_first_not_of("0123456789") == std::string_view::npos &&
           (digits == "0" || digits[0] != '0');
}

/// True if glTF defines the name for this number of components.
bool standard(std::string_view name, int components) {
    if (name == "NORMAL") return components == 3;
    if (name == "TANGENT") return components == 4;
    if (numbered(name, "TEXCOORD_")) return components == 2;
    if (numbered(name, "COLOR_")) return components == 3 || components == 4;
    return (numbered(name, "JOINTS_") || numbered(name, "WEIGHTS_")) && components == 4;
}

/// Splits "TARGET_3_NORMAL" into 3 and "NORMAL". The target is -1 for other names.
std::pair<int, std::string> target_of(const Attribute& a) {
    int number = -1;
    const char* begin = a.name.data() + 7;
    const char* end = a.name.data() + a.name.size();
    if (a.name.rfind("TARGET_", 0) != 0 || a.components < 2 || a.components > 4) return {-1, a.name};
    const auto [at, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || at == end || *at != '_' || number < 0 || number > 9999) return {-1, a.name};
    return {number, std::string(at + 1, end)};
}

/// True when glTF allows the attribute's type of numbers under that name.
bool allowed(const std::string& semantic, int target, const Attribute& a, bool quantised) {
    const int type = component_type_of(a.data);
    if (type == float32) return true;
    if (type == 0 || type == uint32) return false;
    if (semantic[0] == '_') return target < 0;
    const bool fraction = (type == uint8 || type == uint16) && a.normalised;
    if (semantic.rfind("JOINTS_", 0) == 0) return (type == uint8 || type == uint16) && !a.normalised;
    if (semantic.rfind("COLOR_", 0) == 0 || semantic.rfind("WEIGHTS_", 0) == 0) return fraction;
    if (semantic.rfind("TEXCOORD_", 0) == 0) return fraction || quantised;
    return quantised && (type == int8 || type == int16) && (a.normalised || semantic == "POSITION");
}

bool fits_uint16(const Attribute& a) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < a.components; ++c)
            if (const double x = a.value(i, c); !(x >= 0 && x <= 65535)) return false;
    return true;
}

/// True if all floats are 16-bit integers: stored as integers, they are not rounded.
bool are_small_numbers(const Attribute& a) {
    const auto* floats = std::get_if<std::vector<float>>(&a.data);
    return floats && std::all_of(floats->begin(), floats->end(),
                                 [](float x) { return x >= 0 && x <= 65535 && x == std::floor(x); });
}

template <class T>
AttributeData converted(const Attribute& a) {
    std::vector<T> to(a.size() * static_cast<std::size_t>(a.components));
    const std::size_t width = static_cast<std::size_t>(a.components);
    parallel_for(a.size(), [&](std::size_t i) {
        for (std::size_t c = 0; c < width; ++c)
            to[i * width + c] = static_cast<T>(a.value(i, static_cast<int>(c)));
    });
    return to;
}

void convert(Attribute& a, const std::string& semantic, AttributeChanges& changes) {
    const bool integers = !std::holds_alternative<std::vector<float>>(a.data) &&
                          !std::holds_alternative<std::vector<double>>(a.data) && !a.normalised;
    const bool whole =
        integers && (semantic[0] == '_' || semantic.rfind("JOINTS_", 0) == 0) && fits_uint16(a);
    const char* from = a.type();
    AttributeData data = whole ? converted<std::uint16_t>(a) : converted<float>(a);
    changes.push_back({a.name, a.domain, AttributeChange::Kind::kept,
                       fmt::format("written as {}, because glTF does not allow {} for it",
                                   whole ? "uint16" : "float32", from)});
    a.data = std::move(data);
    a.normalised = false;
}

/// Normalises normals and the first three numbers of tangents; zero vectors get a direction.
void make_unit(Attribute& a) {
    auto* numbers = std::get_if<std::vector<float>>(&a.data);
    if (!numbers) return;
    const std::size_t width = static_cast<std::size_t>(a.components);
    parallel_for(a.size(), [&](std::size_t i) {
        float* n = numbers->data() + i * width;
        const Vec3 v{n[0], n[1], n[2]};
        const double l = length(v);
        const Vec3 unit = l > 0 && l < HUGE_VAL ? v / l : Vec3{0, 0, 1};
        // Vectors that are already of unit length stay unchanged.
        if (!(l > 0.9999995 && l < 1.0000005))
            for (std::size_t c = 0; c < 3; ++c) n[c] = static_cast<float>(unit[c]);
        if (width == 4) n[3] = n[3] < 0 ? -1.0f : 1.0f;
    });
}

void clamp_to_one(Attribute& a) {
    if (auto* numbers = std::get_if<std::vector<float>>(&a.data))
        parallel_for(numbers->size(), [&](std::size_t i) {
            float& x = (*numbers)[i];
            x = x > 0 ? std::min(x, 1.0f) : 0.0f; // also maps NaN
        });
}

/// Normalises the weights of a single set to a sum of one, as glTF requires within a few units in the last
/// place. Several sets stay unchanged, because their sum includes all sets.
void normalise_weights(Attribute& a) {
    auto* numbers = std::get_if<std::vector<float>>(&a.data);
    if (!numbers) return;
    parallel_for(a.size(), [&](std::size_t i) {
        float* w = numbers->data() + i * 4;
        const double sum = double{w[0]} + w[1] + w[2] + w[3];
        if (sum > 0 && (sum < 1 - 1e-6 || sum > 1 + 1e-6))
            for (int c = 0; c < 4; ++c) w[c] = static_cast<float>(w[c] / sum);
        if (!(sum > 0)) w[0] = 1; // such vertices follow their first joint, as in three.js
    });
}

void keep_rules(Column& column, bool one_set_of_weights) {
    const std::string& name = column.semantic;
    if (column.target >= 0) return;
    if (name == "NORMAL" || name == "TANGENT") make_unit(column.data);
    if (name.rfind("COLOR_", 0) == 0 || name.rfind("WEIGHTS_", 0) == 0) clamp_to_one(column.data);
    if (name == "WEIGHTS_0" && one_set_of_weights) normalise_weights(column.data);
}

} // namespace

const char* type_name(int components) {
    switch (components) {
    case 1:
        return "SCALAR";
    case 2:
        return "VEC2";
    case 3:
        return "VEC3";
    case 4:
        return "VEC4";
    case 9:
        return "MAT3";
    default:
        return components == 16 ? "MAT4" : nullptr;
    }
}

std::vector<Column> columns_of(const Mesh& mesh, const ColumnSettings& settings, AttributeChanges& changes) {
    std::vector<Column> columns;
    const auto drop = [&](const Attribute& a, std::string why) {
        changes.push_back({a.name, a.domain, AttributeChange::Kind::dropped, std::move(why)});
    };
    const bool one_set = !mesh.find("WEIGHTS_1", Domain::wedge) && !mesh.find("WEIGHTS_1", Domain::vertex);
    for (const auto& a : mesh.attributes) {
        if (a.domain == Domain::face) {
            if (a.name != primitive_attribute) drop(a, "glTF has no face attributes");
            continue;
        }
        auto [target, semantic] = target_of(a);
        if (target < 0 && !standard(semantic, a.components) && semantic[0] != '_') semantic.insert(0, "_");
        const bool skin = semantic.rfind("JOINTS_", 0) == 0 || semantic.rfind("WEIGHTS_", 0) == 0;
        if (!settings.skinned && skin) {
            drop(a, "its skin is in another document");
            continue;
        }
        const bool matrix_of_floats = a.components <= 4 || component_type_of(a.data) == float32;
        if (!type_name(a.components) || !matrix_of_floats) {
            drop(a, fmt::format("glTF has no elements of {} numbers", a.components));
            continue;
        }
        const auto taken = [&semantic = semantic, target = target](const Column& c) {
            return c.semantic == semantic && c.target == target;
        };
        if (std::any_of(columns.begin(), columns.end(), taken)) {
            drop(a, "another attribute already has its name");
            continue;
        }
        Column column{semantic, target, a};
        if (!allowed(semantic, target, a, settings.quantised)) convert(column.data, semantic, changes);
        if (a.role == Role::index && are_small_numbers(column.data))
            column.data.data = converted<std::uint16_t>(column.data);
        keep_rules(column, one_set);
        columns.push_back(std::move(column));
    }
    return columns;
}

} // namespace facetmill::io::gltf
