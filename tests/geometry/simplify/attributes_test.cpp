// Attributes in the error of simplification.

#include "geometry/simplify/simplify.hpp"

#include "geometry/spatial/closest_point.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using Method = SimplifySettings::Method;

namespace {

void add(Mesh& m, const char* name, Role role, int components,
         const std::function<void(const Vec3&, double*)>& at) {
    Attribute a;
    a.name = name;
    a.role = role;
    a.components = components;
    std::vector<double> data(static_cast<std::size_t>(components) * m.wedge_count());
    for (Index w = 0; w < m.wedge_count(); ++w)
        at(m.positions[m.vertex_of_wedge(w)], &data[static_cast<std::size_t>(components) * w]);
    a.data = std::move(data);
    m.attributes.push_back(std::move(a));
}

/// The root mean square error of an attribute on the simplified flat sheet, compared with the original at
/// the same position.
double off(const Mesh& given, const Mesh& now, const char* name) {
    const Surface surface = surface_of(given);
    const FaceTree tree(surface);
    const Attribute *was = given.find(name, Domain::wedge), *is = now.find(name, Domain::wedge);
    double sum = 0;
    std::size_t samples = 0;
    for (Index f = 0; f < now.face_count(); ++f) {
        const Vec3 &a = now.point(3 * f), &b = now.point(3 * f + 1), &c = now.point(3 * f + 2);
        const double area = length(cross(b - a, c - a));
        const int n = 1 + static_cast<int>(std::sqrt(area) * 8);
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) { // places within the face
                const double u = (i + 1.0 / 3) / n, v = (j + 1.0 / 3) / n, w = 1 - u - v;
                const Closest found = closest_point(tree, a * u + b * v + c * w);
                const Index t = found.face;
                const Vec3 &x = given.point(3 * t), &y = given.point(3 * t + 1), &z = given.point(3 * t + 2);
                const Vec3 normal = cross(y - x, z - x);
                const double nn = dot(normal, normal);
                const double s = dot(cross(found.point - x, z - x), normal) / nn,
                             r = dot(cross(y - x, found.point - x), normal) / nn;
                for (int k = 0; k < is->components; ++k) {
                    const double now_is = is->value(now.corners[3 * f], k) * u +
                                          is->value(now.corners[3 * f + 1], k) * v +
                                          is->value(now.corners[3 * f + 2], k) * w;
                    const double it_was = was->value(given.corners[3 * t], k) * (1 - s - r) +
                                          was->value(given.corners[3 * t + 1], k) * s +
                                          was->value(given.corners[3 * t + 2], k) * r;
                    sum += (now_is - it_was) * (now_is - it_was);
                }
                ++samples;
            }
    }
    return std::sqrt(sum / static_cast<double>(samples));
}

/// 1 at one place of the sheet, and nearly 0 a quarter of it away.
double bump(const Vec3& p) {
    const double x = (p.x - 20) / 3, y = (p.y - 12) / 3;
    return 1 / (1 + x * x + y * y);
}

} // namespace

TEST_CASE("what is painted on a flat sheet is seen by the weights", "[geometry]") {
    // The sheet is flat, so only the attributes determine where vertices are needed.
    Mesh m = shapes::grid(40, 40);
    add(m, "COLOR_0", Role::colour, 3, [](const Vec3& p, double* c) { c[0] = c[1] = c[2] = bump(p); });
    const auto on = simplify(m, {.weights = {.colour = 1}, .ratio = 0.1});
    const auto without = simplify(m, {.weights = {.colour = 0}, .ratio = 0.1});
    // The last collapse may remove one face more than requested.
    for (const auto* r : {&on, &without}) CHECK((r->faces_after == 319 || r->faces_after == 320));
    CHECK(off(m, on.mesh, "COLOR_0") < 0.25 * off(m, without.mesh, "COLOR_0"));
}

