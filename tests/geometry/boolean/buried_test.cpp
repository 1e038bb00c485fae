// Checks faces that stay uncut deep in unions and differences, against voxels and against single operations.
#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "geometry/boolean/combine.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/orient/orient.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <optional>

using namespace facetmill;
using namespace facetmill::test;

namespace {

using Task = CombineOperation;

CombineResult sound_one(std::vector<Mesh> meshes, Task operation, Index second = none) {
    CombineResult r = combine(std::move(meshes), {operation, second});
    INFO(r.failure.value_or(CombineFailure{}).why);
    REQUIRE(!r.failure);
    check_solid(r.mesh);
    return r;
}

Mesh block(const Vec3& low, const Vec3& high, bool squares = false) {
    Mesh mesh = squares ? shapes::quad_cube() : shapes::cube();
    for (Vec3& p : mesh.positions)
        for (std::size_t k = 0; k < 3; ++k) p[k] = low[k] + p[k] * (high[k] - low[k]);
    return mesh;
}

/// A rotation that maps no axis to an axis, by a unit quaternion of rounded numbers.
Mesh turned_by(Mesh mesh, std::uint64_t seed) {
    const Vec3 v = random_point(1, seed, 31);
    const double w = between(-1, 1, seed, 32), n = w * w + dot(v, v);
    for (Vec3& p : mesh.positions) p = p + (2.0 / n) * cross(v, cross(v, p) + w * p);
    return mesh;
}

struct IntegerBox {
    std::array<int, 3> low, high;
    Mesh mesh(bool squares) const {
        const auto at = [](const std::array<int, 3>& p) {
            return Vec3{double(p[0]), double(p[1]), double(p[2])};
        };
        return block(at(low), at(high), squares);
    }
};

constexpr int lattice = 9;

std::vector<IntegerBox> random_blocks(std::uint64_t seed, std::size_t count, int longest) {
    std::vector<IntegerBox> all;
    std::uint64_t key = 0;
    const auto number = [&](int low, int high) { // low <= number < high
        return std::min(high - 1, low + static_cast<int>(between(0, high - low, seed, key++)));
    };
    while (all.size() < count) {
        IntegerBox b{};
        for (std::size_t k = 0; k < 3; ++k) {
            const int size = number(1, longest + 1);
            b.low[k] = number(0, lattice - size + 1);
            b.high[k] = b.low[k] + size;
        }
        all.push_back(b);
        if (number(0, 8) == 0) all.push_back(b); // present twice
    }
    return all;
}

/// Cubes of a lattice with an empty border around them.
class LatticeCubes {
  public:
    void set(const IntegerBox& b, bool to) {
        for (int i = b.low[0]; i < b.high[0]; ++i)
            for (int j = b.low[1]; j < b.high[1]; ++j)
                for (int k = b.low[2]; k < b.high[2]; ++k) cubes_[place(i, j, k)] = to;
    }
    bool at(int i, int j, int k) const { return cubes_[place(i, j, k)]; }

    int volume() const { return static_cast<int>(std::count(cubes_.begin(), cubes_.end(), true)); }
    int area() const {
        int count = 0;
        each([&](int i, int j, int k) {
            count += at(i, j, k) != at(i - 1, j, k);
            count += at(i, j, k) != at(i, j - 1, k);
            count += at(i, j, k) != at(i, j, k - 1);
        });
        return count;
    }
    /// V - E + F of the surface. None if cubes touch at an edge or a vertex only, or leave such a gap.
    std::optional<int> euler() const {
        int total = area();
        bool is_manifold = true;
        each([&](int i, int j, int k) {
            const std::array<std::array<int, 3>, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
            for (std::size_t a = 0; a < 3; ++a) { // the edge along the axis from here on
                const auto &u = axes[(a + 1) % 3], &v = axes[(a + 2) % 3];
                const bool here = at(i, j, k), by_u = at(i - u[0], j - u[1], k - u[2]),
                           by_v = at(i - v[0], j - v[1], k - v[2]),
                           by_both = at(i - u[0] - v[0], j - u[1] - v[1], k - u[2] - v[2]);
                if (here == by_u && here == by_v && here == by_both) continue;
                if (here == by_both && by_u == by_v) is_manifold = false;
                const bool is_edge = here != by_u || by_u != by_both || by_both != by_v;
                total -= is_edge;
            }
            total += vertex(i, j, k, is_manifold);
        });
        return is_manifold ? std::optional(total) : std::nullopt;
    }

