#include "io/gltf/numbers/alike.hpp"

#include "io/gltf/numbers/quantise.hpp"
#include "mesh/first_of_equal.hpp"
#include "parallel/parallel.hpp"

#include <cstring>
#include <functional>
#include <string_view>

namespace facetmill::io::gltf {

namespace {

/// The column's bytes after rounding, or unchanged if it is not rounded.
Stored rounded(const Attribute& a, const Column& column, const EncodeSettings& settings) {
    const QuantizeSettings& to = settings.quantize;
    const auto of = [&](const char* prefix) { return column.semantic.rfind(prefix, 0) == 0; };
    std::optional<Stored> stored;
    if (column.target >= 0 || !std::holds_alternative<std::vector<float>>(a.data))
        return plain(a.data, a.components, a.normalised, false);
    if ((of("NORMAL") || of("TANGENT")) && a.components >= 3)
        stored = settings.filters ? octahedral(a, to.normal_bits) : signed_fractions(a, to.normal_bits);
    else if (of("TEXCOORD_"))
        stored = settings.filters ? exponential(a, -to.uv_bits, false) : fractions(a, to.uv_bits);
    else if (of("COLOR_"))
        stored = fractions(a, to.colour_bits);
    return stored ? std::move(*stored) : plain(a.data, a.components, a.normalised, false);
}

/// The concatenated bytes of each wedge.
struct Rows {
    std::size_t width = 0;
    std::string bytes;
    std::string_view row(std::size_t i) const { return std::string_view(bytes).substr(i * width, width); }
};

Rows rows_of(const Mesh& mesh, const Table& table, const std::vector<Column>& columns,
             const EncodeSettings& settings) {
    const std::size_t count = table.wedges.size();
    std::vector<Stored> all;
    Rows rows{sizeof(Vec3), {}};
    for (const Column& column : columns) {
        if (column.target < 0 && !has_column(mesh, table.primitive, column)) continue;
        Attribute a = column.data;
        a.domain = Domain::wedge;
        a.data = gathered(mesh, column, table.wedges);
        all.push_back(rounded(a, column, settings));
        rows.width += all.back().bytes.size() / count;
    }
    rows.bytes.resize(rows.width * count);
    parallel_for(count, [&](std::size_t i) {
        char* at = &rows.bytes[i * rows.width];
        const Vec3 p = mesh.positions[mesh.vertex_of_wedge(table.wedges[i])] + Vec3{}; // -0 is 0
        std::memcpy(at, &p, sizeof(p));
        at += sizeof(p);
        for (const Stored& stored : all) {
            const std::size_t size = stored.bytes.size() / count;
            std::memcpy(at, stored.bytes.data() + i * size, size);
            at += size;
        }
    });
    return rows;
}

} // namespace

void merge_alike(const Mesh& mesh, Table& table, const std::vector<Column>& columns,
                 const EncodeSettings& settings) {
    const std::size_t count = table.wedges.size();
    if (count == 0) return;
    const Rows rows = rows_of(mesh, table, columns, settings);
    const std::vector<Index> first = first_of_equal(
        count, [&](Index i) { return std::hash<std::string_view>()(rows.row(i)); },
        [&](Index i, Index j) { return rows.row(i) == rows.row(j); });
    std::vector<Index> number(count, none), kept;
    for (Index i = 0; i < count; ++i) {
        if (first[i] == i) {
            number[i] = static_cast<Index>(kept.size());
            kept.push_back(table.wedges[i]);
        }
        number[i] = number[first[i]]; // the first wedge has the lowest number
    }
    if (kept.size() == count) return;
    table.wedges = std::move(kept);
    for (Index& w : table.indices) w = number[w];
}

} // namespace facetmill::io::gltf
