#include "base/ordered_set.hpp"
#include "base/text/words.hpp"
#include "io/attributes.hpp"
#include "io/encoding.hpp"
#include "io/flatten.hpp"
#include "io/images/image_files.hpp"
#include "io/obj/materials.hpp"
#include "io/srgb_colours.hpp"
#include "io/stated.hpp"
#include "io/text.hpp"
#include "io/write_options.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <span>

namespace facetmill::io::obj {

namespace {

/// Names in the order of their first face (or line), and the index of the name for every face.
struct Naming {
    std::vector<std::string> names;
    std::vector<Index> of_face;
    std::map<std::string, Index> known;
};

/// The current name at each of `count` elements, from the events of a kind. `before` is the name before the
/// first event.
Naming naming(const Statements& s, Event::Kind kind, const std::string& before, std::size_t count,
              std::size_t Event::*first) {
    Naming n;
    n.of_face.resize(count);
    const auto hold = [&](const std::string& name, std::size_t begin, std::size_t end) {
        if (begin >= end) return;
        const auto [at, fresh] = n.known.try_emplace(name, static_cast<Index>(n.names.size()));
        if (fresh) n.names.push_back(name);
        std::fill(n.of_face.begin() + static_cast<std::ptrdiff_t>(begin),
                  n.of_face.begin() + static_cast<std::ptrdiff_t>(end), at->second);
    };
    std::string current = before;
    std::size_t begin = 0;
    for (const auto& e : s.events) {
        if (e.kind != kind) continue;
        hold(current, begin, e.*first);
        current = e.text;
        begin = e.*first;
    }
    hold(current, begin, count);
    return n;
}

/// The names of the faces.
Naming naming(const Statements& s, Event::Kind kind, const std::string& before) {
    return naming(s, kind, before, s.faces(), &Event::face);
}

/// Divides colours by 255 if they count to that.
void scale_colours(std::vector<float>& colours) {
    float largest = 0;
    bool whole = true;
    for (const float c : colours) {
        if (std::isnan(c)) continue; // not given
        largest = std::max(largest, c);
        whole = whole && c == std::floor(c);
    }
    if (!count_to_255(largest, whole)) return;
    for (float& c : colours) c = c > 255 ? 1 : c / 255; // NaN stays
}

Attribute numbers(const char* name, std::vector<Index> values) {
    return {name, Domain::face, Role::index, 1, false, std::move(values)};
}

/// Vertex normals for wedges without a normal in the file: the area-weighted sum over adjacent faces.
void fill_normals(const Mesh& mesh, std::vector<float>& normals, const std::vector<bool>& given) {
    std::vector<Vec3> sums(given.size());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 area = area_vector(mesh, f);
        for (const Index w : mesh.face_wedges(f)) sums[w] += area;
    }
    for (std::size_t w = 0; w < given.size(); ++w) {
        if (given[w]) continue;
        Vec3 n = normalised(sums[w]);
        if (!is_finite(n) || n == Vec3{}) n = {0, 0, 1};
        for (std::size_t c = 0; c < 3; ++c) normals[3 * w + c] = static_cast<float>(n[c]);
    }
}

/// Wedges and their attributes from the keys of the corners.
void add_wedges(Mesh& mesh, Statements& s) {
    std::vector<std::uint64_t> keys(mesh.positions.size(), no_key);
    if (!s.corner_keys.empty()) {
        Wedges wedges = make_wedges(mesh.positions.size(), std::move(mesh.corners), s.corner_keys);
        mesh.corners = std::move(wedges.corners);
        mesh.wedge_vertex = std::move(wedges.wedge_vertex);
        keys = std::move(wedges.keys);
    }
    std::vector<float> uv(2 * keys.size(), 0.0F), normal(3 * keys.size(), 0.0F);
    std::vector<bool> has_normal(keys.size(), false);
    bool uvs = false, normals = false;
    for (std::size_t w = 0; w < keys.size(); ++w) {
        const auto t = static_cast<Index>(keys[w] >> 32), n = static_cast<Index>(keys[w]);
        if (t != none) {
            uvs = true;
            uv[2 * w] = s.uvs[2 * std::size_t{t}];
            uv[2 * w + 1] = 1 - s.uvs[2 * std::size_t{t} + 1]; // glTF's v starts at the top
        }
        if (n != none) {
            normals = has_normal[w] = true;
            std::copy_n(&s.normals[3 * std::size_t{n}], 3, &normal[3 * w]);
        }
    }
    if (normals) {
        fill_normals(mesh, normal, has_normal);
        add_attribute(mesh, {"NORMAL", Domain::wedge, Role::normal, 3, false, std::move(normal)});
    }
    if (uvs) add_attribute(mesh, {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uv)});
    if (s.colours.empty()) return;
    Attribute colour{"COLOR_0", Domain::wedge, Role::colour, 3, false, std::move(s.colours)};
    if (mesh.has_seams()) extend_to_wedges(colour, mesh.wedge_vertex, mesh.vertex_count());
    add_attribute(mesh, std::move(colour));
}

