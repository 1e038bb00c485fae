#include "io/threemf/threemf.hpp"

#include "base/json.hpp"
#include "base/text/words.hpp"
#include "facetmill_version.hpp"
#include "geometry/render/render.hpp"
#include "geometry/render/srgb.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/attributes.hpp"
#include "io/flatten.hpp"
#include "io/images/png.hpp"
#include "io/metadata.hpp"
#include "io/srgb_colours.hpp"
#include "io/threemf/model.hpp"
#include "io/threemf/zip.hpp"
#include "mesh/equal_meshes.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::threemf {

namespace {

constexpr std::string_view content_types =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
 <Default Extension="png" ContentType="image/png"/>
</Types>
)";
constexpr std::string_view relations =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Id="rel0" Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
 <Relationship Id="rel1" Target="/Metadata/thumbnail.png" Type="http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail"/>
</Relationships>
)";

std::uint8_t byte_of(double fraction) { return as_component<std::uint8_t>(255 * fraction); }

std::string hex(const Colour& c) { return fmt::format("#{:02X}{:02X}{:02X}{:02X}", c[0], c[1], c[2], c[3]); }

std::uint32_t packed_colour(const Colour& c) {
    return std::uint32_t{c[0]} << 24 | std::uint32_t{c[1]} << 16 | std::uint32_t{c[2]} << 8 | c[3];
}

const char* unit_name(Unit unit) {
    for (const UnitName& known : unit_names)
        if (known.unit == unit) return known.name;
    if (unit == Unit::unknown) return "millimeter"; // the format's default unit; `write` has warned
    throw Error(ErrorKind::stage, "E-UNIT", fmt::format("3MF has no unit {}", to_string(unit)),
                "write: {unit: m}");
}

/// The properties of a mesh's triangles, as written.
class Looks {
  public:
    /// materials: maps the scene's material index to the index in the material group. id: the id of a colour
    /// group.
    Looks(const Mesh& mesh, const std::vector<Index>& materials, std::uint32_t materials_id, std::uint32_t id)
        : mesh_(mesh), materials_(materials), materials_id_(materials_id), id_(id) {
        const Attribute* a = mesh.find("COLOR_0", Domain::wedge);
        if (!a || (a->components != 3 && a->components != 4)) return;
        constexpr std::uint32_t white = UINT32_MAX;
        of_wedge_.resize(mesh.wedge_count());
        std::map<std::uint32_t, std::uint32_t> known;
        bool all_white = true;
        for (std::size_t w = 0; w < of_wedge_.size(); ++w) {
            Colour c{0, 0, 0, 255};
            for (int k = 0; k < a->components; ++k)
                c.at(static_cast<std::size_t>(k)) = byte_of(a->value(w, k));
            const auto [at, fresh] =
                known.emplace(packed_colour(c), static_cast<std::uint32_t>(colours_.size()));
            if (fresh) colours_.push_back(c);
            all_white &= at->first == white;
            of_wedge_[w] = at->second;
        }
        if (!all_white) return; // a mesh without colours is white, so its material counts
        colours_.clear();
        of_wedge_.clear();
    }

    const std::vector<Colour>& colours() const { return colours_; }
    /// Whether a face has a material that its colours hide.
    bool hides_materials() const {
        for (Index f = 0; !colours_.empty() && f < mesh_.face_count(); ++f)
            if (material(f) != none && has_colours(f)) return true;
        return false;
    }
    /// The properties of triangles that state none: the properties of the first face, if every face has
    /// properties.
    Properties usual() const {
        for (Index f = 0; f < mesh_.face_count(); ++f)
            if (of(f).group == none) return {};
        return of(0);
    }
    Properties of(Index f) const {
        Properties p;
        if (has_colours(f)) {
            p.group = id_;
            for (std::size_t k = 0; k < 3; ++k) p.index.at(k) = of_wedge_[mesh_.corners[3 * f + k]];
        } else if (material(f) != none) {
            p.group = materials_id_;
            p.index.fill(material(f));
        }
        return p;
    }

  private:
    const Primitive* primitive(Index f) const {
        return mesh_.primitives.empty() ? nullptr : &mesh_.primitives[mesh_.primitive_of(f)];
    }
    bool has_colours(Index f) const {
        const Primitive* p = primitive(f);
        return !colours_.empty() && (!p || p->has("COLOR_0"));
    }
    Index material(Index f) const {
        const Primitive* p = primitive(f);
        return p && p->material < materials_.size() ? materials_[p->material] : none;
    }

