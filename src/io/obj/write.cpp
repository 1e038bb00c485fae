#include "base/ordered_set.hpp"
#include "base/progress.hpp"
#include "io/flatten.hpp"
#include "io/metadata.hpp"
#include "io/obj/scene_library.hpp"
#include "io/stated.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <unordered_map>

namespace facetmill::io::obj {

namespace {

/// The distinct values of an attribute in the order of their first wedge, and the value of each wedge. So
/// vertices with equal texture coordinates or normals share a statement.
struct Pool {
    std::vector<float> values;
    std::vector<Index> of_wedge;
    std::size_t components = 0;
};

Pool pool_of(const Attribute& a, bool from_bottom) {
    Pool pool;
    pool.components = static_cast<std::size_t>(a.components);
    struct Key {
        std::uint32_t bits[3];
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& k) const {
            std::uint64_t h = k.bits[0] * 0x9e3779b97f4a7c15ULL;
            for (int i = 1; i < 3; ++i) h = (h ^ (h >> 29) ^ k.bits[i]) * 0xbf58476d1ce4e5b9ULL;
            return h ^ (h >> 32);
        }
    };
    std::unordered_map<Key, Index, Hash> known; // lookup only; its order never matters
    known.reserve(a.size());
    for (std::size_t w = 0; w < a.size(); ++w) {
        Key key{{0, 0, 0}};
        float value[3] = {0, 0, 0};
        for (std::size_t c = 0; c < pool.components; ++c) {
            value[c] = static_cast<float>(a.value(w, static_cast<int>(c)));
            if (from_bottom && c == 1) value[c] = 1 - value[c];
            key.bits[c] = std::bit_cast<std::uint32_t>(value[c]);
        }
        const auto [at, fresh] = known.try_emplace(key, static_cast<Index>(known.size()));
        if (fresh) pool.values.insert(pool.values.end(), value, value + pool.components);
        pool.of_wedge.push_back(at->second);
    }
    return pool;
}

void put_values(Bytes& bytes, const char* word, const Pool& pool) {
    if (pool.components == 0) return;
    append_text(bytes, pool.values.size() / pool.components,
                [&](std::size_t begin, std::size_t end, std::string& out) {
                    for (std::size_t i = begin; i < end; ++i) {
                        out += word;
                        for (std::size_t c = 0; c < pool.components; ++c) {
                            out += ' ';
                            put_number(out, pool.values[i * pool.components + c]);
                        }
                        out += '\n';
                    }
                });
}

void put_vertices(Bytes& bytes, const Mesh& mesh, bool all_digits) {
    const Attribute* colour = mesh.find("COLOR_0", Domain::wedge);
    std::vector<Index> wedge;
    if (colour) {
        wedge.assign(mesh.vertex_count(), none);
        for (Index w = 0; w < mesh.wedge_count(); ++w)
            if (Index& slot = wedge[mesh.vertex_of_wedge(w)]; slot == none) slot = w;
    }
    append_text(bytes, mesh.vertex_count(), [&](std::size_t begin, std::size_t end, std::string& out) {
        for (std::size_t v = begin; v < end; ++v) {
            out += 'v';
            for (std::size_t c = 0; c < 3; ++c) {
                out += ' ';
                if (all_digits)
                    put_number(out, mesh.positions[v][c]);
                else
                    put_number(out, static_cast<float>(mesh.positions[v][c]));
            }
            for (int c = 0; colour && c < 3; ++c) {
                out += ' ';
                put_number(out, wedge[v] == none ? 1.0F : static_cast<float>(colour->value(wedge[v], c)));
            }
            out += '\n';
        }
    });
}

struct Offsets {
    std::int64_t vertex = 1, uv = 1, normal = 1; ///< OBJ counts from 1 over the whole file
};

/// Writes faces [begin, end) of a run with the same material, group and smoothing group.
void put_faces(Bytes& bytes, const Mesh& mesh, Index begin, Index end, const Pool& uv, const Pool& normal,
               const Offsets& o) {
    append_text(bytes, end - begin, [&](std::size_t first, std::size_t last, std::string& out) {
        for (Index f = begin + static_cast<Index>(first); f < begin + last; ++f) {
            out += 'f';
            for (const Index w : mesh.face_wedges(f)) {
                out += ' ';
                put_number(out, o.vertex + mesh.vertex_of_wedge(w));
                if (uv.components == 0 && normal.components == 0) continue;
                out += '/';
                if (uv.components) put_number(out, o.uv + uv.of_wedge[w]);
                if (normal.components) {
                    out += '/';
                    put_number(out, o.normal + normal.of_wedge[w]);
                }
            }
            out += '\n';
        }
    });
}

/// Writes a statement before each face whose attribute value differs from the previous face's.
struct Switch {
    const Attribute* attribute = nullptr;
    double current = -1;
    bool differs(Index f) const { return attribute && attribute->value(f, 0) != current; }
};

class PartWriter {
  public:
    /// current: the material that the last usemtl selected.
    PartWriter(Bytes& bytes, const Mesh& mesh, const std::vector<std::string>& materials, Index& current)
        : bytes_(bytes), mesh_(mesh),
          materials_(materials), group_{number("group")}, smoothing_{number("smoothing_group")},
          material_(current) {
        if (material_ != none) material_ = of_other_part;
    }

