#include "geometry/cut/cap_paint.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// The index of the cap's primitive in the table; appends it if missing.
Index primitive_number(Mesh& mesh, const std::optional<Primitive>& wanted) {
    if (!wanted) return 0;
    if (mesh.primitives.empty()) mesh.primitives.push_back({});
    const auto at = std::find(mesh.primitives.begin(), mesh.primitives.end(), *wanted);
    if (at != mesh.primitives.end()) return static_cast<Index>(at - mesh.primitives.begin());
    mesh.primitives.push_back(*wanted);
    return static_cast<Index>(mesh.primitives.size() - 1);
}

/// The face attribute with this name; created if missing.
Attribute& numbers(Mesh& mesh, std::string_view name) {
    if (Attribute* a = mesh.find(name, Domain::face)) return *a;
    mesh.attributes.push_back({std::string(name), Domain::face, Role::index, 1, false,
                               std::vector<std::uint32_t>(mesh.face_count())});
    return mesh.attributes.back();
}

void paint_faces(Mesh& mesh, FaceRange faces, const CapPaint& paint) {
    for (Attribute& a : mesh.attributes)
        if (a.domain == Domain::face)
            for (std::size_t f = faces.first; f < faces.last; ++f)
                for (int c = 0; c < a.components; ++c) a.set_value(f, c, 0);
    const auto set = [&](std::string_view name, Index number) {
        if (number == 0) return;
        Attribute& a = numbers(mesh, name);
        for (std::size_t f = faces.first; f < faces.last; ++f) a.set_value(f, 0, number);
    };
    set(primitive_attribute, primitive_number(mesh, paint.primitive));
    set(cut_id_attribute, paint.cut_id);
    set(group_attribute, paint.group);
}

/// Orthonormal directions of a plane: across, up, and the normal.
struct Frame {
    Vec3 across, up, out;

    explicit Frame(const Vec3& normal) : out(normalised(normal)) {
        const double x = std::fabs(out.x), y = std::fabs(out.y), z = std::fabs(out.z);
        const Vec3 helper = z >= x && z >= y ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
        across = normalised(cross(helper, out));
        up = cross(out, across);
    }
};

void set(Attribute& a, Index element, std::initializer_list<double> values) {
    int c = 0;
    for (const double v : values)
        if (c < a.components) a.set_value(element, c++, v);
}

} // namespace

Index largest_number(const Mesh& mesh, std::string_view name) {
    const Attribute* a = mesh.find(name, Domain::face);
    if (!a) return 0;
    return parallel_reduce(
        mesh.face_count(), Index{0},
        [&](std::size_t begin, std::size_t end) {
            Index most = 0;
            for (std::size_t f = begin; f < end; ++f)
                most = std::max(most, as_component<std::uint32_t>(a->value(f, 0)));
            return most;
        },
        [](Index a, Index b) { return std::max(a, b); });
}

std::vector<std::uint8_t> later_caps(const Mesh& mesh, Index last) {
    const Attribute* cut = mesh.find(cut_id_attribute, Domain::face);
    const Attribute* group = mesh.find(group_attribute, Domain::face);
    if (!cut || !group || largest_number(mesh, cut_id_attribute) <= last) return {};
    std::vector<std::uint8_t> caps(mesh.face_count());
    bool any = false;
    for (std::size_t f = 0; f < caps.size(); ++f) {
        caps[f] = cut->value(f, 0) > last && group->value(f, 0) > 0;
        any |= caps[f] != 0;
    }
    if (!any) caps.clear();
    return caps;
}

bool caps_have_own_wedges(const Mesh& mesh) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(), [](const Attribute& a) {
        return a.domain == Domain::wedge &&
               (a.role == Role::normal || a.role == Role::tangent || a.role == Role::uv);
    });
}

Vec3 area_of_triangles(const Mesh& mesh, Index first_corner, Index last_corner) {
    Vec3 sum;
    for (Index c = first_corner; c < last_corner; c += 3)
        sum += cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c));
    return sum;
}

void paint_cap(Mesh& mesh, FaceRange faces, std::span<const Index> wedges, const Plane& plane,
               const CapPaint& paint) {
    paint_faces(mesh, faces, paint);
    if (wedges.empty()) return;
    // The user's normal may be tiny or huge; only its direction matters.
    const double largest =
        std::max({std::fabs(plane.normal.x), std::fabs(plane.normal.y), std::fabs(plane.normal.z)});
    const Frame frame(plane.normal / largest);
    Box box; // box of the coordinates in the plane
    const auto flat = [&](Index w) {
        const Vec3& p = mesh.positions[mesh.vertex_of_wedge(w)];
        return Vec3{dot(p, frame.across), dot(p, frame.up), 0};
    };
    for (const Index w : wedges) box.add(flat(w));
    const double extent = std::max(box.extent().x, box.extent().y), scale = extent > 0 ? 1 / extent : 0;
    for (Attribute& a : mesh.attributes) {
        if (a.domain != Domain::wedge) continue;
        for (const Index w : wedges) {
            const Vec3 at = (flat(w) - box.min) * scale;
            if (a.role == Role::normal) set(a, w, {frame.out.x, frame.out.y, frame.out.z});
            if (a.role == Role::tangent) set(a, w, {frame.across.x, frame.across.y, frame.across.z, 1});
            if (a.role == Role::uv && a.name == "TEXCOORD_0") set(a, w, {at.x, at.y});
        }
    }
}

} // namespace facetmill
