#include "geometry/crumple/crumple.hpp"

#include "base/error.hpp"
#include "base/math/numbers.hpp"
#include "base/math/random.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/relax/relax.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace facetmill {

namespace {

using Settings = CrumpleSettings;

void check(const Settings& s) {
    if (!(s.amplitude >= 0 && std::isfinite(s.amplitude)))
        throw Error(ErrorKind::usage, "E-RANGE",
                    "crumple: amplitude must be at least 0, not " + to_string(s.amplitude));
    if (!(s.truncate >= 0.1))
        throw Error(ErrorKind::usage, "E-RANGE",
                    "crumple: truncate must be at least 0.1, not " + to_string(s.truncate));
    if (!(s.frequency >= 0 && std::isfinite(s.frequency)))
        throw Error(ErrorKind::usage, "E-RANGE",
                    "crumple: frequency must be at least 0, not " + to_string(s.frequency));
    if (s.octaves < 1 || s.octaves > 32)
        throw Error(ErrorKind::usage, "E-RANGE",
                    "crumple: octaves must be 1 to 32, not " + std::to_string(s.octaves));
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

/// The vertices, grouped by equal keys, ascending.
std::vector<Index> by_place(const std::vector<std::uint64_t>& keys) {
    std::vector<Index> order(keys.size());
    for (std::size_t v = 0; v < order.size(); ++v) order[v] = static_cast<Index>(v);
    radix_sort(order, [&](Index v) { return keys[v]; });
    return order;
}

/// [vertices] 1 if an edge with exactly one face ends at the vertex's position.
std::vector<std::uint8_t> boundary_places(const Mesh& mesh, const std::vector<std::uint64_t>& keys) {
    const std::vector<Index> order = by_place(keys);
    std::vector<Index> first(keys.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && keys[order[i]] == keys[order[i - 1]] ? first[order[i - 1]] : order[i];
    Mesh welded;
    welded.positions = mesh.positions;
    welded.face_offsets = mesh.face_offsets;
    welded.corners.resize(mesh.corner_count());
    parallel_for(mesh.corner_count(),
                 [&](std::size_t c) { welded.corners[c] = first[mesh.vertex(static_cast<Index>(c))]; });
    const std::vector<std::uint8_t> boundary = boundary_vertices(welded);
    std::vector<std::uint8_t> held(keys.size());
    parallel_for(held.size(), [&](std::size_t v) { held[v] = boundary[first[v]]; });
    return held;
}

/// Sums the area vectors of the faces of all vertices at a position, so that copies of a vertex share the
/// normal.
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
            sum += area_vector_at(mesh, f, [&](Index i) { return world[mesh.vertex(i)]; });
        }
        normals[v] = mirrored ? -sum : sum;
    });
    const std::vector<Index> order = by_place(keys);
    for (std::size_t i = 0, j = 0; i < n; i = j) {
        Vec3 sum;
        for (; j < n && keys[order[j]] == keys[order[i]]; ++j) sum += normals[order[j]];
        for (std::size_t k = i; k < j; ++k) normals[order[k]] = normalised(sum);
    }
    return normals;
}

/// Refuses moves beyond the range of float32, which files store.
void check_reach(const Mesh& mesh, const std::vector<Vec3>& moves, double amplitude) {
    constexpr double most = std::numeric_limits<float>::max();
    const auto fits = [](const Vec3& p) {
        return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most;
    };
    const auto leaving = parallel_reduce(
        moves.size(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t v = begin; v < end; ++v)
                count += fits(mesh.positions[v]) && !fits(mesh.positions[v] + moves[v]);
            return count;
        },
        [](std::size_t a, std::size_t b) { return a + b; });
    if (leaving > 0)
        throw Error(ErrorKind::stage, "E-RANGE",
                    "crumple: the amplitude " + to_string(amplitude) +
                        " moves vertices beyond 3.4e+38, the largest number that files hold",
                    "use a smaller amplitude");
}

/// The amounts of vertices along one or three axes, in world units.
class Amounts {
  public:
    Amounts(const Settings& s, const std::vector<Vec3>& world, const std::vector<std::uint64_t>& keys)
        : settings_(s), world_(world),
          keys_(keys), correlated_{s.frequency, s.octaves, s.roughness, s.truncate, s.places} {}