/// Whether each face has texture coordinates; empty if all faces agree.
std::vector<bool> faces_with_uvs(const Statements& s) {
    std::vector<bool> with(s.faces());
    std::size_t count = 0;
    for (std::size_t f = 0; f < with.size() && !s.corner_keys.empty(); ++f) {
        for (Index c = s.face_offsets[f]; c < s.face_offsets[f + 1]; ++c)
            if (static_cast<Index>(s.corner_keys[c] >> 32) != none) with[f] = true;
        count += with[f];
    }
    return count == 0 || count == with.size() ? std::vector<bool>{} : with;
}

/// The wedge attributes of a primitive with or without texture coordinates.
std::vector<std::string> attributes_of(const Mesh& mesh, bool with_uvs) {
    std::vector<std::string> names{"POSITION"}; // an empty list would mean all attributes
    for (const Attribute& a : mesh.attributes)
        if (a.domain == Domain::wedge && (with_uvs || a.name != "TEXCOORD_0")) names.push_back(a.name);
    return names;
}

const std::string no_material; ///< usemtl without a name means the same, unless a material has no name

bool has_names(const Naming& materials) {
    return !materials.names.empty() && materials.names != std::vector{no_material};
}

/// Reads the libraries only if the file uses materials. A material without a name gets one that no file can
/// have, in the statements too.
MaterialMaker maker_of_materials(Statements& s, const Input& input, ReadLog& log) {
    const auto is_use = [](const Event& e) { return e.kind == Event::Kind::material; };
    std::map<std::string, Description> known;
    if (std::any_of(s.events.begin(), s.events.end(), is_use)) known = read_libraries(input, s.events, log);
    if (auto unnamed = known.extract(no_material)) {
        unnamed.key() = "\n";
        unnamed.mapped().name = "";
        for (Event& e : s.events)
            if (is_use(e) && e.text.empty()) e.text = unnamed.key();
        known.insert(std::move(unnamed));
    }
    return {input, std::move(known), log};
}

/// Makes the scene's materials and the mesh's primitives from usemtl. Faces without texture coordinates get
/// separate primitives without TEXCOORD_0 and without textures.
void add_materials(Scene& scene, Mesh& mesh, const Statements& s, MaterialMaker& maker) {
    const Naming used = naming(s, Event::Kind::material, no_material);
    const std::vector<bool> with_uvs = faces_with_uvs(s);
    const bool uvs = mesh.find("TEXCOORD_0", Domain::wedge) != nullptr;
    if (!has_names(used) && with_uvs.empty()) return;
    std::vector<Index> primitive_of(2 * used.names.size(),
                                    none); // two per name: without and with texture coordinates
    std::vector<Index> of_face(s.faces());
    for (std::size_t f = 0; f < of_face.size(); ++f) {
        const bool with = with_uvs.empty() ? uvs : with_uvs[f];
        Index& known = primitive_of[2 * std::size_t{used.of_face[f]} + with];
        const bool fresh = known == none;
        if (fresh) known = static_cast<Index>(mesh.primitives.size());
        of_face[f] = known;
        if (!fresh) continue;
        Primitive primitive;
        const std::string& name = used.names[used.of_face[f]];
        if (!name.empty()) primitive.material = maker.index_of(name, with, scene.materials);
        if (!with_uvs.empty()) primitive.attributes = attributes_of(mesh, with);
        mesh.primitives.push_back(std::move(primitive));
    }
    if (mesh.primitives.size() > 1)
        mesh.attributes.push_back(numbers(std::string(primitive_attribute).c_str(), std::move(of_face)));
}

