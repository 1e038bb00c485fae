#include "support/catch.hpp"

#include "base/error.hpp"
#include "geometry/unwrap/unwrap.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"
#include "support/failure.hpp"
#include "support/meshes.hpp"

#include <array>
#include <map>
#include <set>

using namespace facetmill;

namespace {

/// A point of the texture in steps of 2^-24, which float32 holds exactly; y from below.
struct Step {
    std::int64_t x, y;
    bool operator==(const Step&) const = default;
};
using Corners = std::array<Step, 3>;

constexpr double steps = 16777216;

Step step_at(const UnwrappedMesh& m, std::size_t corner) {
    const double u = m.coordinates[2 * corner] * steps, v = m.coordinates[2 * corner + 1] * steps;
    CHECK(u == std::floor(u));
    CHECK(v == std::floor(v));
    return {static_cast<std::int64_t>(u), static_cast<std::int64_t>(steps - v)};
}

std::int64_t turn(const Step& a, const Step& b, const Step& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::vector<Corners> triangles_of_layout(const UnwrappedMesh& m) {
    std::vector<Corners> all(m.face_chart.size());
    for (std::size_t f = 0; f < all.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) all[f][i] = step_at(m, 3 * f + i);
    return all;
}

/// Whether the triangle, which turns left, has an edge with all of the other triangle on or outside it.
bool separates(const Corners& t, const Corners& other) {
    for (std::size_t i = 0; i < 3; ++i)
        if (std::all_of(other.begin(), other.end(),
                        [&](const Step& p) { return turn(t[i], t[(i + 1) % 3], p) <= 0; }))
            return true;
    return false;
}

/// Whether the closed triangle and the closed square of a texel have a common point: no side of either
/// separates them strictly.
bool touches_texel(const Corners& t, std::int64_t x, std::int64_t y, std::int64_t size) {
    const std::array<Step, 4> square{{{x * size, y * size},
                                      {(x + 1) * size, y * size},
                                      {(x + 1) * size, (y + 1) * size},
                                      {x * size, (y + 1) * size}}};
    for (std::size_t i = 0; i < 3; ++i)
        if (std::all_of(square.begin(), square.end(),
                        [&](const Step& p) { return turn(t[i], t[(i + 1) % 3], p) < 0; }))
            return false;
    const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
    return x1 >= square[0].x && x0 <= square[2].x && y1 >= square[0].y && y0 <= square[2].y;
}

struct Unwrapped {
    std::vector<Corners> triangles;
    std::vector<Index> charts;
    UnwrapLayout layout;
};

Unwrapped unwrapped(const Mesh& mesh, const UnwrapSettings& settings) {
    const UnwrapInput input{&mesh, {}};
    Unwrapped u{{}, {}, unwrap({&input, 1}, settings)};
    u.triangles = triangles_of_layout(u.layout.meshes[0]);
    u.charts = u.layout.meshes[0].face_chart;
    return u;
}

void check_faces(const Unwrapped& u, const Mesh& mesh) {
    REQUIRE(u.charts.size() == mesh.face_count());
    CHECK(std::set<Index>(u.charts.begin(), u.charts.end()).size() == u.layout.charts);
    for (std::size_t f = 0; f < u.triangles.size(); ++f) {
        REQUIRE(u.charts[f] < u.layout.charts);
        const Corners& t = u.triangles[f];
        CHECK(turn(t[0], t[1], t[2]) > 0);
        for (const Step& p : t) CHECK((p.x >= 0 && p.y >= 0 && p.x <= steps && p.y <= steps));
    }
}

void check_overlaps(const Unwrapped& u) {
    std::size_t overlaps = 0;
    for (std::size_t f = 0; f < u.triangles.size(); ++f)
        for (std::size_t g = f + 1; g < u.triangles.size(); ++g)
            overlaps +=
                !separates(u.triangles[f], u.triangles[g]) && !separates(u.triangles[g], u.triangles[f]);
    CHECK(overlaps == 0);
}

void check_gutter(const Unwrapped& u, std::int64_t texture, std::int64_t gutter) {
    const auto size = static_cast<std::int64_t>(steps) / texture;
    std::vector<Index> chart_at(static_cast<std::size_t>(texture * texture), none);
    std::size_t shared = 0, near = 0;
    for (std::size_t f = 0; f < u.triangles.size(); ++f) {
        const Corners& t = u.triangles[f];
        const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
        const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
        for (std::int64_t y = y0 / size; y <= std::min(texture - 1, y1 / size); ++y)
            for (std::int64_t x = x0 / size; x <= std::min(texture - 1, x1 / size); ++x) {
                if (!touches_texel(t, x, y, size)) continue;
                Index& chart = chart_at[static_cast<std::size_t>(y * texture + x)];
                shared += chart != none && chart != u.charts[f];
                chart = u.charts[f];
            }
    }
    for (std::int64_t y = 0; y < texture; ++y)
        for (std::int64_t x = 0; x < texture; ++x) {
            const Index chart = chart_at[static_cast<std::size_t>(y * texture + x)];
            for (std::int64_t dy = 0; chart != none && dy <= gutter && y + dy < texture; ++dy)
                for (std::int64_t dx = -gutter; dx <= gutter; ++dx) {
                    if (x + dx < 0 || x + dx >= texture) continue;
                    const Index other = chart_at[static_cast<std::size_t>((y + dy) * texture + x + dx)];
                    near += other != none && other != chart;
                }
        }
    CHECK(shared == 0);
    CHECK(near == 0);
}

/// A chart is connected: its faces share points of the texture along edges.
void check_connected(const Unwrapped& u) {
    const auto& points = u.layout.meshes[0].corner_point;
    std::map<std::pair<Index, Index>, Index> first_face;
    DisjointSets sets(u.triangles.size());
    for (Index c = 0; c < points.size(); ++c) {
        const Index next = c % 3 == 2 ? c - 2 : c + 1;
        const auto [place, fresh] = first_face.try_emplace(std::minmax({points[c], points[next]}), c / 3);
        if (!fresh) sets.join(place->second, c / 3);
    }
    std::set<Index> roots;
    for (Index f = 0; f < u.triangles.size(); ++f) roots.insert(sets.find(f));
    CHECK(roots.size() == u.layout.charts);
}

void check_laws(const Mesh& mesh, const UnwrapSettings& settings) {
    const Unwrapped u = unwrapped(mesh, settings);
    check_faces(u, mesh);
    check_overlaps(u);
    check_gutter(u, static_cast<std::int64_t>(settings.texture), static_cast<std::int64_t>(settings.gutter));
    check_connected(u);
    CHECK(u.layout.used > 0);
    CHECK(u.layout.used <= 1);
    CHECK(u.layout.stretch.l2 < settings.max_stretch);
}

UnwrapSettings texture_of(std::size_t texture, std::size_t gutter) {
    UnwrapSettings s;
    s.texture = texture;
    s.gutter = gutter;
    return s;
}

/// Every face with vertices of its own.
Mesh soup_of(const Mesh& mesh) {
    Mesh soup;
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        soup.corners.push_back(c);
        soup.positions.push_back(mesh.point(c));
    }
    return soup;
}

} // namespace

