#include "io/ply/ply.hpp"

#include "base/progress.hpp"
#include "io/flatten.hpp"
#include "io/metadata.hpp"
#include "io/stated.hpp"
#include "parallel/parallel.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <type_traits>

namespace facetmill::io::ply {

namespace {

/// A scalar property to be written: one component of every row.
struct Out {
    std::string name;
    std::shared_ptr<const AttributeData> values;
    std::size_t components = 1, component = 0;
    Type type() const { return static_cast<Type>(values->index()); }
};

const char* name_of(Type type) {
    static constexpr const char* names[] = {"float",  "double", "uchar", "char",
                                            "ushort", "short",  "uint",  "int"};
    return names[static_cast<std::size_t>(type)];
}

std::shared_ptr<const AttributeData> shared(AttributeData data) {
    return std::make_shared<const AttributeData>(std::move(data));
}

/// Property names of an attribute's components.
std::vector<std::string> names_of(const Attribute& a) {
    if (a.name == "NORMAL" && a.components == 3) return {"nx", "ny", "nz"};
    if (a.name == "TEXCOORD_0" && a.components == 2) return {"s", "t"};
    if (a.name == "COLOR_0" && a.components == 3) return {"red", "green", "blue"};
    if (a.name == "COLOR_0" && a.components == 4) return {"red", "green", "blue", "alpha"};
    std::string stem = a.name;
    for (char& c : stem)
        if (static_cast<unsigned char>(c) <= ' ') c = '_';
    if (a.components == 1) return {stem};
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(a.components));
    for (int c = 0; c < a.components; ++c) names.push_back(fmt::format("{}_{}", stem, c));
    return names;
}

/// The attribute's values, one element per row. Texture coordinates are flipped, because v starts at the
/// bottom in PLY.
std::shared_ptr<const AttributeData> rows_of(const Attribute& a, const Mesh& mesh, bool by_wedge) {
    AttributeData data = a.data;
    const auto n = static_cast<std::size_t>(a.components);
    if (a.domain == Domain::vertex && by_wedge && mesh.has_seams())
        std::visit(
            [&](auto& values) {
                std::decay_t<decltype(values)> all(mesh.wedge_count() * n);
                for (std::size_t w = 0; w < mesh.wedge_count(); ++w)
                    for (std::size_t c = 0; c < n; ++c) all[w * n + c] = values[mesh.wedge_vertex[w] * n + c];
                values = std::move(all);
            },
            data);
    if (a.name == "TEXCOORD_0" && a.components == 2) {
        std::vector<float> uv(a.size() * 2);
        for (std::size_t i = 0; i < a.size(); ++i) {
            uv[2 * i] = static_cast<float>(a.value(i, 0));
            uv[2 * i + 1] = 1 - static_cast<float>(a.value(i, 1));
        }
        data = std::move(uv);
    }
    return shared(std::move(data));
}

void add(std::vector<Out>& columns, std::vector<std::string> names,
         const std::shared_ptr<const AttributeData>& values) {
    const std::size_t n = names.size();
    for (std::size_t c = 0; c < n; ++c) columns.push_back({std::move(names[c]), values, n, c});
}

/// The first wedge of each vertex, which gives the vertex its attributes.
std::vector<Index> first_wedges(const Mesh& mesh) {
    std::vector<Index> first(mesh.vertex_count(), none);
    for (Index w = 0; w < mesh.wedge_count(); ++w)
        if (Index& slot = first[mesh.vertex_of_wedge(w)]; slot == none) slot = w;
    return first;
}

/// Whether the wedges of a vertex differ only in texture coordinates. Then PLY can hold these per corner (as
/// MeshLab writes them) without splitting vertices.
bool only_uv_seams(const Mesh& mesh, const std::vector<Index>& first) {
    const Attribute* uv = mesh.find("TEXCOORD_0", Domain::wedge);
    if (!uv || uv->components != 2) return false;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
        if (first[v] == none) return false;
    for (const auto& a : mesh.attributes) {
        if (a.domain != Domain::wedge || &a == uv) continue;
        const bool equal = std::visit(
            [&](const auto& values) {
                const auto n = static_cast<std::size_t>(a.components);
                for (std::size_t w = 0; w < mesh.wedge_count(); ++w)
                    if (!std::equal(&values[w * n], &values[w * n] + n,
                                    &values[first[mesh.vertex_of_wedge(w)] * n]))
                        return false;
                return true;
            },
            a.data);
        if (!equal) return false;
    }
    return true;
}

struct Layout {
    const Mesh& mesh;
    const WriteSettings& settings;
    bool split = false;      ///< a row per wedge instead of per vertex
    bool corner_uvs = false; ///< texture coordinates per corner
    std::shared_ptr<const AttributeData> uv;
    std::vector<Out> vertex, face;
    Type count_type = Type::uint8;