    const Mesh& mesh_;
    const std::vector<Index>& materials_;
    std::uint32_t materials_id_, id_;
    std::vector<Colour> colours_;
    std::vector<std::uint32_t> of_wedge_; ///< [wedges] -> colours_, or empty
};

class ModelWriter {
  public:
    ModelWriter(const Scene& scene, const WriteSettings& settings, Written& written)
        : scene_(scene), settings_(settings), written_(written) {}

    Bytes write() {
        append(out_,
               fmt::format(
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{}\" xml:lang=\"en-US\" "
                   "xmlns=\"{}\" xmlns:m=\"{}\">\n <metadata name=\"Application\">facetmill {}</metadata>\n"
                   "{} <resources>\n",
                   unit_name(scene_.unit), core_space, material_space, FACETMILL_VERSION, metadata()));
        put_materials();
        const auto first = DistinctParts(scene_).first;
        std::vector<Object> objects(scene_.parts.size()); // objects of the first of equal meshes
        std::string items;
        for (std::size_t i = 0; i < scene_.parts.size(); ++i) {
            const Part& part = scene_.parts[i];
            if (part.mesh.face_count() == 0) {
                warn("W-SKIPPED", fmt::format("part '{}' has no faces and is not written to 3MF", part.name));
                continue;
            }
            // 3MF forbids transforms that mirror or flatten, so such a part is written in world space.
            const bool placed = part.transform.determinant() > 0;
            Object object = placed ? objects[first[i]] : Object();
            if (object.id == 0)
                object = put_object(part, placed);
            else if (scene_.parts[first[i]].name != part.name)
                object.id = put_instance(part.name, object.id);
            if (placed && objects[first[i]].id == 0) objects[first[i]] = object;
            written_.dropped_faces += object.dropped_faces;
            items += fmt::format("  <item objectid=\"{}\"{}/>\n", object.id,
                                 placed ? placement(part.transform) : "");
        }
        append(out_, " </resources>\n <build>\n" + items + " </build>\n</model>\n");
        tell_what_is_lost();
        return std::move(out_);
    }

  private:
    struct Object {
        std::uint32_t id = 0;          ///< 0: not written yet
        std::size_t dropped_faces = 0; ///< degenerate faces left out, counted once for all instances
    };

    void warn(const char* id, std::string message) {
        written_.warnings.push_back({Severity::warning, id, std::move(message), {}, ""});
    }

    static bool is_kept_metadata(std::string_view name, const Json& value) {
        return value.is_string() && std::find(std::begin(metadata_names), std::end(metadata_names), name) !=
                                        std::end(metadata_names);
    }

    /// The copyright and the metadata that 3MF has names for.
    std::string metadata() const {
        std::map<std::string, std::string> found;
        for (const auto& [name, value] : metadata_of(scene_)) {
            const std::string own = name == "copyright" ? "Copyright" : name;
            if (is_kept_metadata(own, value)) found.emplace(own, value.get<std::string>());
        }
        std::string text;
        for (const auto& [name, value] : found)
            text += fmt::format(" <metadata name=\"{}\">{}</metadata>\n", name, xml_escaped(value));
        return text;
    }

    /// The part number of a mesh that a 3MF had; empty: none.
    static std::string part_number(const Mesh& mesh) {
        for (const Primitive& p : mesh.primitives) {
            if (p.json.find(part_number_key) == std::string::npos) continue;
            const Json json = parse_json(p.json, Broken::discarded);
            const Json::json_pointer place(fmt::format("/extras/{}", part_number_key));
            if (json.is_object() && json.contains(place) && json[place].is_string())
                return json[place].get<std::string>();
        }
        return {};
    }

    void put_materials() {
        index_of_.assign(scene_.materials.size(), none);
        std::string text;
        Index count = 0;
        for (const Part& part : scene_.parts)
            for (const Primitive& p : part.mesh.primitives) {
                if (p.material >= scene_.materials.size() || index_of_[p.material] != none) continue;
                index_of_[p.material] = count++;
                const Material& m = scene_.materials[p.material];
                Colour c{};
                for (std::size_t k = 0; k < 3; ++k) c.at(k) = srgb_of(static_cast<float>(m.base_colour[k]));
                c[3] = byte_of(m.base_colour[3]);
                text += fmt::format("   <base name=\"{}\" displaycolor=\"{}\"/>\n",
                                    m.name.empty() ? fmt::format("material {}", count) : xml_escaped(m.name),
                                    hex(c));
            }
        if (count == 0) return;
        materials_id_ = next_id_++;
        append(out_, fmt::format("  <basematerials id=\"{}\">\n{}  </basematerials>\n", materials_id_, text));
    }

