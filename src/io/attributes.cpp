#include "io/attributes.hpp"

#include "base/text/unique_names.hpp"
#include "base/text/words.hpp"
#include "parallel/parallel.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>
#include <type_traits>
#include <utility>

namespace facetmill::io {

Role role_of(const std::string& name, int components, const AttributeData& data) {
    const bool floats = data.index() <= 1, small = data.index() == 2 || data.index() == 4;
    const auto is = [&](std::string_view stem) { return name.starts_with(stem); };
    if (name == "NORMAL" && components == 3 && floats) return Role::normal;
    if (name == "TANGENT" && components == 4 && floats) return Role::tangent;
    if (is("TEXCOORD_") && components == 2 && (floats || small)) return Role::uv;
    if (is("COLOR_") && (components == 3 || components == 4) && (floats || small)) return Role::colour;
    if (is("JOINTS_") && components == 4 && small) return Role::joints;
    if (is("WEIGHTS_") && components == 4 && (floats || small)) return Role::weights;
    if (is("_FEATURE_ID_") && components == 1) return Role::index; // feature numbers in glTF
    return data.index() >= 4 ? Role::index : Role::generic;
}

void add_attribute(Mesh& mesh, Attribute attribute) {
    attribute.name = free_name(attribute.name, [&](const std::string& name) {
        return name.empty() || name == primitive_attribute || mesh.find(name, attribute.domain) != nullptr;
    });
    // An attribute without the name of its role becomes generic.
    if (attribute.role == Role::normal && attribute.name != "NORMAL") attribute.role = Role::generic;
    mesh.attributes.push_back(std::move(attribute));
}

std::vector<Vec3> to_vectors(const Attribute& attribute) {
    std::vector<Vec3> vectors(attribute.size());
    std::visit(
        [&](const auto& numbers) {
            using T = typename std::decay_t<decltype(numbers)>::value_type;
            const auto width = static_cast<std::size_t>(attribute.components);
            const bool fractions = std::is_integral_v<T> && attribute.normalised;
            parallel_for(vectors.size(), [&](std::size_t i) {
                const T* const n = numbers.data() + width * i;
                if (fractions)
                    vectors[i] = {attribute.value(i, 0), attribute.value(i, 1), attribute.value(i, 2)};
                else
                    vectors[i] = {static_cast<double>(n[0]), static_cast<double>(n[1]),
                                  static_cast<double>(n[2])};
            });
        },
        attribute.data);
    return vectors;
}

void extend_to_wedges(Attribute& attribute, std::span<const Index> wedge_vertex, std::size_t vertices) {
    const auto n = static_cast<std::size_t>(attribute.components);
    std::visit(
        [&](auto& values) {
            values.resize(wedge_vertex.size() * n);
            for (std::size_t w = vertices; w < wedge_vertex.size(); ++w)
                for (std::size_t c = 0; c < n; ++c) values[w * n + c] = values[wedge_vertex[w] * n + c];
        },
        attribute.data);
}

Attribute selected(const Attribute& attribute, std::span<const Index> kept) {
    Attribute other{attribute.name,       attribute.domain,     attribute.role,
                    attribute.components, attribute.normalised, {}};
    const auto n = static_cast<std::size_t>(attribute.components);
    std::visit(
        [&](const auto& values) {
            std::decay_t<decltype(values)> some(kept.size() * n);
            for (std::size_t i = 0; i < kept.size(); ++i)
                for (std::size_t c = 0; c < n; ++c) some[i * n + c] = values[kept[i] * n + c];
            other.data = std::move(some);
        },
        attribute.data);
    return other;
}

namespace {

/// Counts the values for which hold(value) is true, and calls change(value) for each. Skips integers.
template <class Data, class Hold, class Change>
std::size_t count_values(Data& data, const Hold& hold, const Change& change) {
    return std::visit(
        [&](auto& values) -> std::size_t {
            if constexpr (!std::is_floating_point_v<typename std::decay_t<decltype(values)>::value_type>)
                return 0;
            else
                return parallel_reduce(
                    values.size(), std::size_t{0},
                    [&](std::size_t begin, std::size_t end) {
                        std::size_t found = 0;
                        for (std::size_t i = begin; i < end; ++i)
                            if (hold(values[i])) {
                                change(values[i]);
                                ++found;
                            }
                        return found;
                    },
                    [](std::size_t a, std::size_t b) { return a + b; });
        },
        data);
}

constexpr auto lacks_value = [](auto x) { return std::isnan(x); };

/// Only generic attributes may have missing values, because others draw or move a surface.
bool may_lack_values(const Attribute& a) { return a.role == Role::generic; }

} // namespace

NanCounts zero_nan(Mesh& mesh) {
    NanCounts counts;
    for (Attribute& a : mesh.attributes)
        if (const std::size_t found = count_values(a.data, lacks_value, [](auto& x) { x = 0; }))
            counts[a.name] += found;
    return counts;
}

NanCounts nan_of_primitives(const Mesh& mesh) {
    NanCounts counts;
    for (const Attribute& a : mesh.attributes) {
        std::size_t found = count_values(a.data, lacks_value, [](const auto&) {});
        if (found > 0 && a.domain == Domain::wedge && mesh.face_count() > 0) {
            std::vector<bool> has(a.size());
            for (Index f = 0; f < mesh.face_count(); ++f) {
                const Index p = mesh.primitive_of(f);
                if (p >= mesh.primitives.size() || mesh.primitives[p].has(a.name))
                    for (const Index w : mesh.face_wedges(f)) has[w] = true;
            }
            found = 0;
            for (std::size_t w = 0; w < has.size(); ++w)
                for (int c = 0; has[w] && c < a.components; ++c) found += std::isnan(a.value(w, c));
        }
        if (found > 0) counts[a.name] += found;
    }
    return counts;
}

bool has_nan(const Mesh& mesh) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(), [](const Attribute& a) {
        return count_values(a.data, lacks_value, [](const auto&) {}) > 0;
    });
}