/// numbered: number the groups, because they do not become parts.
void add_groups(Mesh& mesh, const Statements& s, bool numbered, const std::string& file, ReadLog& log) {
    Naming groups = naming(s, Event::Kind::group, "");
    if (numbered && groups.names.size() > 1) {
        log.warnings.push_back(
            {Severity::note, "W-GROUPS",
             fmt::format("the names of {} groups are not kept; face attribute 'group' numbers them",
                         groups.names.size()),
             file_mark(file), ""});
        mesh.attributes.push_back(numbers("group", std::move(groups.of_face)));
    }
    const Naming smoothing = naming(s, Event::Kind::smoothing, "off");
    if (smoothing.names.size() < 2) return;
    std::vector<Index> of_face(smoothing.of_face.size());
    for (std::size_t f = 0; f < of_face.size(); ++f) {
        const std::string& name = smoothing.names[smoothing.of_face[f]];
        const char* at = name.data();
        std::int64_t number = 0;
        if (scan_integer(at, name.data() + name.size(), number) && number > 0 && number < none)
            of_face[f] = static_cast<Index>(number);
    }
    mesh.attributes.push_back(numbers("smoothing_group", std::move(of_face)));
}

/// Assigns each vertex (or wedge) to the first object that uses it. Copies for other objects are appended.
class Owned {
  public:
    explicit Owned(std::size_t count) : owner_(count, none), source_(count) {
        std::iota(source_.begin(), source_.end(), Index{0});
    }
    Index of(Index element, Index object) {
        if (owner_[element] == none) owner_[element] = object;
        if (owner_[element] == object) return element;
        const auto [at, fresh] = copies_.try_emplace({element, object}, static_cast<Index>(source_.size()));
        if (fresh) source_.push_back(element);
        return at->second;
    }
    /// [elements and copies] The original element.
    const std::vector<Index>& source() const { return source_; }
    std::size_t copies() const { return copies_.size(); }

  private:
    std::vector<Index> owner_, source_;
    std::map<std::pair<Index, Index>, Index> copies_;
};

/// Gives each object vertices and wedges of its own. Returns the number of vertices that were copied.
std::size_t copy_shared(Mesh& mesh, const std::vector<Index>& object_of_face) {
    Owned vertices(mesh.vertex_count()), wedges(mesh.wedge_count());
    const bool seams = mesh.has_seams();
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            Index& w = mesh.corners[c];
            const Index v = vertices.of(vertices.source()[mesh.vertex_of_wedge(w)], object_of_face[f]);
            w = wedges.of(w, object_of_face[f]);
            if (!seams) continue; // each wedge is its vertex, before and after
            if (w == mesh.wedge_vertex.size()) mesh.wedge_vertex.push_back(v);
            mesh.wedge_vertex[w] = v;
        }
    if (vertices.copies() == 0) return 0; // a shared wedge has a shared vertex
    for (Attribute& a : mesh.attributes)
        if (a.domain != Domain::face)
            a = selected(a, a.domain == Domain::wedge ? wedges.source() : vertices.source());
    const std::size_t before = mesh.vertex_count();
    mesh.positions.reserve(vertices.source().size());
    for (const Index v : std::span(vertices.source()).subspan(before))
        mesh.positions.push_back(mesh.positions[v]);
    return vertices.copies();
}

