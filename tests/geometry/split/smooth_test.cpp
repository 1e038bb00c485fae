#include "geometry/inspect/inspect.hpp"
#include "geometry/split/split.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "oracle/openmesh_oracle.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

#include <algorithm>

using namespace facetmill;

namespace {

SplitSettings passes_of(SplitMethod method, int passes = 1) {
    SplitSettings s;
    s.method = method;
    s.passes = passes;
    return s;
}

/// The faces as lists of coincident vertices of `to`, each from its lowest vertex, sorted. Empty if a vertex
/// coincides with none.
std::vector<std::vector<Index>> faces_on(const Mesh& mesh, const Mesh& to) {
    std::vector<Index> place;
    for (const Vec3& p : mesh.positions) {
        Index best = 0;
        for (Index v = 0; v < to.vertex_count(); ++v)
            if (length(to.positions[v] - p) < length(to.positions[best] - p)) best = v;
        if (!(length(to.positions[best] - p) < 1e-12)) return {};
        place.push_back(best);
    }
    std::vector<std::vector<Index>> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> face;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) face.push_back(place[mesh.vertex(c)]);
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        faces.push_back(face);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

bool agrees_with_openmesh(const Mesh& mesh, SplitMethod method, int passes) {
    const Mesh mine = split(mesh, passes_of(method, passes)).mesh,
               theirs = test::openmesh_subdivided(mesh, method, passes);
    const auto faces = faces_on(mine, theirs);
    return !faces.empty() && faces == faces_on(theirs, theirs);
}

Mesh bumpy(Mesh mesh) {
    for (auto& p : mesh.positions) p += Vec3{p.y * p.z, 0.3 * p.x, 0.1 * p.x * p.y};
    return mesh;
}

} // namespace

TEST_CASE("smooth methods agree with OpenMesh on closed meshes", "[geometry]") {
    for (const Mesh& mesh : {bumpy(shapes::octahedron()), bumpy(shapes::icosphere(1)),
                             bumpy(shapes::torus(7, 5)), bumpy(shapes::tetrahedron())})
        for (const auto method :
             {SplitMethod::loop, SplitMethod::sqrt3, SplitMethod::butterfly, SplitMethod::catmull_clark})
            for (const int passes : {1, 2}) {
                CAPTURE(to_string(method), passes, mesh.face_count());
                CHECK(agrees_with_openmesh(mesh, method, passes));
            }
    CHECK(agrees_with_openmesh(bumpy(shapes::quad_cube()), SplitMethod::catmull_clark, 2));
}

TEST_CASE("smooth methods agree with OpenMesh at boundaries", "[geometry]") {
    const Mesh grid = bumpy(shapes::grid(3, 4));
    CHECK(agrees_with_openmesh(grid, SplitMethod::loop, 2));
    CHECK(agrees_with_openmesh(grid, SplitMethod::butterfly, 1));
    CHECK(agrees_with_openmesh(grid, SplitMethod::sqrt3, 2));
    CHECK(agrees_with_openmesh(shapes::open_cone(7), SplitMethod::sqrt3, 2));
}

TEST_CASE("smooth methods keep closedness and Euler's number, for vertices of any number of faces",
          "[geometry]") {
    for (const auto method :
         {SplitMethod::loop, SplitMethod::sqrt3, SplitMethod::butterfly, SplitMethod::catmull_clark}) {
        for (const Mesh& mesh : {shapes::uv_cube(), shapes::torus(9, 6)}) {
            const Mesh finer = split(mesh, passes_of(method, 2)).mesh;
            CHECK(broken_invariants(finer).empty());
            CHECK(test::sound(finer, test::count(mesh).euler));
        }
        // OpenMesh's weights end at 50 faces around a vertex.
        const Mesh cone = split(shapes::open_cone(70), passes_of(method)).mesh;
        CHECK(test::count(cone).euler == 1);
        for (const Vec3& p : cone.positions) CHECK((std::abs(p.x) <= 1 && std::abs(p.z) <= 1.01));
    }
}

TEST_CASE("a cube with feature edges stays a cube, without them it becomes round", "[geometry]") {
    for (const auto method : {SplitMethod::loop, SplitMethod::butterfly, SplitMethod::catmull_clark}) {
        SplitSettings s = passes_of(method, 3);
        s.feature_angle = 0.5;
        CAPTURE(to_string(method));
        CHECK(*inspect(split(shapes::cube(), s).mesh).volume == Approx(1).epsilon(1e-12));
        s.feature_angle = 1.6;
        CHECK(std::abs(*inspect(split(shapes::cube(), s).mesh).volume - 1) > 0.05);
        s.feature_angle = {};
        CHECK(std::abs(*inspect(split(shapes::cube(), s).mesh).volume - 1) > 0.05);
    }
}

