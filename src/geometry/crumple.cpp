#include "geometry/crumple.hpp"

#include "base/error.hpp"
#include "base/functions.hpp"
#include "base/numbers.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/moved.hpp"
#include "geometry/neighbours.hpp"

#include <bit>

namespace facetmill {

namespace {

using Settings = CrumpleSettings;

void check(const Settings& s) {
    if (!(s.amplitude >= 0 && std::isfinite(s.amplitude)))
        throw Error(ErrorKind::usage, "E-RANGE",
                    "crumple: amplitude is at least 0, not " + spelled(s.amplitude));
    if (!(s.truncate >= 0.1))
        throw Error(ErrorKind::usage, "E-RANGE",
                    "crumple: truncate is at least 0.1, not " + spelled(s.truncate));
}

/// The inverse of the linear part of t, by its adjugate.
Transform inverse_linear(const Transform& t) {
    const Vec3 r0{t.m[0][0], t.m[0][1], t.m[0][2]}, r1{t.m[1][0], t.m[1][1], t.m[1][2]},
        r2{t.m[2][0], t.m[2][1], t.m[2][2]};
    const double d = t.determinant();
    if (!(d != 0 && std::isfinite(1 / d)))
        throw Error(ErrorKind::stage, "E-TRANSFORM",
                    "crumple: the part's transform flattens it, so it has no inverse",
                    "apply or repair the transform first");
    const Vec3 columns[3] = {cross(r1, r2) / d, cross(r2, r0) / d, cross(r0, r1) / d};
    Transform inverse;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) inverse.m[i][j] = columns[j][i];
    return inverse;
}

std::uint32_t canonical_bits(double x) {
    const float f = static_cast<float>(x);
    return f == 0 ? 0 : std::bit_cast<std::uint32_t>(f);
}

/// Sums, over the vertices at one place, the area vectors of their faces: a normal that copies of a vertex
/// share.
std::vector<Vec3> place_normals(const Mesh& mesh, const std::vector<Vec3>& world,
                                const std::vector<std::uint64_t>& keys, bool mirrored) {
    const std::size_t n = mesh.vertex_count();
    const VertexLists at = corners_at_vertices(mesh);
    const std::vector<Index> faces = mesh.all_triangles() ? std::vector<Index>{} : corner_faces(mesh);
    std::vector<Vec3> normals(n);
    parallel_for(n, [&](std::size_t v) {
        Vec3 sum;
        for (const Index c : at.of(static_cast<Index>(v))) {
            const Index f = faces.empty() ? c / 3 : faces[c];
            const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
            const Vec3& first = world[mesh.vertex(begin)];
            for (Index i = begin + 1; i + 1 < end; ++i)
                sum += cross(world[mesh.vertex(i)] - first, world[mesh.vertex(i + 1)] - first);
        }
        normals[v] = mirrored ? -sum : sum;
    });
    std::vector<Index> order(n);
    for (std::size_t v = 0; v < n; ++v) order[v] = static_cast<Index>(v);
    radix_sort(order, [&](Index v) { return keys[v]; });
    for (std::size_t i = 0, j = 0; i < n; i = j) {
        Vec3 sum;
        for (; j < n && keys[order[j]] == keys[order[i]]; ++j) sum += normals[order[j]];
        for (std::size_t k = i; k < j; ++k) normals[order[k]] = normalised(sum);
    }
    return normals;
}

struct Moves {
    double largest = 0, sum = 0; ///< of squares
    std::size_t count = 0;
};

} // namespace

double gaussian(std::uint64_t key, double truncate) {
    double g = 0;
    for (std::uint64_t attempt = 0; attempt < 4096; ++attempt) {
        g = inverse_normal(uniform(hashed(key, attempt)));
        if (g >= -truncate && g <= truncate) return g;
    }
    return std::clamp(g, -truncate,
                      truncate); // not reached: at truncate 0.1 a draw holds with probability 0.08
}

std::uint64_t noise_key(std::uint64_t seed, const Vec3& world) {
    const std::uint64_t xy = (std::uint64_t{canonical_bits(world.x)} << 32) | canonical_bits(world.y);
    return hashed(hashed(hashed(seed, 0x6372756d706c65), xy), canonical_bits(world.z));
}

CrumpleResult crumple(Mesh mesh, const Settings& settings) {
    check(settings);
    CrumpleResult result;
    const bool placed = !settings.to_world.identity();
    const Transform back = placed ? inverse_linear(settings.to_world) : Transform{};
    const std::size_t n = mesh.vertex_count();
    std::vector<Vec3> world(n);
    std::vector<std::uint64_t> keys(n);
    parallel_for(n, [&](std::size_t v) {
        world[v] = placed ? settings.to_world.point(mesh.positions[v]) : mesh.positions[v];
        keys[v] = noise_key(settings.seed, world[v]);
    });
    const bool along = settings.direction == Settings::Direction::normal;
    const std::vector<Vec3> normals =
        along ? place_normals(mesh, world, keys, settings.to_world.determinant() < 0) : std::vector<Vec3>{};
    const std::vector<std::uint8_t> held = settings.boundary == Settings::Boundary::fixed
                                               ? boundary_vertices(mesh)
                                               : std::vector<std::uint8_t>{};
    const auto amount = [&](std::size_t v, std::uint64_t axis) {
        return settings.amplitude * gaussian(hashed(keys[v], axis), settings.truncate);
    };
    const auto move = [&](std::size_t v) -> Vec3 {
        if (!held.empty() && held[v]) return {};
        if (along) return normals[v] * amount(v, 0);
        return {amount(v, 0), amount(v, 1), amount(v, 2)};
    };
    const Moves moves = parallel_reduce(
        n, Moves{},
        [&](std::size_t begin, std::size_t end) {
            Moves m;
            for (std::size_t v = begin; v < end; ++v) {
                const Vec3 d = move(v);
                if (d == Vec3{}) continue;
                mesh.positions[v] += placed ? back.vector(d) : d;
                m.largest = std::max(m.largest, dot(d, d)), m.sum += dot(d, d), ++m.count;
            }
            return m;
        },
        [](Moves a, Moves b) {
            return Moves{std::max(a.largest, b.largest), a.sum + b.sum, a.count + b.count};
        });
    result.largest_move = std::sqrt(moves.largest);
    result.root_mean_square = n > 0 ? std::sqrt(moves.sum / static_cast<double>(n)) : 0;
    result.moved = moves.count;
    for (const auto h : held) result.held += h;
    result.fates = settle_moved(mesh);
    result.mesh = std::move(mesh);
    return result;
}

} // namespace facetmill