    std::size_t rows() const { return split ? mesh.wedge_count() : mesh.vertex_count(); }
    Index row(Index wedge) const { return split ? wedge : mesh.vertex_of_wedge(wedge); }
};

void add_positions(Layout& l) {
    const auto fill = [&]<class T>(std::vector<T> xyz) {
        xyz.resize(l.rows() * 3);
        parallel_for(l.rows(), [&](std::size_t i) {
            const Vec3& p = l.mesh.positions[l.split ? l.mesh.vertex_of_wedge(static_cast<Index>(i)) : i];
            for (std::size_t c = 0; c < 3; ++c) xyz[3 * i + c] = static_cast<T>(p[c]);
        });
        add(l.vertex, {"x", "y", "z"}, shared(std::move(xyz)));
    };
    if (l.settings.double_positions)
        fill(std::vector<double>{});
    else
        fill(std::vector<float>{});
}

AttributeData picked(const AttributeData& data, std::size_t n, const std::vector<Index>& from) {
    return std::visit(
        [&](const auto& values) -> AttributeData {
            std::decay_t<decltype(values)> some(from.size() * n);
            for (std::size_t i = 0; i < from.size(); ++i)
                for (std::size_t c = 0; c < n; ++c) some[i * n + c] = values[from[i] * n + c];
            return some;
        },
        data);
}

void add_attributes(Layout& l, const std::vector<Index>& first, Written& written) {
    static constexpr std::string_view front[] = {"NORMAL", "TEXCOORD_0", "COLOR_0"};
    std::vector<const Attribute*> order;
    for (const auto name : front)
        for (const auto& a : l.mesh.attributes)
            if (a.name == name) order.push_back(&a);
    for (const auto& a : l.mesh.attributes)
        if (std::find(std::begin(front), std::end(front), a.name) == std::end(front)) order.push_back(&a);
    for (const Attribute* a : order) {
        if (a->domain == Domain::face) {
            if (a->name != primitive_attribute) add(l.face, names_of(*a), rows_of(*a, l.mesh, false));
        } else if (a->role == Role::morph_vector) {
            dropped(written, *a, "PLY has no morph targets");
        } else if (l.corner_uvs && a->name == "TEXCOORD_0") {
            l.uv = rows_of(*a, l.mesh, false);
        } else if (l.corner_uvs && a->domain == Domain::wedge) {
            add(l.vertex, names_of(*a),
                shared(picked(*rows_of(*a, l.mesh, false), static_cast<std::size_t>(a->components), first)));
        } else {
            add(l.vertex, names_of(*a), rows_of(*a, l.mesh, l.split));
        }
    }
    if (l.mesh.primitives.size() > 1) {
        std::vector<std::int32_t> materials(l.mesh.face_count());
        for (Index f = 0; f < l.mesh.face_count(); ++f)
            materials[f] = static_cast<std::int32_t>(l.mesh.primitives[l.mesh.primitive_of(f)].material);
        add(l.face, {"material_index"}, shared(std::move(materials)));
    }
}

/// The metadata as comments. Comments that were obj_info lines become such lines again.
std::string comments_of(const Scene& scene) {
    constexpr std::string_view comment = "comment ", of_info = "\ncomment obj_info ";
    std::string text = "\n" + metadata_comments(scene, comment);
    for (auto at = text.find(of_info); at != text.npos; at = text.find(of_info, at))
        text.erase(at + 1, comment.size());
    return text.substr(1);
}

std::string header_of(const Layout& l, const Scene& scene) {
    const char* encoding = l.settings.ascii        ? "ascii"
                           : l.settings.big_endian ? "binary_big_endian"
                                                   : "binary_little_endian";
    std::string text =
        fmt::format("ply\nformat {} 1.0\ncomment written by facetmill\n{}element vertex {}\n", encoding,
                    stated_comments(scene, "comment ") + comments_of(scene), l.rows());
    for (const auto& c : l.vertex) text += fmt::format("property {} {}\n", name_of(c.type()), c.name);
    text += fmt::format("element face {}\nproperty list {} int vertex_indices\n", l.mesh.face_count(),
                        name_of(l.count_type));
    if (l.corner_uvs) text += fmt::format("property list {} float texcoord\n", name_of(l.count_type));
    for (const auto& c : l.face) text += fmt::format("property {} {}\n", name_of(c.type()), c.name);
    if (!l.mesh.lines.empty())
        text +=
            fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\n", l.mesh.line_count());
    return text + "end_header\n";
}

void put_columns(std::string& out, const std::vector<Out>& columns, std::size_t row, bool first) {
    for (const auto& c : columns) {
        if (!first) out += ' ';
        first = false;
        std::visit(
            [&](const auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                const T value = values[row * c.components + c.component];
                if constexpr (std::is_floating_point_v<T>)
                    put_number(out, value);
                else
                    put_number(out, static_cast<std::int64_t>(value));
            },
            *c.values);
    }
}

void write_ascii(Bytes& bytes, const Layout& l) {
    ProgressSteps steps({2, 3});
    append_text(bytes, l.rows(), [&](std::size_t begin, std::size_t end, std::string& out) {
        for (std::size_t i = begin; i < end; ++i) {
            put_columns(out, l.vertex, i, true);
            out += '\n';
        }
    });
    steps.next();
    append_text(bytes, l.mesh.face_count(), [&](std::size_t begin, std::size_t end, std::string& out) {
        for (auto f = static_cast<Index>(begin); f < end; ++f) {
            put_number(out, static_cast<std::int64_t>(l.mesh.face_size(f)));
            for (const Index w : l.mesh.face_wedges(f)) {
                out += ' ';
                put_number(out, static_cast<std::int64_t>(l.row(w)));
            }
            if (l.corner_uvs) {
                out += ' ';
                put_number(out, 2 * static_cast<std::int64_t>(l.mesh.face_size(f)));
                for (const Index w : l.mesh.face_wedges(f))
                    for (std::size_t c = 0; c < 2; ++c) {
                        out += ' ';
                        put_number(out, std::get<0>(*l.uv)[2 * w + c]);
                    }
            }
            put_columns(out, l.face, f, false);
            out += '\n';
        }
    });
    append_text(bytes, l.mesh.line_count(), [&](std::size_t begin, std::size_t end, std::string& out) {
        for (std::size_t i = begin; i < end; ++i) {
            put_number(out, static_cast<std::int64_t>(l.row(l.mesh.lines[2 * i])));
            out += ' ';
            put_number(out, static_cast<std::int64_t>(l.row(l.mesh.lines[2 * i + 1])));
            out += '\n';
        }
    });
}

template <class T>
std::byte* store(std::byte* to, T value, bool swap) {
    auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    if (swap) std::reverse(raw.begin(), raw.end());
    std::memcpy(to, raw.data(), sizeof(T));
    return to + sizeof(T);
}

std::byte* store_count(std::byte* to, std::size_t count, Type type, bool swap) {
    if (type == Type::uint8) return store(to, static_cast<std::uint8_t>(count), swap);
    return store(to, static_cast<std::uint32_t>(count), swap);
}

std::size_t row_size(const std::vector<Out>& columns) {
    std::size_t size = 0;
    for (const auto& c : columns) size += size_of(c.type());
    return size;
}

std::byte* store_row(std::byte* to, const std::vector<Out>& columns, std::size_t row, bool swap) {
    for (const auto& c : columns)
        to = std::visit(
            [&](const auto& values) { return store(to, values[row * c.components + c.component], swap); },
            *c.values);
    return to;
}

void write_binary(Bytes& bytes, const Layout& l) {
    const bool swap = l.settings.big_endian == (std::endian::native == std::endian::little);
    const std::size_t vertex_size = row_size(l.vertex), start = bytes.size(),
                      faces_at = start + l.rows() * vertex_size;
    const std::size_t per_face = size_of(l.count_type) * (l.corner_uvs ? 2 : 1) + row_size(l.face);
    const std::size_t per_corner = l.corner_uvs ? 12 : 4;
    const std::size_t lines_at =
        faces_at + l.mesh.face_count() * per_face + l.mesh.corner_count() * per_corner;
    bytes.resize(lines_at + l.mesh.lines.size() * sizeof(std::int32_t));
    parallel_for(l.rows(),
                 [&](std::size_t i) { store_row(&bytes[start] + i * vertex_size, l.vertex, i, swap); });
    parallel_for(l.mesh.face_count(), [&](std::size_t i) {
        const auto f = static_cast<Index>(i);
        std::byte* to = bytes.data() + faces_at + i * per_face + l.mesh.face_begin(f) * per_corner;
        to = store_count(to, l.mesh.face_size(f), l.count_type, swap);
        for (const Index w : l.mesh.face_wedges(f)) to = store(to, static_cast<std::int32_t>(l.row(w)), swap);
        if (l.corner_uvs) {
            to = store_count(to, 2 * std::size_t{l.mesh.face_size(f)}, l.count_type, swap);
            for (const Index w : l.mesh.face_wedges(f))
                for (std::size_t c = 0; c < 2; ++c) to = store(to, std::get<0>(*l.uv)[2 * w + c], swap);
        }
        store_row(to, l.face, i, swap);
    });
    for (std::size_t i = 0; i < l.mesh.lines.size(); ++i)
        store(bytes.data() + lines_at + i * sizeof(std::int32_t),
              static_cast<std::int32_t>(l.row(l.mesh.lines[i])), swap);
}

/// The fewest and the most corners of a face; 0 and 0 without faces.
std::pair<Index, Index> face_sizes(const Mesh& mesh) {
    if (mesh.face_count() == 0) return {};
    std::pair<Index, Index> sizes(none, 0);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        sizes.first = std::min(sizes.first, mesh.face_size(f));
        sizes.second = std::max(sizes.second, mesh.face_size(f));
    }
    return sizes;
}