    static std::string placement(const Transform& t) {
        if (t.identity()) return {};
        std::string text = " transform=\"";
        for (std::size_t k = 0; k < 12; ++k) {
            if (k > 0) text += ' ';
            put_number(text, t.m[k % 3][k / 3]);
        }
        return text + "\"";
    }

    Object put_object(const Part& part, bool placed) {
        const Mesh* mesh = &part.mesh;
        Mesh own;
        if (!placed) {
            own = *WorldMesh(part);
            mesh = &own;
        }
        if (has_colours_of_faces_only(*mesh)) {
            if (mesh != &own) own = *mesh;
            move_colours_to_wedges(own);
            mesh = &own;
        }
        if (!mesh->all_triangles()) {
            own = triangles_of(*mesh);
            mesh = &own;
            polygons_ = true;
        }
        if (!settings_.double_positions) require_floats(*mesh, fmt::format("part '{}'", part.name));
        const Looks looks(*mesh, index_of_, materials_id_, next_id_);
        if (!looks.colours().empty()) {
            std::string text;
            for (const Colour& c : looks.colours())
                text += fmt::format("   <m:color color=\"{}\"/>\n", hex(c));
            append(out_, fmt::format("  <m:colorgroup id=\"{}\">\n{}  </m:colorgroup>\n", next_id_++, text));
        }
        hides_materials_ |= looks.hides_materials();
        put_mesh(*mesh, looks, part.name);
        Object object{next_id_++};
        for (Index f = 0; f < mesh->face_count(); ++f) object.dropped_faces += is_degenerate(*mesh, f);
        return object;
    }

    /// Writes an instance of the object with another name.
    std::uint32_t put_instance(const std::string& name, std::uint32_t object) {
        append(out_,
               fmt::format("  <object id=\"{}\" type=\"model\" name=\"{}\">\n   <components>\n    <component "
                           "objectid=\"{}\"/>\n   </components>\n  </object>\n",
                           next_id_, xml_escaped(name), object));
        return next_id_++;
    }

    void put_mesh(const Mesh& mesh, const Looks& looks, const std::string& name) {
        const Properties usual = looks.usual();
        append(out_, fmt::format("  <object id=\"{}\" type=\"model\"", next_id_));
        if (!name.empty()) append(out_, fmt::format(" name=\"{}\"", xml_escaped(name)));
        if (const std::string number = part_number(mesh); !number.empty())
            append(out_, fmt::format(" partnumber=\"{}\"", xml_escaped(number)));
        if (usual.group != none)
            append(out_, fmt::format(" pid=\"{}\" pindex=\"{}\"", usual.group, usual.index[0]));
        append(out_, ">\n   <mesh>\n    <vertices>\n");
        append_text(out_, mesh.vertex_count(), [&](std::size_t begin, std::size_t end, std::string& out) {
            for (std::size_t v = begin; v < end; ++v) put_vertex(out, mesh.positions[v]);
        });
        append(out_, "    </vertices>\n    <triangles>\n");
        append_text(out_, mesh.face_count(), [&](std::size_t begin, std::size_t end, std::string& out) {
            for (auto f = static_cast<Index>(begin); f < end; ++f)
                if (!is_degenerate(mesh, f)) put_triangle(out, mesh, f, looks.of(f), usual);
        });
        append(out_, "    </triangles>\n   </mesh>\n  </object>\n");
    }

    void put_vertex(std::string& out, const Vec3& p) const {
        static constexpr const char* axes[] = {"     <vertex x=\"", "\" y=\"", "\" z=\""};
        for (std::size_t k = 0; k < 3; ++k) {
            out += axes[k];
            if (settings_.double_positions)
                put_number(out, p[k]);
            else
                put_number(out, static_cast<float>(p[k]));
        }
        out += "\"/>\n";
    }