TEST_CASE("a line of feature edges is a smooth curve: the rim of a cylinder", "[geometry]") {
    // A prism over an octagon: its rims are feature edges without corners.
    Mesh prism;
    constexpr Index n = 8;
    for (const double z : {0.0, 1.0})
        for (Index i = 0; i < n; ++i) {
            const double a = 2 * 3.14159265358979 * i / n;
            prism.positions.push_back({std::cos(a), std::sin(a), z});
        }
    std::vector<Index> bottom, top;
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        const Index side[] = {i, j, j + n, i + n};
        add_face(prism, side);
        bottom.insert(bottom.begin(), i);
        top.push_back(i + n);
    }
    add_face(prism, bottom);
    add_face(prism, top);
    SplitSettings s = passes_of(SplitMethod::catmull_clark, 2);
    s.feature_angle = 1.2; // the caps meet the sides at 90 degrees, the sides each other at 45
    const Mesh finer = split(prism, s).mesh;
    std::size_t on_rims = 0;
    for (const Vec3& p : finer.positions)
        on_rims += (p.z == 0 || p.z == 1) && std::sqrt(p.x * p.x + p.y * p.y) > 0.85;
    CHECK(on_rims == 2 * 4 * n);
    CHECK(test::sound(finer, 2));
}

TEST_CASE("smooth methods interpolate wedges along seams and recompute normals", "[geometry]") {
    for (const auto method : {SplitMethod::loop, SplitMethod::sqrt3, SplitMethod::catmull_clark}) {
        const SplitResult r = split(shapes::uv_cube(), passes_of(method));
        const Attribute* uv = r.mesh.find("TEXCOORD_0", Domain::wedge);
        REQUIRE(uv);
        for (std::size_t w = 0; w < r.mesh.wedge_count(); ++w)
            for (int c = 0; c < 2; ++c) CHECK((uv->value(w, c) >= 0 && uv->value(w, c) <= 1));
        for (const auto& change : r.changes)
            CHECK(change.kind == (change.attribute == "NORMAL" ? AttributeChange::Kind::recomputed
                                                               : AttributeChange::Kind::interpolated));
    }
}

TEST_CASE("smooth methods refuse what is not manifold, with the place", "[geometry]") {
    CHECK(test::failure([] { split(shapes::fan3(), passes_of(SplitMethod::loop)); }) ==
          "stage [E-MANIFOLD] split: loop needs a manifold, oriented mesh; the edge of vertices 0 and 1 has "
          "3 faces | use clean to repair non-manifold edges and vertices, or the method midpoint, which "
          "splits any mesh");
    CHECK(test::failure([] { split(shapes::hourglass(), passes_of(SplitMethod::sqrt3)); }) ==
          "stage [E-MANIFOLD] split: sqrt3 needs a manifold, oriented mesh; 2 fans of faces meet only at "
          "vertex 0 | use clean to repair non-manifold edges and vertices, or the method midpoint, which "
          "splits any mesh");
    CHECK(test::failure([] {
              split(shapes::moebius(9), passes_of(SplitMethod::catmull_clark));
          }).find("oriented inconsistently") != std::string::npos);
    CHECK(test::failure([] { split(shapes::quad_cube(), passes_of(SplitMethod::loop)); }) ==
          "stage [E-POLYGON] split: loop takes faces of at most 3 corners, face 0 has 4 | use triangulate "
          "first to make triangles of every face");
}

TEST_CASE("smooth methods give the same for any number of threads", "[geometry]") {
    const Mesh mesh = bumpy(shapes::icosphere(5));
    for (const auto method : {SplitMethod::loop, SplitMethod::sqrt3, SplitMethod::butterfly})
        CHECK(test::same_for_any_threads([&] { return split(mesh, passes_of(method)).mesh; }));
}

TEST_CASE("feature_angle: a right angle is not more than 90 degrees", "[geometry]") {
    const double right = 1.5707963267948966;
    for (const auto method : {SplitMethod::loop, SplitMethod::catmull_clark}) {
        SplitSettings s;
        s.method = method;
        const Mesh without = split(shapes::cube(), s).mesh;
        s.feature_angle = right;
        CHECK(split(shapes::cube(), s).mesh.positions == without.positions);
        s.feature_angle = right - 1e-6;
        CHECK(split(shapes::cube(), s).mesh.positions != without.positions);
    }
}