  private:
    static constexpr int wide = lattice + 3;
    static std::size_t place(int i, int j, int k) {
        return static_cast<std::size_t>(((i + 1) * wide + j + 1) * wide + k + 1);
    }
    template <class Do>
    static void each(Do&& act) {
        for (int i = 0; i <= lattice; ++i)
            for (int j = 0; j <= lattice; ++j)
                for (int k = 0; k <= lattice; ++k) act(i, j, k);
    }
    /// Whether the surface has a vertex at this position. The filled cubes and the empty cubes among its
    /// eight neighbours must each be connected over faces.
    int vertex(int i, int j, int k, bool& is_manifold) const {
        std::array<bool, 8> around{};
        for (unsigned n = 0; n < 8; ++n) around[n] = at(i - int(n & 1), j - int(n >> 1 & 1), k - int(n >> 2));
        const auto pieces = [&](bool of) {
            int count = 0;
            std::array<bool, 8> seen{};
            for (unsigned n = 0; n < 8; ++n) {
                if (around[n] != of || seen[n]) continue;
                ++count;
                std::vector<unsigned> stack{n};
                seen[n] = true;
                while (!stack.empty()) {
                    const unsigned m = stack.back();
                    stack.pop_back();
                    for (unsigned bit = 1; bit < 8; bit *= 2)
                        if (around[m ^ bit] == of && !seen[m ^ bit]) {
                            seen[m ^ bit] = true;
                            stack.push_back(m ^ bit);
                        }
                }
            }
            return count;
        };
        const int set = pieces(true), unset = pieces(false);
        if (set > 1 || unset > 1) is_manifold = false;
        return set > 0 && unset > 0;
    }
    std::vector<bool> cubes_ = std::vector<bool>(wide * wide * wide, false);
};

} // namespace

TEST_CASE("unions of many boxes are what counting says", "[geometry][combine][property]") {
    std::size_t manifold = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const auto boxes = random_blocks(seed, 3 + seed, 2 + static_cast<int>(seed % 5));
        LatticeCubes voxels;
        std::vector<Mesh> meshes;
        for (const IntegerBox& b : boxes) {
            voxels.set(b, true);
            meshes.push_back(b.mesh((seed + meshes.size()) % 2 == 0));
        }
        INFO("seed " << seed);
        const Mesh mesh = sound_one(std::move(meshes), Task::unite).mesh;
        CHECK(test::volume(mesh) == Approx(voxels.volume()).epsilon(1e-13));
        CHECK(test::area(mesh) == Approx(voxels.area()).epsilon(1e-13));
        if (const auto euler = voxels.euler()) {
            ++manifold;
            CHECK(test::euler(mesh) == *euler);
        }
    }
    CHECK(manifold > 5);
}

TEST_CASE("differences by many boxes are what counting says", "[geometry][combine][property]") {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const auto boxes = random_blocks(seed + 100, 4 + seed, 1 + static_cast<int>(seed % 5));
        LatticeCubes voxels;
        std::vector<Mesh> meshes;
        const IntegerBox whole{{0, 0, 0}, {lattice, lattice, lattice - 1}};
        voxels.set(whole, true);
        meshes.push_back(whole.mesh(seed % 2 == 0));
        for (const IntegerBox& b : boxes) {
            voxels.set(b, false);
            meshes.push_back(b.mesh(seed % 3 == 0));
        }
        INFO("seed " << seed);
        const Mesh mesh = sound_one(std::move(meshes), Task::subtract, 1).mesh;
        CHECK(test::volume(mesh) == Approx(voxels.volume()).epsilon(1e-13));
        CHECK(test::area(mesh) == Approx(voxels.area()).epsilon(1e-13));
        if (const auto euler = voxels.euler()) CHECK(test::euler(mesh) == *euler);
    }
}