TEST_CASE("unwrap: charts cover every face once, without overlap, apart by the gutter", "[unwrap]") {
    check_laws(shapes::cube(), texture_of(128, 4));
    check_laws(shapes::icosphere(2), texture_of(256, 3));
    check_laws(shapes::torus(16, 12), texture_of(128, 2));
    check_laws(shapes::open_cone(24), texture_of(64, 1));
    check_laws(shapes::grid(8, 5), texture_of(64, 0));
    check_laws(test::noisy_icosphere(2, 0.3, 7), texture_of(256, 4));
}

TEST_CASE("unwrap: broken meshes get charts", "[unwrap]") {
    check_laws(shapes::bowtie(), texture_of(64, 2));
    check_laws(shapes::fan3(), texture_of(64, 2));
    check_laws(shapes::hourglass(), texture_of(64, 2));
    check_laws(triangulated(shapes::moebius(12)), texture_of(128, 2));
    check_laws(shapes::crossing(), texture_of(64, 2));
    check_laws(soup_of(shapes::icosphere(1)), texture_of(256, 2));
    Mesh thin = shapes::grid(3, 3);
    thin.positions[5] = thin.positions[6];              // edges without length
    thin.positions[9].y = 1;                            // and faces without area
    thin.corners.insert(thin.corners.end(), {0, 0, 1}); // and a face with a vertex twice
    check_laws(thin, texture_of(128, 2));
    Mesh point = shapes::cube();
    for (Vec3& p : point.positions) p = {1, 2, 3};
    check_laws(point, texture_of(128, 2));
}

TEST_CASE("unwrap: shapes that unroll are not stretched", "[unwrap]") {
    const Unwrapped cube = unwrapped(shapes::cube(), texture_of(512, 2));
    CHECK(cube.layout.charts <= 6);
    CHECK(cube.layout.stretch.l2 == Approx(1).margin(1e-6));
    CHECK(cube.layout.stretch.largest == Approx(1).margin(1e-6));
    CHECK(cube.layout.used > 0.55);
    const Unwrapped cone = unwrapped(shapes::open_cone(32), texture_of(512, 2));
    CHECK(cone.layout.stretch.l2 < 1.001);
    const Unwrapped sheet = unwrapped(shapes::grid(20, 20), texture_of(512, 0));
    CHECK(sheet.layout.charts == 1);
    CHECK(sheet.layout.cut_length == 0);
    CHECK(sheet.layout.used > 0.95);
}