/// The object (or group) of each vertex: the object of its faces, or the object at its declaration if it has
/// no faces. Empty if two groups share a vertex.
std::vector<Index> object_of_vertices(const Mesh& mesh, const Naming& objects, Event::Kind kind,
                                      const Statements& s) {
    std::vector<Index> object(mesh.vertex_count(), none);
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (const Index w : mesh.face_wedges(f)) {
            Index& at = object[mesh.vertex_of_wedge(w)];
            if (at != none && at != objects.of_face[f]) return {};
            at = objects.of_face[f];
        }
    Index current = 0;
    auto next = s.events.begin();
    for (std::size_t v = 0; v < object.size(); ++v) {
        for (; next != s.events.end() && next->vertex <= v; ++next) {
            if (next->kind != kind) continue;
            if (const auto at = objects.known.find(next->text); at != objects.known.end())
                current = at->second;
        }
        if (object[v] == none) object[v] = current;
    }
    return object;
}

/// The elements of each object, ascending, and the index of each element in its object.
struct Shares {
    std::vector<Index> offsets, items, place;
    Shares(const std::vector<Index>& object_of, std::size_t objects)
        : offsets(objects + 1), items(object_of.size()), place(object_of.size()) {
        for (const Index o : object_of) ++offsets[o];
        exclusive_scan(offsets);
        std::vector<Index> next(offsets);
        for (Index i = 0; i < object_of.size(); ++i) {
            place[i] = next[object_of[i]] - offsets[object_of[i]];
            items[next[object_of[i]]++] = i;
        }
    }
    std::span<const Index> of(Index object) const {
        return {items.data() + offsets[object], items.data() + offsets[object + 1]};
    }
};

/// The object as a separate mesh.
Mesh extract(const Mesh& mesh, const Shares& vertices, const Shares& wedges, const Shares& faces,
             Index object) {
    Mesh own;
    for (const Index v : vertices.of(object)) own.positions.push_back(mesh.positions[v]);
    if (mesh.has_seams()) {
        for (const Index w : wedges.of(object))
            own.wedge_vertex.push_back(vertices.place[mesh.vertex_of_wedge(w)]);
        normalise_wedges(own);
    }
    if (!mesh.all_triangles()) own.face_offsets.push_back(0);
    for (const Index f : faces.of(object)) {
        for (const Index w : mesh.face_wedges(f)) own.corners.push_back(wedges.place[w]);
        if (!mesh.all_triangles()) own.face_offsets.push_back(static_cast<Index>(own.corners.size()));
    }
    normalise_offsets(own);
    for (const Attribute& a : mesh.attributes) {
        const Shares& shares = a.domain == Domain::face    ? faces
                               : a.domain == Domain::wedge ? wedges
                                                           : vertices;
        own.attributes.push_back(selected(a, shares.of(object)));
    }
    own.primitives = mesh.primitives;
    return own;
}

/// Removes texture coordinates that no primitive has, and attribute lists without information.
void drop_unlisted(Mesh& mesh) {
    const auto with = std::count_if(mesh.primitives.begin(), mesh.primitives.end(),
                                    [](const Primitive& p) { return p.has("TEXCOORD_0"); });
    if (with == 0) mesh.drop("TEXCOORD_0", Domain::wedge);
    if (with == 0 || with == static_cast<std::ptrdiff_t>(mesh.primitives.size()))
        for (Primitive& p : mesh.primitives) p.attributes.clear();
}