TEST_CASE("intersections with many boxes are what counting says", "[geometry][combine][property]") {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const auto boxes = random_blocks(seed + 200, 4 + seed, 1 + static_cast<int>(seed % 5));
        LatticeCubes covered, both;
        std::vector<Mesh> meshes{
            IntegerBox{{1, 1, 2}, {lattice - 1, lattice, lattice - 1}}.mesh(seed % 2 == 0)};
        for (const IntegerBox& b : boxes) {
            covered.set(b, true);
            meshes.push_back(b.mesh(seed % 3 == 0));
        }
        for (int i = 1; i < lattice - 1; ++i)
            for (int j = 1; j < lattice; ++j)
                for (int k = 2; k < lattice - 1; ++k)
                    both.set({{i, j, k}, {i + 1, j + 1, k + 1}}, covered.at(i, j, k));
        INFO("seed " << seed);
        const Mesh mesh = sound_one(std::move(meshes), Task::intersect, 1).mesh;
        CHECK(test::volume(mesh) == Approx(both.volume()).epsilon(1e-13));
        CHECK(test::area(mesh) == Approx(both.area()).epsilon(1e-13));
        if (const auto euler = both.euler()) CHECK(test::euler(mesh) == *euler);
    }
}

TEST_CASE("turned solids are united at once as they are one by one", "[geometry][combine][property]") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        std::vector<Mesh> meshes;
        for (std::uint64_t i = 0; i < 4 + seed; ++i) {
            const std::uint64_t key = 100 * seed + i;
            Mesh solid = i % 4 == 3   ? shapes::icosphere(2)
                         : i % 7 == 5 ? noisy_torus(12, 6, 0.02, key) // no core
                                      : block({-0.8, -0.7, -0.9}, {0.8, 0.9, 0.6}, i % 2 == 0);
            meshes.push_back(test::moved(turned_by(std::move(solid), key), random_point(1.2, key, 7)));
        }
        Mesh one = meshes[0];
        for (std::size_t i = 1; i < meshes.size(); ++i) one = sound_one({one, meshes[i]}, Task::unite).mesh;
        INFO("seed " << seed);
        const Mesh all = sound_one(meshes, Task::unite).mesh;
        CHECK(test::volume(all) == Approx(test::volume(one)).epsilon(1e-12));
        CHECK(test::area(all) == Approx(test::area(one)).epsilon(1e-12));
        CHECK(test::euler(all) == test::euler(one));
        const Mesh rest = block({-2, -2, -2}, {2, 2, 2});
        std::vector<Mesh> taken{rest};
        for (const Mesh& solid : meshes) taken.push_back(solid);
        const std::vector<Mesh> two{rest, all};
        for (const Task task : {Task::subtract, Task::intersect})
            CHECK(test::volume(sound_one(taken, task, 1).mesh) ==
                  Approx(test::volume(sound_one(two, task, 1).mesh)).epsilon(1e-12));
    }
}