TEST_CASE("a warped texture does not slide", "[geometry]") {
    Mesh m = shapes::grid(40, 40);
    add(m, "TEXCOORD_0", Role::uv, 2, [](const Vec3& p, double* c) {
        c[0] = p.x / 40 + 0.05 * bump(p);
        c[1] = p.y / 40 - 0.05 * bump(p);
    });
    const auto on = simplify(m, {.ratio = 0.05});
    const auto without = simplify(m, {.weights = {.uv = 0}, .ratio = 0.05});
    CHECK(off(m, on.mesh, "TEXCOORD_0") < 0.5 * off(m, without.mesh, "TEXCOORD_0"));
}

TEST_CASE("skin weights hold the faces of a bend together", "[geometry]") {
    Mesh m = shapes::grid(40, 40);
    add(m, "WEIGHTS_0", Role::weights, 4, [](const Vec3& p, double* c) {
        c[0] = std::clamp((p.x - 15) / 10, 0.0, 1.0);
        c[1] = 1 - c[0];
    });
    Attribute joints;
    joints.name = "JOINTS_0";
    joints.role = Role::joints;
    joints.components = 4;
    std::vector<std::uint8_t> data;
    for (Index w = 0; w < m.wedge_count(); ++w) data.insert(data.end(), {3, 7, 0, 0});
    joints.data = std::move(data);
    m.attributes.push_back(std::move(joints));
    const auto on = simplify(m, {.ratio = 0.05});
    const auto without = simplify(m, {.weights = {.skin = 0}, .ratio = 0.05});
    const auto wrong = [](const Mesh& mesh) { // at the centres of faces
        const Attribute *weights = mesh.find("WEIGHTS_0", Domain::wedge),
                        *of = mesh.find("JOINTS_0", Domain::wedge);
        double sum = 0;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            double x = 0, pull = 0;
            for (Index c = 3 * f; c < 3 * f + 3; ++c) {
                x += mesh.point(c).x / 3;
                for (int k = 0; k < 4; ++k)
                    if (of->value(mesh.corners[c], k) == 3) pull += weights->value(mesh.corners[c], k) / 3;
            }
            const double off = pull - std::clamp((x - 15) / 10, 0.0, 1.0);
            const Vec3 area =
                cross(mesh.point(3 * f + 1) - mesh.point(3 * f), mesh.point(3 * f + 2) - mesh.point(3 * f));
            sum += off * off * length(area);
        }
        return std::sqrt(sum);
    };
    CHECK(wrong(on.mesh) < 0.5 * wrong(without.mesh));
}

TEST_CASE("attributes that are linear over the surface change nothing", "[geometry]") {
    Mesh m = shapes::grid(24, 24);
    for (auto& p : m.positions) p.z = 0.02 * p.x * p.x + 0.01 * p.y * p.y;
    Mesh painted = m;
    add(painted, "COLOR_0", Role::colour, 3, [](const Vec3& p, double* c) {
        c[0] = p.x / 64;
        c[1] = p.y / 64;
        c[2] = p.z / 64;
    });
    const auto plain = simplify(m, {.ratio = 0.2}),
               with = simplify(painted, {.weights = {.colour = 1e-3}, .ratio = 0.2});
    CHECK(with.faces_after == plain.faces_after);
    CHECK(*with.largest_error == Approx(*plain.largest_error).epsilon(0.2));
}

TEST_CASE("weighed attributes give the same bytes for any number of threads", "[geometry]") {
    Mesh m = shapes::icosphere(6);
    add(m, "TEXCOORD_0", Role::uv, 2, [](const Vec3& p, double* c) {
        c[0] = p.x * p.y;
        c[1] = p.z;
    });
    add(m, "NORMAL", Role::normal, 3, [](const Vec3& p, double* c) {
        c[0] = p.x;
        c[1] = p.y;
        c[2] = p.z;
    });
    const auto make = [&] { return simplify(m, {.ratio = 0.1}).mesh; };
    CHECK(broken_invariants(make()).empty());
    CHECK(test::same_for_any_threads(make));
    CHECK(test::sound(make(), 2));
}