/// Removes unused primitives; a single remaining primitive needs no face attribute.
void compact_primitives(Mesh& mesh) {
    Attribute* a = mesh.find(primitive_attribute, Domain::face);
    if (!a) return;
    auto& of_face = std::get<std::vector<std::uint32_t>>(a->data);
    std::vector<Index> place(mesh.primitives.size(), none);
    std::vector<Primitive> used;
    for (Index& p : of_face) {
        if (place[p] == none) {
            place[p] = static_cast<Index>(used.size());
            used.push_back(mesh.primitives[p]);
        }
        p = place[p];
    }
    mesh.primitives = std::move(used);
    drop_unlisted(mesh);
    if (mesh.primitives.size() < 2) mesh.drop(primitive_attribute, Domain::face);
}

/// The division into parts: by objects, or by groups in a file without objects.
struct Division {
    Naming names;
    std::vector<Index> of_vertex; ///< empty if groups share vertices and stay a single part
    Event::Kind kind = Event::Kind::object;
    bool divides() const { return !of_vertex.empty(); }
};

Division divide(Mesh& mesh, const Statements& s, const std::string& file, ReadLog& log) {
    Division d;
    d.names = naming(s, d.kind, "");
    if (d.names.names == std::vector<std::string>{""}) {
        d.kind = Event::Kind::group;
        d.names = naming(s, d.kind, "");
    } else if (const std::size_t copies = copy_shared(mesh, d.names.of_face); copies > 0) {
        log.warnings.push_back({Severity::note, "W-OBJECTS",
                                fmt::format("objects share vertices, so {} were copied to make each object a "
                                            "part; merge joins the parts again",
                                            copies),
                                file_mark(file), ""});
    }
    if (d.names.names.size() > 1) d.of_vertex = object_of_vertices(mesh, d.names, d.kind, s);
    return d;
}

void add_each(Scene& scene, const Mesh& mesh, const Division& d) {
    std::vector<Index> of_wedge(mesh.wedge_count());
    for (Index w = 0; w < mesh.wedge_count(); ++w) of_wedge[w] = d.of_vertex[mesh.vertex_of_wedge(w)];
    const std::size_t count = d.names.names.size();
    const Shares vertices(d.of_vertex, count), wedges(of_wedge, count), faces(d.names.of_face, count);
    for (Index n = 0; n < count; ++n) {
        Part& part = scene.parts.emplace_back();
        part.name = d.names.names[n];
        part.mesh = extract(mesh, vertices, wedges, faces, n);
        compact_primitives(part.mesh);
    }
}

void add_parts(Scene& scene, Mesh mesh, const Division& division) {
    if (division.divides()) return add_each(scene, mesh, division);
    const auto& names = division.names.names;
    Part& part = scene.parts.emplace_back();
    if (names.size() == 1) part.name = names[0];
    part.mesh = std::move(mesh);
}

void report_skipped(const Statements& s, const std::string& file, ReadLog& log) {
    const auto warn = [&](const char* id, std::string message) {
        log.warnings.push_back({Severity::warning, id, std::move(message), file_mark(file), ""});
    };
    std::vector<std::string> words;
    for (const auto& [word, count] : s.skipped) {
        if (word == "p" && s.faces() == 0) continue; // a point cloud keeps all vertices
        words.push_back(fmt::format("{} ({})", in_quotes(word), count));
    }
    if (!words.empty())
        warn("W-SKIPPED",
             fmt::format("statements that cannot be kept are skipped: {}", fmt::join(words, ", ")));
    if (s.dangling > 0)
        warn("W-INDEX",
             fmt::format("{} corners refer to a texture point or normal that the file does not have",
                         s.dangling));
    if (s.short_faces > 0)
        warn("W-FACES", counted(s.short_faces, "face") + " of fewer than three corners skipped");
}

/// Collects the lines of an object, and the vertices that they use.
class LinesOfObject {
  public:
    /// place: a scratch array by vertex, all `none` before and after.
    LinesOfObject(const Mesh& all, std::vector<Index>& place) : all_(all), place_(place) {}