    /// 3MF forbids triangles that use a vertex twice.
    static bool is_degenerate(const Mesh& mesh, Index f) {
        const Index a = mesh.vertex(3 * f), b = mesh.vertex(3 * f + 1), c = mesh.vertex(3 * f + 2);
        return a == b || b == c || c == a;
    }

    static void put_triangle(std::string& out, const Mesh& mesh, Index f, const Properties& p,
                             const Properties& usual) {
        static constexpr const char* corners[] = {"     <triangle v1=\"", "\" v2=\"", "\" v3=\""};
        static constexpr const char* indices[] = {"\" p1=\"", "\" p2=\"", "\" p3=\""};
        for (Index k = 0; k < 3; ++k) {
            out += corners[k];
            put_number(out, static_cast<std::int64_t>(mesh.vertex(3 * f + k)));
        }
        const bool one = p.index[0] == p.index[1] && p.index[0] == p.index[2];
        if (p.group != none && !(one && p.group == usual.group && p.index[0] == usual.index[0])) {
            out += "\" pid=\"";
            put_number(out, static_cast<std::int64_t>(p.group));
            for (std::size_t k = 0; k < (one ? 1 : 3); ++k) {
                out += indices[k];
                put_number(out, static_cast<std::int64_t>(p.index.at(k)));
            }
        }
        out += "\"/>\n";
    }

    void tell_what_is_lost() {
        std::set<std::pair<std::string, Domain>> told;
        for (const Part& part : scene_.parts)
            for (const Attribute& a : part.mesh.attributes) {
                const bool colour = a.name == "COLOR_0" &&
                                    (a.domain == Domain::wedge || has_colours_of_faces_only(part.mesh));
                const bool kept = a.name == primitive_attribute || colour;
                if (kept || !told.insert({a.name, a.domain}).second) continue;
                dropped(written_, a, "3MF cannot represent it");
            }
        warn_of_dropped(written_, scene_, "3MF");
        warn_of_names(written_, scene_, "3MF");
        if (polygons_)
            written_.changes.push_back({"polygons", Domain::face, AttributeChange::Kind::recomputed,
                                        "cut into triangles, because 3MF stores only triangles"});
        if (hides_materials_) {
            warn("W-MATERIAL", "triangles with colours have no material in 3MF");
            written_.changes.push_back({"materials", Domain::face, AttributeChange::Kind::dropped,
                                        "a triangle of 3MF has colours or a material, so triangles with "
                                        "colours lose their material"});
        }
        if (written_.dropped_faces > 0)
            warn("W-FACES", fmt::format("{} with the same vertex twice not written, since 3MF forbids them",
                                        counted(written_.dropped_faces, "face")));
        std::set<std::string> kept{"copyright", part_number_key};
        for (const auto& [name, value] : metadata_of(scene_))
            if (is_kept_metadata(name, value)) kept.insert(name);
        leave_documents(written_, scene_, "3MF", kept);
        warn_of_textures(written_, scene_, "3MF");
        warn_of_looks(written_, scene_, "3MF");
    }

    const Scene& scene_;
    const WriteSettings& settings_;
    Written& written_;
    Bytes out_;
    std::vector<Index> index_of_; ///< [materials] index in the material group
    std::uint32_t materials_id_ = 0, next_id_ = 1;
    bool polygons_ = false, hides_materials_ = false;
};

/// The picture that file managers and slicers show for the file.
Bytes thumbnail_of(Scene scene) {
    make_colours_linear(scene);
    PictureSettings settings;
    settings.width = settings.height = 256;
    settings.coarse_occlusion = true;
    settings.edges = EdgeLines::no;
    settings.ground = {1, 1, 1};
    return png(picture_of(scene, settings));
}

} // namespace

Written write(const Scene& scene, const WriteSettings& settings) {
    Written written;
    std::vector<ArchiveFile> files(4);
    files[0].path = "[Content_Types].xml";
    append(files[0].bytes, content_types);
    files[1].path = "_rels/.rels";
    append(files[1].bytes, relations);
    files[2].path = "3D/3dmodel.model";
    files[2].bytes = ModelWriter(scene, settings, written).write();
    files[3].path = "Metadata/thumbnail.png";
    files[3].bytes = thumbnail_of(scene);
    written.files.push_back({settings.title + ".3mf", make_archive(files)});
    return written;
}

} // namespace facetmill::io::threemf
