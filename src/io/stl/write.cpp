#include "io/stl/stl.hpp"

#include "base/progress.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/attributes.hpp"
#include "io/flatten.hpp"
#include "io/stated.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <set>

namespace facetmill::io::stl {

namespace {

using Point = std::array<float, 3>;

Point rounded(const Vec3& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// The three corners of a triangle as written, and their normal (zero if degenerate).
struct Triangle {
    Point normal;
    std::array<Point, 3> corners;
};

Triangle triangle(const Mesh& mesh, Index f) {
    Triangle t;
    std::array<Vec3, 3> p;
    for (Index k = 0; k < 3; ++k) {
        t.corners[k] = rounded(mesh.point(3 * f + k));
        p[k] = {t.corners[k][0], t.corners[k][1], t.corners[k][2]};
    }
    const Vec3 n = normalised(cross(p[1] - p[0], p[2] - p[0]));
    t.normal = is_finite(n) ? rounded(n) : Point{0, 0, 0};
    return t;
}

/// Holds the mesh itself if all faces are triangles, otherwise its triangulation.
class Triangles {
  public:
    explicit Triangles(const Mesh& mesh) : given_(&mesh) {
        if (mesh.all_triangles()) return;
        own_ = triangles_of(mesh);
        given_ = &own_;
    }
    Triangles(const Triangles&) = delete;
    Triangles& operator=(const Triangles&) = delete;
    const Mesh& operator*() const { return *given_; }

  private:
    Mesh own_;
    const Mesh* given_;
};

void put_point(std::string& out, const Point& p) {
    for (const float x : p) {
        out += ' ';
        put_number(out, x);
    }
    out += '\n';
}

void write_text(Bytes& bytes, const Mesh& mesh, const std::string& name) {
    append(bytes, fmt::format("solid {}\n", name));
    append_text(bytes, mesh.face_count(), [&](std::size_t begin, std::size_t end, std::string& out) {
        for (auto f = static_cast<Index>(begin); f < end; ++f) {
            const Triangle t = triangle(mesh, f);
            out += "  facet normal";
            put_point(out, t.normal);
            out += "    outer loop\n";
            for (const Point& p : t.corners) {
                out += "      vertex";
                put_point(out, p);
            }
            out += "    endloop\n  endfacet\n";
        }
    });
    append(bytes, fmt::format("endsolid {}\n", name));
}

const std::vector<std::uint16_t>* attribute_bytes(const Mesh& mesh) {
    const Attribute* a = mesh.find(stl_attribute, Domain::face);
    return a && a->components == 1 ? std::get_if<std::vector<std::uint16_t>>(&a->data) : nullptr;
}

/// Colours of faces, which a binary file can hold, or null.
const Attribute* face_colours(const Mesh& mesh) {
    const Attribute* a = mesh.find("COLOR_0", Domain::face);
    return a && a->components >= 3 ? a : nullptr;
}

/// The attribute bytes of a face: its colour as VisCAM has it.
std::uint16_t viscam_bits(const Attribute& colours, std::size_t face) {
    unsigned bits = 1;
    for (int c = 0; c < 3; ++c)
        bits = bits << 5 | as_component<std::uint8_t>(std::clamp(colours.value(face, c), 0.0, 1.0) * 31);
    return static_cast<std::uint16_t>(bits);
}

void write_binary(Bytes& bytes, const Mesh& mesh, const Scene& scene) {
    const Attribute* const colours = face_colours(mesh);
    std::string title = "binary STL, written by facetmill" + stated_comments(scene, "; ", "");
    if (colours) title += fmt::format("; {}", viscam_words);
    bytes.resize(head + record * mesh.face_count());
    std::memcpy(bytes.data(), title.data(), title.size());
    const auto n = static_cast<std::uint32_t>(mesh.face_count());
    std::memcpy(bytes.data() + 80, &n, sizeof n);
    const auto* const extra = attribute_bytes(mesh);
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        const Triangle t = triangle(mesh, static_cast<Index>(f));
        std::byte* at = bytes.data() + head + record * f;
        std::memcpy(at, &t.normal, 12);
        std::memcpy(at + 12, &t.corners, 36);
        const std::uint16_t bits = colours ? viscam_bits(*colours, f) : extra ? (*extra)[f] : 0;
        std::memcpy(at + 48, &bits, sizeof bits);
    });
}

void tell_what_is_lost(const Scene& scene, const WriteSettings& settings, Written& written) {
    std::set<std::pair<std::string, Domain>> told;
    for (const auto& part : scene.parts) {
        for (const auto& a : part.mesh.attributes) {
            const Attribute* const colours = face_colours(part.mesh);
            const bool is_extra = !colours && a.name == stl_attribute && attribute_bytes(part.mesh);
            const bool kept = !settings.ascii && (&a == colours || is_extra);
            if (!kept && told.insert({a.name, a.domain}).second)
                dropped(written, a, "STL stores only positions, and in binary files also colours of faces");
        }
        if (!part.mesh.all_triangles() && told.insert({"polygons", Domain::face}).second)
            written.changes.push_back({"polygons", Domain::face, AttributeChange::Kind::recomputed,
                                       "cut into triangles, because STL stores only triangles"});
    }
    leave_documents(written, scene, "STL");
    warn_of_dropped(written, scene, "STL", false);
    drop_materials(written, scene, "STL", false);
    if (settings.ascii)
        warn_of_names(written, scene, "STL", false);
    else
        warn_of_parts(written, scene, "STL");
}

} // namespace

Written write(const Scene& scene, const WriteSettings& settings) {
    Written written;
    Bytes bytes;
    if (settings.ascii) {
        ProgressSteps steps(std::vector<double>(scene.parts.size(), 1));
        for (const auto& part : scene.parts) {
            const WorldMesh world(part);
            require_floats(*world, fmt::format("part '{}'", part.name));
            write_text(bytes, *Triangles(*world), one_line(part.name));
            steps.next();
        }
    } else {
        const WorldMesh world(scene);
        require_floats(*world, "the scene");
        write_binary(bytes, *Triangles(*world), scene);
    }
    tell_what_is_lost(scene, settings, written);
    written.files.push_back({settings.title + ".stl", std::move(bytes)});
    return written;
}

} // namespace facetmill::io::stl