    void add(std::span<const Index> points, Index material) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            mesh_.lines.push_back(end(points[i]));
            mesh_.lines.push_back(end(points[i + 1]));
            mesh_.line_primitive.push_back(primitive(material));
        }
    }

    Mesh finish() {
        if (const Attribute* colours =
                all_.find("COLOR_0", Domain::wedge)) // a vertex takes the colour of its first wedge
            mesh_.attributes.push_back(selected(*colours, taken_));
        for (const Index v : taken_) place_[v] = none;
        if (mesh_.primitives.size() == 1) mesh_.line_primitive.clear();
        if (mesh_.primitives.size() == 1 && mesh_.primitives[0].material == none) mesh_.primitives.clear();
        return std::move(mesh_);
    }

  private:
    Index end(Index vertex) {
        if (place_[vertex] == none) {
            place_[vertex] = static_cast<Index>(taken_.size());
            taken_.push_back(vertex);
            mesh_.positions.push_back(all_.positions[vertex]);
        }
        return place_[vertex];
    }
    Index primitive(Index material) {
        const auto [at, fresh] =
            primitives_.try_emplace(material, static_cast<Index>(mesh_.primitives.size()));
        if (fresh) mesh_.primitives.push_back({material, {}, {}});
        return at->second;
    }

    const Mesh& all_;
    std::vector<Index>& place_;
    std::vector<Index> taken_;
    std::map<Index, Index> primitives_; ///< by material
    Mesh mesh_;
};

/// A part for the lines of each object.
std::vector<Part> parts_of_lines(Scene& scene, const Statements& s, const Mesh& mesh, MaterialMaker& maker) {
    const Naming objects = naming(s, Event::Kind::object, "", s.lines(), &Event::line),
                 used = naming(s, Event::Kind::material, no_material, s.lines(), &Event::line);
    std::vector<Index> material;
    for (const auto& name : used.names)
        material.push_back(name.empty() ? none : maker.index_of(name, false, scene.materials));
    const Shares by_object(objects.of_face, objects.names.size());
    std::vector<Index> place(mesh.vertex_count(), none);
    std::vector<Part> parts;
    for (Index object = 0; object < objects.names.size(); ++object) {
        LinesOfObject lines(mesh, place);
        for (const Index l : by_object.of(object))
            lines.add(
                {s.line_points.data() + s.line_offsets[l], s.line_points.data() + s.line_offsets[l + 1]},
                material[used.of_face[l]]);
        Part part;
        part.name = objects.names[object];
        part.mesh = lines.finish();
        if (part.mesh.line_count() > 0) parts.push_back(std::move(part));
    }
    return parts;
}

/// Vertices without a colour become white in a part with other colours; a part without any colours gets
/// none.
void settle_colours(Mesh& mesh) {
    Attribute* const colours = mesh.find("COLOR_0", Domain::wedge);
    if (!colours) return;
    auto& values = std::get<std::vector<float>>(colours->data);
    const auto is_given = [](float value) { return !std::isnan(value); };
    if (std::any_of(values.begin(), values.end(), is_given)) {
        for (float& value : values)
            if (!is_given(value)) value = 1;
        return;
    }
    mesh.drop("COLOR_0", Domain::wedge);
    for (Primitive& primitive : mesh.primitives) std::erase(primitive.attributes, "COLOR_0");
}

constexpr std::string_view ends_of_lines = "line"; ///< a temporary vertex attribute

Attribute marked_ends(const Statements& s) {
    std::vector<std::uint8_t> marked(s.positions.size());
    for (std::size_t l = 0; l < s.lines(); ++l)
        for (Index i = s.line_offsets[l];
             s.line_offsets[l + 1] - s.line_offsets[l] > 1 && i < s.line_offsets[l + 1]; ++i)
            marked[s.line_points[i]] = 1;
    return {std::string(ends_of_lines), Domain::vertex, Role::generic, 1, false, std::move(marked)};
}