    void faces(const Pool& uv, const Pool& normal, const Offsets& offsets) {
        const auto count = static_cast<Index>(mesh_.face_count());
        for (Index begin = 0, end = 0; begin < count; begin = end) {
            statements(begin);
            end = begin + 1;
            while (end < count && !changes(end)) ++end;
            put_faces(bytes_, mesh_, begin, end, uvs_ ? uv : Pool{}, normal, offsets);
        }
    }

    /// A line that starts at the end of the previous line extends the same statement.
    void lines(const Offsets& offsets) {
        std::string out;
        const auto put = [&](Index wedge) {
            out += ' ';
            put_number(out, offsets.vertex + mesh_.vertex_of_wedge(wedge));
        };
        for (std::size_t l = 0; l < mesh_.line_count(); ++l) {
            const Index p = mesh_.primitive_of_line(l);
            const bool goes_on =
                l > 0 && mesh_.lines[2 * l] == mesh_.lines[2 * l - 1] && p == mesh_.primitive_of_line(l - 1);
            if (!goes_on) {
                if (l > 0) out += '\n';
                out += use(p < mesh_.primitives.size() ? mesh_.primitives[p].material : none);
                out += 'l';
                put(mesh_.lines[2 * l]);
            }
            put(mesh_.lines[2 * l + 1]);
        }
        if (!out.empty()) append(bytes_, out + '\n');
    }

  private:
    /// The usemtl statement, if the material changes.
    std::string use(Index material) {
        if (material == material_) return {};
        material_ = material;
        return material == none ? "usemtl\n" : fmt::format("usemtl {}\n", materials_[material]);
    }
    const Attribute* number(std::string_view name) const {
        const Attribute* a = mesh_.find(name, Domain::face);
        return a && a->components == 1 ? a : nullptr;
    }
    Index material(Index f) const {
        return mesh_.primitives.empty() ? none : mesh_.primitives[mesh_.primitive_of(f)].material;
    }
    /// Whether the face's primitive has texture coordinates.
    bool has_uvs(Index f) const {
        return mesh_.primitives.empty() || mesh_.primitives[mesh_.primitive_of(f)].has("TEXCOORD_0");
    }
    bool changes(Index f) const {
        return material(f) != material_ || has_uvs(f) != uvs_ || group_.differs(f) || smoothing_.differs(f);
    }

    void statements(Index f) {
        uvs_ = has_uvs(f);
        if (group_.differs(f)) {
            group_.current = group_.attribute->value(f, 0);
            append(bytes_, fmt::format("g group_{}\n", group_.current));
        }
        if (smoothing_.differs(f)) {
            smoothing_.current = smoothing_.attribute->value(f, 0);
            append(bytes_, smoothing_.current > 0 ? fmt::format("s {}\n", smoothing_.current) : "s off\n");
        }
        append(bytes_, use(material(f)));
    }