void warn_of_nan(const NanCounts& counts, const char* format, std::vector<Diagnostic>& warnings) {
    for (const auto& [name, count] : counts)
        warnings.push_back(
            {Severity::warning,
             "W-NAN",
             fmt::format("{} of '{}' {} no number (nan), which {} cannot hold: {} 0 in the file",
                         counted(count, "value"), name, count == 1 ? "is" : "are", format,
                         count == 1 ? "it is" : "they are"),
             {},
             "write PLY to keep them; if a stage measure made them, give it missing: -1 to store that "
             "number"});
}

void fix_attributes(Part& part, const std::string& file, ReadLog& log) {
    const auto warn = [&](std::size_t count, const Attribute& a, const char* what, const char* hint) {
        if (count > 0)
            log.warnings.push_back({Severity::warning, "W-NAN",
                                    fmt::format("{} of '{}' in part '{}' {} {}", counted(count, "value"),
                                                a.name, part.name, count == 1 ? "is" : "are", what),
                                    file_mark(file), hint});
    };
    for (auto& a : part.mesh.attributes) {
        if (may_lack_values(a)) {
            const std::size_t infinite = count_values(
                a.data,
                [](auto& x) {
                    const bool is = std::isinf(x);
                    // A single NaN pattern, so that equal values have equal bits.
                    if (!std::isfinite(x)) x = std::numeric_limits<std::decay_t<decltype(x)>>::quiet_NaN();
                    return is;
                },
                [](auto&) {});
            warn(infinite, a, "infinite: read as no value",
                 "export the file again if infinity has another meaning");
        } else
            warn(count_values(
                     a.data, [](auto x) { return !std::isfinite(x); }, [](auto& x) { x = 0; }),
                 a, "not finite: set to 0",
                 "export the file again if you need the attribute, because 0 may have a meaning");
    }
}

void drop_short_faces(Mesh& mesh, const std::string& file, ReadLog& log) {
    if (mesh.all_triangles()) return;
    std::vector<Index> kept, corners, offsets{0};
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_size(f) < 3) continue;
        kept.push_back(f);
        const auto wedges = mesh.face_wedges(f);
        corners.insert(corners.end(), wedges.begin(), wedges.end());
        offsets.push_back(static_cast<Index>(corners.size()));
    }
    const std::size_t dropped = mesh.face_count() - kept.size();
    if (dropped == 0) return;
    for (auto& a : mesh.attributes)
        if (a.domain == Domain::face) a = selected(a, kept);
    mesh.corners = std::move(corners);
    mesh.face_offsets = std::move(offsets);
    log.warnings.push_back({Severity::warning, "W-FACES",
                            counted(dropped, "face") + " of fewer than three corners skipped",
                            file_mark(file), ""});
}