TEST_CASE("unwrap: a bound of the stretch holds, and does not take fewer charts", "[unwrap]") {
    UnwrapSettings settings = texture_of(512, 2);
    settings.max_stretch = 1.3;
    const Unwrapped few = unwrapped(shapes::icosphere(3), settings);
    settings.max_stretch = 1.001;
    const Unwrapped many = unwrapped(shapes::icosphere(3), settings);
    CHECK(few.layout.charts <= many.layout.charts);
    CHECK(many.layout.stretch.l2 < 1.001);
}

TEST_CASE("unwrap: texels are as dense as asked, in the world", "[unwrap]") {
    const Mesh mesh = shapes::cube();
    UnwrapSettings settings = texture_of(0, 2);
    settings.texels_per_unit = 10;
    UnwrapInput input{&mesh, {}};
    for (int k = 0; k < 3; ++k) input.to_world.m[k][k] = 3;
    const UnwrapLayout layout = unwrap({&input, 1}, settings);
    CHECK(layout.texture == 128); // 6 sides of 30 x 30 texels
    double area = 0;
    for (const Corners& t : triangles_of_layout(layout.meshes[0]))
        area += static_cast<double>(turn(t[0], t[1], t[2])) / 2;
    CHECK(area / (steps * steps) * 128 * 128 == Approx(6 * 30 * 30).epsilon(1e-3));
}

TEST_CASE("unwrap: all meshes share the square, and threads change nothing", "[unwrap]") {
    const Mesh torus = shapes::torus(32, 24), ball = test::noisy_icosphere(3, 0.1, 3);
    const std::array<UnwrapInput, 2> inputs{{{&torus, {}}, {&ball, {}}}};
    UnwrapLayout layouts[2];
    for (int threads : {1, 2}) {
        set_threads(threads);
        layouts[threads - 1] = unwrap(inputs, texture_of(512, 4));
    }
    set_threads(0);
    for (std::size_t m = 0; m < 2; ++m) {
        CHECK(layouts[0].meshes[m].coordinates == layouts[1].meshes[m].coordinates);
        CHECK(layouts[0].meshes[m].face_chart == layouts[1].meshes[m].face_chart);
    }
    std::vector<Corners> all = triangles_of_layout(layouts[0].meshes[0]);
    const std::size_t first = all.size();
    for (const Corners& t : triangles_of_layout(layouts[0].meshes[1])) all.push_back(t);
    std::size_t overlaps = 0;
    for (std::size_t f = 0; f < first; ++f)
        for (std::size_t g = first; g < all.size(); ++g)
            overlaps += !separates(all[f], all[g]) && !separates(all[g], all[f]);
    CHECK(overlaps == 0);
}

TEST_CASE("unwrap: charts that do not fit are refused", "[unwrap]") {
    const Mesh soup = soup_of(shapes::icosphere(2));
    const UnwrapInput input{&soup, {}};
    CHECK(test::failure([&] {
              (void)unwrap({&input, 1}, texture_of(32, 8));
          }).find("E-UNWRAP-FULL") != std::string::npos);
    UnwrapSettings dense = texture_of(0, 2);
    dense.texels_per_unit = 1e6;
    CHECK(test::failure([&] {
              (void)unwrap({&input, 1}, dense);
          }).find("E-UNWRAP-FULL") != std::string::npos);
    CHECK(unwrap({}, {}).charts == 0);
}

TEST_CASE("unwrap: coordinates split wedges on seams and keep all other attributes", "[unwrap]") {
    Mesh mesh = shapes::uv_cube();
    const UnwrapInput input{&mesh, {}};
    const UnwrapLayout layout = unwrap({&input, 1}, texture_of(64, 2));
    const std::vector<float> old = std::get<std::vector<float>>(mesh.find("TEXCOORD_0", Domain::wedge)->data);
    const Mesh before = mesh;
    const AttributeChanges changes = put_coordinates(mesh, layout.meshes[0], 0, true);
    const Attribute *uv = mesh.find("TEXCOORD_0", Domain::wedge),
                    *kept = mesh.find("TEXCOORD_1", Domain::wedge),
                    *normals = mesh.find("NORMAL", Domain::wedge);
    REQUIRE((uv && kept && normals));
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        CHECK(mesh.vertex(c) == before.vertex(c));
        for (int k = 0; k < 2; ++k) {
            CHECK(uv->value(mesh.corners[c], k) ==
                  layout.meshes[0].coordinates[2 * c + static_cast<Index>(k)]);
            CHECK(kept->value(mesh.corners[c], k) == old[2 * before.corners[c] + static_cast<Index>(k)]);
        }
    }
    CHECK(changes.size() == 3);
}