    Bytes& bytes_;
    const Mesh& mesh_;
    const std::vector<std::string>& materials_;
    Switch group_, smoothing_;
    static constexpr Index of_other_part = none - 1;
    Index& material_;
    bool uvs_ = true;
};

/// Whether OBJ can hold the attribute.
bool has_place(const Attribute& a) {
    return a.domain == Domain::wedge && (a.name == "TEXCOORD_0" || a.name == "COLOR_0");
}

bool has_alpha(const Attribute& colour) {
    for (std::size_t i = 0; i < colour.size(); ++i)
        if (colour.value(i, 3) != 1) return true;
    return false;
}

/// Whether wedges of a vertex have different values.
bool has_seams(const Mesh& mesh, const Attribute& a) {
    if (!mesh.has_seams()) return false;
    std::vector<Index> first(mesh.vertex_count(), none);
    for (Index w = 0; w < mesh.wedge_count(); ++w) {
        Index& slot = first[mesh.vertex_of_wedge(w)];
        if (slot == none) slot = w;
        for (int c = 0; c < std::min(a.components, 3); ++c)
            if (a.value(w, c) != a.value(slot, c)) return true;
    }
    return false;
}

void warn_of_lost_attributes(const Scene& scene, Written& written) {
    OrderedSet<std::string> lost;
    for (const Part& part : scene.parts)
        for (const Attribute& a : part.mesh.attributes) {
            const bool colour = a.name == "COLOR_0" && a.domain == Domain::wedge;
            if (colour && a.components == 4 && has_alpha(a)) lost.add("alpha of COLOR_0");
            if (colour && has_seams(part.mesh, a)) lost.add("COLOR_0 that differs between faces at a vertex");
            if (is_missed(a) && !has_place(a)) lost.add(a.name);
        }
    warn_of_attributes(written, lost.all(), "OBJ");
}

void tell_what_is_lost(const Mesh& mesh, Written& written) {
    for (const auto& a : mesh.attributes) {
        const bool face = a.domain == Domain::face &&
                          (a.name == primitive_attribute || a.name == "group" || a.name == "smoothing_group");
        const bool wedge = mesh.face_count() > 0 && a.domain == Domain::wedge &&
                           (a.name == "NORMAL" || a.name == "TEXCOORD_0");
        const bool colour = a.domain == Domain::wedge && a.name == "COLOR_0";
        if (colour && a.components == 4)
            written.changes.push_back(
                {a.name, a.domain, AttributeChange::Kind::recomputed, "OBJ colours have no alpha"});
        if (!face && !wedge && !colour &&
            std::find_if(written.changes.begin(), written.changes.end(), [&](const AttributeChange& f) {
                return f.attribute == a.name && f.domain == a.domain;
            }) == written.changes.end())
            dropped(written, a, "OBJ cannot represent it");
    }
}

} // namespace

Written write(const Scene& scene, const WriteSettings& settings) {
    Written written;
    Bytes bytes;
    append(bytes, "# written by facetmill\n" + stated_comments(scene, "# ") + metadata_comments(scene, "# "));
    SceneLibrary library(scene, settings);
    if (const auto name = library.file_name()) append(bytes, fmt::format("mtllib {}\n", *name));
    Offsets offsets;
    Index material = none;
    ProgressSteps parts(std::vector<double>(scene.parts.size(), 1));
    for (const auto& part : scene.parts) {
        ProgressSteps steps({3, 1, 1, 4});
        const WorldMesh world(part);
        if (!settings.double_positions) require_floats(*world, fmt::format("part '{}'", part.name));
        const auto pool = [&](const char* name, int components) {
            const Attribute* a = world->face_count() > 0 ? world->find(name, Domain::wedge) : nullptr;
            return a && a->components == components ? pool_of(*a, components == 2) : Pool{};
        };
        const Pool uv = pool("TEXCOORD_0", 2), normal = pool("NORMAL", 3);
        // Without an object, a reader would make parts of the groups.
        const bool grouped = world->find("group", Domain::face) != nullptr;
        if (!part.name.empty() || grouped)
            append(bytes, fmt::format("o {}\n", one_line(part.name.empty() ? settings.title : part.name)));
        put_vertices(bytes, *world, settings.double_positions);
        steps.next();
        put_values(bytes, "vt", uv);
        steps.next();
        put_values(bytes, "vn", normal);
        steps.next();
        const ProgressScope silent(nullptr); // lines are written in pieces, by material
        PartWriter writer(bytes, *world, library.names(), material);
        writer.faces(uv, normal, offsets);
        writer.lines(offsets);
        offsets.vertex += static_cast<std::int64_t>(world->vertex_count());
        if (uv.components) offsets.uv += static_cast<std::int64_t>(uv.values.size() / uv.components);
        if (normal.components)
            offsets.normal += static_cast<std::int64_t>(normal.values.size() / normal.components);
        tell_what_is_lost(part.mesh, written);
        parts.next();
    }
    std::set<std::string> kept = kept_by_library();
    kept.insert("metadata");
    leave_documents(written, scene, "OBJ", kept);
    warn_of_point_materials(written, scene, "OBJ", false);
    written.files.push_back({settings.title + ".obj", std::move(bytes)});
    warn_of_lost_attributes(scene, written);
    warn_of_names(written, scene, "OBJ");
    library.add_to(written);
    return written;
}

} // namespace facetmill::io::obj