// --- colours of faces

bool has_colours_of_faces_only(const Mesh& mesh) {
    return mesh.find("COLOR_0", Domain::face) && !mesh.find("COLOR_0", Domain::wedge) &&
           mesh.face_count() > 0;
}

void move_colours_to_wedges(Mesh& mesh) {
    if (!has_colours_of_faces_only(mesh)) return;
    Attribute of_faces = *mesh.find("COLOR_0", Domain::face);
    mesh.drop("COLOR_0", Domain::face);
    const auto n = static_cast<std::size_t>(of_faces.components);
    std::map<std::vector<double>, Index> first_of; // the first face of each colour
    std::vector<std::uint64_t> keys(mesh.corner_count());
    std::vector<double> colour(n);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        for (std::size_t c = 0; c < n; ++c) colour[c] = of_faces.value(f, static_cast<int>(c));
        const Index first = first_of.try_emplace(colour, f).first->second;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) keys[c] = first;
    }
    const std::size_t before = mesh.wedge_count();
    Wedges wedges = make_wedges(before, std::move(mesh.corners), keys); // of wedges instead of vertices
    mesh.corners = std::move(wedges.corners);
    if (!wedges.wedge_vertex.empty()) {
        for (Attribute& a : mesh.attributes)
            if (a.domain == Domain::wedge) extend_to_wedges(a, wedges.wedge_vertex, before);
        for (Index& w : wedges.wedge_vertex) w = mesh.vertex_of_wedge(w);
        mesh.wedge_vertex = std::move(wedges.wedge_vertex);
    }
    std::vector<Index> face(wedges.keys.size(), 0); // wedges that no face uses get any colour
    for (std::size_t w = 0; w < face.size(); ++w)
        if (wedges.keys[w] != no_key) face[w] = static_cast<Index>(wedges.keys[w]);
    Attribute of_wedges = selected(of_faces, face);
    of_wedges.domain = Domain::wedge;
    mesh.attributes.push_back(std::move(of_wedges));
    for (Primitive& p : mesh.primitives)
        if (!p.attributes.empty()) p.attributes.emplace_back("COLOR_0");
}

// --- wedges

Wedges make_wedges(std::size_t vertices, std::vector<Index> corner_vertex,
                   std::span<const std::uint64_t> corner_key) {
    Wedges w;
    w.keys.assign(vertices, no_key);
    std::vector<bool> used(vertices, false);
    std::vector<Index> next(vertices, none), extra_vertex;
    // The wedges of a vertex are a short list. A hostile file may have millions at a vertex, so long lists
    // use a map.
    constexpr int longest_walk = 64;
    std::map<std::pair<Index, std::uint64_t>, Index> crowded;
    for (std::size_t c = 0; c < corner_vertex.size(); ++c) {
        const Index v = corner_vertex[c];
        if (!used[v]) {
            used[v] = true;
            w.keys[v] = corner_key[c];
            continue;
        }
        Index wedge = v;
        int steps = 0;
        while (w.keys[wedge] != corner_key[c] && next[wedge] != none && ++steps < longest_walk)
            wedge = next[wedge];
        if (w.keys[wedge] != corner_key[c]) {
            const auto fresh = static_cast<Index>(w.keys.size());
            Index& slot = steps < longest_walk ? next[wedge]
                                               : crowded.try_emplace({v, corner_key[c]}, none).first->second;
            if (slot == none) {
                slot = fresh;
                w.keys.push_back(corner_key[c]);
                next.push_back(none);
                extra_vertex.push_back(v);
            }
            wedge = w.keys.size() > fresh ? fresh : crowded.at({v, corner_key[c]});
        }
        corner_vertex[c] = wedge;
    }
    w.corners = std::move(corner_vertex);
    if (extra_vertex.empty()) return w;
    w.wedge_vertex.resize(vertices);
    std::iota(w.wedge_vertex.begin(), w.wedge_vertex.end(), Index{0});
    w.wedge_vertex.insert(w.wedge_vertex.end(), extra_vertex.begin(), extra_vertex.end());
    return w;
}

} // namespace facetmill::io