TEST_CASE("what meets within a third solid is not cut", "[geometry][combine]") {
    const Mesh around = block({0, 0, 0}, {10, 10, 10}), one = block({2, 2, 2}, {5, 5, 5}),
               other = block({3, 3, 3}, {6, 7, 8}, true);
    const auto r = sound_one({around, one, other}, Task::unite);
    CHECK(r.mesh.face_count() == 12);
    CHECK(r.cut_faces == 0);
    CHECK(r.covered_faces == 12 + 6);
    // The same applies to subtracted solids and the solid that they are subtracted from, but not to
    // remaining solids.
    CHECK(sound_one({one, other, around}, Task::subtract, 2).mesh.face_count() == 0);
    const auto hole = sound_one({around, one, other}, Task::subtract, 1);
    CHECK(hole.cut_faces > 0);
    CHECK(test::volume(hole.mesh) == Approx(1000 - 27 - 60 + 8));
    CHECK(sound_one({one, other, around}, Task::intersect, 2).mesh.face_count() > 0);
    const auto part = sound_one({block({-1, -1, -1}, {11, 11, 11}), around, one, other}, Task::intersect, 1);
    CHECK(part.cut_faces == 0);
    CHECK(part.mesh.face_count() == 12);
    // Two solids together can enclose a region that neither encloses alone.
    const auto two = sound_one({block({0, 0, 0}, {6, 10, 10}), block({4, 0, 0}, {10, 10, 10}),
                                block({1, 4, 4}, {9, 6, 6}), block({1, 5, 3}, {9, 7, 5})},
                               Task::unite);
    CHECK(test::volume(two.mesh) == Approx(1000));
    CHECK(two.covered_faces >= 12);
}

TEST_CASE("nothing is buried by its own faces, by cavities, or where solids only touch",
          "[geometry][combine]") {
    // Equal solids, faces of one plane, and edges on edges.
    const Mesh cube = block({0, 0, 0}, {1, 1, 1});
    CHECK(test::volume(sound_one({cube, cube, cube, cube}, Task::unite).mesh) == Approx(1));
    const Mesh tower =
        sound_one({cube, block({0, 0, 1}, {1, 1, 2}), block({0, 0, 0.5}, {1, 1, 1.5}), cube}, Task::unite)
            .mesh;
    CHECK(test::volume(tower) == Approx(2));
    CHECK(test::area(tower) == Approx(10));
    // A cavity with bars that cross in it, and on its wall.
    Mesh hollow = block({0, 0, 0}, {10, 10, 10});
    append(hollow, orient(block({2, 2, 2}, {8, 8, 8}), {OrientMethod::flip, {}}).mesh);
    const Mesh bar = block({1, 4, 4}, {9, 6, 6}), across = block({4, 1, 4}, {6, 9, 6}),
               thick = block({3, 3, 3}, {7, 7, 7});
    const Mesh filled = sound_one({hollow, bar, across, thick}, Task::unite).mesh;
    CHECK(test::volume(filled) == Approx(1000 - 216 + 64 + 16));
    // A solid that passes through itself, inside out at one end, does not hide more than its actual inside.
    Mesh eight = block({0, 0, 0}, {4, 1, 1});
    for (Vec3& p : eight.positions)
        if (p.x > 2) p = {p.x, 0.2 - 0.4 * p.y + 0.3, p.z}; // inverted, and smaller
    const auto r = combine({eight, block({-1, -1, -1}, {5, 2, 2}), block({1, -2, 0.2}, {3, 3, 0.8})}, {});
    INFO(r.failure.value_or(CombineFailure{}).why);
    REQUIRE(!r.failure);
    CHECK(test::closed(r.mesh));
    CHECK(clean_steps::crossings(r.mesh).count == 0);
}

TEST_CASE("a grid of cubes that overlap by a tenth is one box", "[geometry][combine]") {
    std::vector<Mesh> cubes;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
            for (int k = 0; k < 9; ++k)
                cubes.push_back(test::moved(shapes::cube(), Vec3{double(i), double(j), double(k)} * 0.875));
    const auto r = sound_one(cubes, Task::unite);
    CHECK(test::volume(r.mesh) == 8.0 * 8 * 8);
    CHECK(test::area(r.mesh) == 6.0 * 8 * 8);
    CHECK(test::euler(r.mesh) == 2);
    set_threads(1);
    const Mesh alone = sound_one(cubes, Task::unite).mesh;
    set_threads(3);
    CHECK(test::same_mesh(sound_one(cubes, Task::unite).mesh, alone));
    set_threads(0);
    CHECK(test::same_mesh(r.mesh, alone));
}