/// Adds a note if a binary file has faces of different sizes, because readers that expect rows of equal
/// length fail. MeshLab and Blender read such files.
void note_polygons(Written& written, Index smallest, Index largest) {
    if (smallest == largest) return;
    written.warnings.push_back(
        {Severity::note,
         {},
         fmt::format("faces have {} to {} corners, which trimesh and some other programs cannot read in "
                     "binary PLY: use triangulate: true for them",
                     smallest, largest),
         {},
         {}});
}

} // namespace

Written write(const Scene& scene, const WriteSettings& settings) {
    const WorldMesh world(scene);
    if (!settings.double_positions) require_floats(*world, "the scene");
    Written written;
    Layout l{*world, settings, false, false, {}, {}, {}, Type::uint8};
    std::vector<Index> first;
    if (world->has_seams()) {
        first = first_wedges(*world);
        l.corner_uvs = only_uv_seams(*world, first);
        l.split = !l.corner_uvs;
    }
    const auto [smallest, largest] = face_sizes(*world);
    if (largest > (l.corner_uvs ? 127 : 255)) l.count_type = Type::uint32;
    add_positions(l);
    add_attributes(l, first, written);
    if (l.split && world->wedge_count() > world->vertex_count())
        written.changes.push_back({"vertices", Domain::vertex, AttributeChange::Kind::recomputed,
                                   fmt::format("{} vertices became {}: PLY has one set of attributes at a "
                                               "vertex, so vertices on seams were split",
                                               world->vertex_count(), world->wedge_count())});
    leave_documents(written, scene, "PLY", {"metadata"});
    warn_of_dropped(written, scene, "PLY");
    if (!settings.ascii) note_polygons(written, smallest, largest);
    warn_of_parts(written, scene, "PLY");
    drop_materials(written, scene, "PLY");
    Bytes bytes;
    append(bytes, header_of(l, scene));
    if (settings.ascii)
        write_ascii(bytes, l);
    else
        write_binary(bytes, l);
    written.files.push_back({settings.title + ".ply", std::move(bytes)});
    return written;
}

} // namespace facetmill::io::ply