/// The number of line groups that are lost. It is nonzero if an object has lines in several groups, because
/// lines become one part per object.
std::size_t lost_groups_of_lines(const Statements& s) {
    const Naming objects = naming(s, Event::Kind::object, "", s.lines(), &Event::line);
    const Naming groups = naming(s, Event::Kind::group, "", s.lines(), &Event::line);
    std::vector<Index> last_of(objects.names.size(), none); // the last group of each object
    bool any = false;
    for (std::size_t l = 0; l < s.lines(); ++l) {
        const Index group = groups.of_face[l];
        Index& last = last_of[objects.of_face[l]];
        any |= last != none && last != group;
        last = group;
    }
    const auto unnamed = std::count(groups.names.begin(), groups.names.end(), "");
    return any ? groups.names.size() - static_cast<std::size_t>(unnamed) : 0;
}

/// Removes vertices that only lines use from the surface parts, and parts that become empty.
void drop_ends(Scene& scene) {
    for (Part& part : scene.parts) {
        const auto marked =
            std::get<std::vector<std::uint8_t>>(part.mesh.find(ends_of_lines, Domain::vertex)->data);
        part.mesh.drop(ends_of_lines, Domain::vertex);
        drop_unused(part.mesh, marked);
    }
    std::erase_if(scene.parts, [](const Part& part) { return part.mesh.vertex_count() == 0; });
}

} // namespace

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    Statements s = parse(input, settings);
    scale_colours(s.colours);
    if (const std::size_t groups = lost_groups_of_lines(s); groups > 0) s.skipped["groups of l"] = groups;
    report_skipped(s, input.name(), log);
    Scene scene;
    take_stated(scene, stated_in_lines(as_text(input.bytes())), input.name(), settings, log);
    Mesh mesh;
    const bool any_lines = s.lines() > 0;
    if (any_lines) mesh.attributes.push_back(marked_ends(s));
    mesh.positions = std::move(s.positions);
    mesh.corners = std::move(s.corners);
    mesh.face_offsets = s.face_offsets;
    add_wedges(mesh, s);
    normalise_offsets(mesh);
    MaterialMaker maker = maker_of_materials(s, input, log);
    add_materials(scene, mesh, s, maker);
    std::vector<Part> lines;
    if (any_lines) lines = parts_of_lines(scene, s, mesh, maker);
    maker.finish(scene);
    const Division division = divide(mesh, s, input.name(), log);
    add_groups(mesh, s, !(division.divides() && division.kind == Event::Kind::group), input.name(), log);
    add_parts(scene, std::move(mesh), division);
    if (any_lines) drop_ends(scene);
    for (Part& part : lines) scene.parts.push_back(std::move(part));
    for (Part& part : scene.parts) settle_colours(part.mesh);
    return scene;
}

namespace {

/// At most "perhaps", because OBJ has no magic number. The first statement decides.
int sniff(Span bytes) {
    static const std::string nameless;
    Text text(as_text(bytes.first(std::min<std::size_t>(bytes.size(), 65536))), nameless, "E-OBJ", '#');
    const std::string_view word = text.word();
    for (const std::string_view known : {"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"})
        if (word == known) return 1;
    return 0;
}

/// Adds all images that libraries name, even if unused or missing.
void add_images(const Input& input, const std::vector<Event>& libraries, FileHeader& header) {
    ReadLog ignored; // reading the file repeats these warnings
    OrderedSet<std::filesystem::path> images;
    for (const auto& [name, description] : read_libraries(input, libraries, ignored))
        for (const auto& [word, map] : description.maps)
            if (const auto path = map.relative.empty() ? std::nullopt : path_below(input, map.relative))
                images.add(*path);
    header.files.insert(header.files.end(), images.all().begin(), images.all().end());
}

/// Materials that faces use, each with or without texture coordinates.
using UsedMaterials = std::vector<std::pair<std::string, bool>>;

bool has_texture_point(std::string_view corner) {
    const auto slash = corner.find('/');
    return slash != corner.npos && slash + 1 < corner.size() && corner[slash + 1] != '/';
}

/// Calls take(statement, rest of the line) for usemtl and face lines while it returns true.
template <class Take>
void for_each_use(std::string_view text, Take&& take) {
    constexpr std::string_view blanks = " \t\r";
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        at = end + 1;
        line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
        const std::string_view word = line.substr(0, line.find_first_of(blanks));
        if (word != "usemtl" && word != "f" && word != "fo") continue;
        line.remove_prefix(std::min(line.find_first_not_of(blanks, word.size()), line.size()));
        if (!take(word, line.substr(0, line.find_last_not_of(blanks) + 1))) return;
    }
}