    /// Calls use(v, amounts of v) for the vertices from begin to end.
    template <class Use>
    void for_each(std::size_t begin, std::size_t end, std::size_t axes, Use&& use) const {
        constexpr std::size_t at_once = 128;
        std::array<std::uint64_t, 3 * at_once> keys;
        std::array<double, 3 * at_once> all;
        for (std::size_t first = begin; first < end; first += at_once) {
            const std::size_t count = std::min(at_once, end - first);
            for (std::size_t v = first, i = 0; v < first + count; ++v)
                for (std::uint64_t axis = 0; axis < axes; ++axis, ++i)
                    if (settings_.frequency > 0)
                        all[i] = correlated_.at(hashed(settings_.seed, axis), world_[v]);
                    else
                        keys[i] = hashed(keys_[v], axis);
            if (!(settings_.frequency > 0))
                gaussians(std::span(keys).first(axes * count), settings_.truncate,
                          std::span(all).first(axes * count));
            for (std::size_t i = 0; i < axes * count; ++i) all[i] *= settings_.amplitude;
            for (std::size_t v = first; v < first + count; ++v) use(v, all.data() + axes * (v - first));
        }
    }

  private:
    const Settings& settings_;
    const std::vector<Vec3>& world_;
    const std::vector<std::uint64_t>& keys_;
    CorrelatedNoise correlated_;
};

} // namespace

CrumpleMoves crumple_moves(const Mesh& mesh, const Settings& settings) {
    check(settings);
    const bool placed = !settings.to_world.identity();
    const Transform back = placed ? inverse_linear(settings.to_world) : Transform{};
    const std::size_t n = mesh.vertex_count();
    CrumpleMoves result;
    result.keys.resize(n);
    result.moves.resize(n);
    std::vector<Vec3> world(n);
    parallel_for(n, [&](std::size_t v) {
        world[v] = placed ? settings.to_world.point(mesh.positions[v]) : mesh.positions[v];
        result.keys[v] = noise_key(settings.seed, world[v], settings.places);
    });
    const bool along = settings.direction == Settings::Direction::normal;
    const std::vector<Vec3> normals =
        along ? place_normals(mesh, world, result.keys, settings.to_world.determinant() < 0)
              : std::vector<Vec3>{};
    const Amounts amount(settings, world, result.keys);
    parallel_chunks(n, [&](std::size_t begin, std::size_t end) {
        amount.for_each(begin, end, along ? 1 : 3, [&](std::size_t v, const double* amounts) {
            const Vec3 move = along ? normals[v] * amounts[0] : Vec3{amounts[0], amounts[1], amounts[2]};
            result.moves[v] = placed ? back.vector(move) : move;
        });
    });
    check_reach(mesh, result.moves, settings.amplitude);
    result.shares = settings.mask;
    if (settings.boundary != Settings::Boundary::free) {
        result.shares.resize(n, 1);
        const std::vector<std::uint8_t> held = boundary_places(mesh, result.keys);
        for (std::size_t v = 0; v < n; ++v)
            if (held[v]) result.shares[v] = 0;
    }
    result.held = static_cast<std::size_t>(std::count(result.shares.begin(), result.shares.end(), 0.0));
    return result;
}

CrumpleResult crumple_settled(Mesh mesh, const std::vector<Vec3>& before, const Transform& to_world) {
    CrumpleResult result;
    const MoveSize moves = move_size(before, mesh.positions, to_world);
    result.largest_move = moves.largest;
    result.root_mean_square = moves.root_mean_square;
    result.moved = moves.count;
    result.changes = settle_moved(mesh);
    result.mesh = std::move(mesh);
    return result;
}

CrumpleResult crumple(Mesh mesh, const Settings& settings) {
    CrumpleSheet sheet{&mesh, crumple_moves(mesh, settings)};
    hold_joint_vertices({&sheet, 1});
    const std::vector<Vec3> before = mesh.positions;
    parallel_for(before.size(), [&](std::size_t v) { mesh.positions[v] += sheet.moves.moves[v]; });
    CrumpleResult result = crumple_settled(std::move(mesh), before, settings.to_world);
    result.held = sheet.moves.held;
    return result;
}

} // namespace facetmill