UsedMaterials used_materials(const Input& input) {
    OrderedSet<std::pair<std::string, bool>> used;
    std::string name;
    bool seen[2] = {true, true};
    for_each_use(as_text(input.bytes()), [&](std::string_view word, std::string_view rest) {
        if (word == "usemtl") {
            name = rest;
            seen[0] = seen[1] = name.empty();
        } else if (!(seen[0] && seen[1])) {
            const bool with = has_texture_point(rest.substr(0, rest.find_first_of(" \t")));
            if (!std::exchange(seen[with], true)) used.add({name, with});
        }
        return true;
    });
    return used.all();
}

bool uses_materials(const std::filesystem::path& path) {
    bool found = false;
    const Input input = in_utf8(Input::open(path));
    for_each_use(as_text(input.bytes()), [&](std::string_view word, std::string_view rest) {
        found = word == "usemtl" && !rest.empty();
        return !found;
    });
    return found;
}

std::vector<NamedImage> images_of(const std::filesystem::path& path,
                                  const std::vector<std::filesystem::path>& asset_roots,
                                  const std::vector<Event>& libraries) {
    const Input input = in_utf8(Input::open(path).with_asset_roots(asset_roots));
    ReadLog ignored; // reading the file repeats these warnings
    MaterialMaker maker(input, read_libraries(input, libraries, ignored), ignored, true);
    std::vector<Material> materials;
    for (const auto& [name, textured] : used_materials(input)) maker.index_of(name, textured, materials);
    return maker.images();
}

/// Reads only the libraries, which files name near the beginning. Finding the parts needs the whole file.
void peek(const Input& input, FileHeader& header) {
    take_stated(header, stated_in_lines(as_text(input.bytes())));
    std::vector<Event> libraries;
    Text text(as_text(input.bytes().first(std::min<std::size_t>(input.bytes().size(), 1 << 20))),
              input.name(), "E-OBJ", '#');
    do {
        const std::string_view word = text.word_on_line();
        if (word != "mtllib") continue;
        for (const std::string& name : library_names(input, std::string(text.rest_of_line()))) {
            const auto relative = input.path().empty() ? std::nullopt : relative_path_of(name);
            const auto path = relative ? path_below(input, *relative) : std::nullopt;
            if (!path) continue;
            header.files.push_back(*path);
            libraries.push_back({.kind = Event::Kind::library, .text = name});
        }
    } while (text.next_line());
    add_images(input, libraries, header);
    if (input.path().empty()) return;
    header.has_materials = [path = input.path()] { return uses_materials(path); };
    if (!libraries.empty())
        header.images = [path = input.path(), roots = input.asset_roots(), libraries] {
            return images_of(path, roots, libraries);
        };
}

const RegisterCodec codec({
    .name = "obj",
    .about = "Wavefront object, with its materials and their textures; texture points and normals by corner",
    .extensions = {"obj"},
    .can = {.polygons = true,
            .points = true,
            .points_and_faces = true,
            .lines = true,
            .full_precision = true,
            .options = {textures_option()},
            .attributes =
                "texture points and normals by corner, colours of vertices, materials with textures",
            .library = ".mtl",
            .copies_images = true},
    .sniff = sniff,
    .read = with_linear_colours(read),
    .write = with_srgb_colours(write),
    .peek = peek,
});
} // namespace

} // namespace facetmill::io::obj
