#pragma once
// Crumpling: every vertex is displaced once by a Gaussian amount, and faces that share it move with it.

#include "base/math/vec.hpp"
#include "mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace facetmill {

/// A standard normal number, truncated at `truncate`, that is a pure function of its key. Numbers beyond the
/// limit are drawn again, never clamped, so that none accumulate at the limit.
[[nodiscard]] double gaussian(std::uint64_t key, double truncate);
/// The same for each key, several side by side in the processor. The spans are of one length.
void gaussians(std::span<const std::uint64_t> keys, double truncate, std::span<double> all);

/// The rounding that decides which positions count as the same for the noise.
enum class PositionRounding {
    float32, ///< the precision of most files
    far,     ///< to 40 significant bits, where float32 would make one place of many: far from the origin
};

/// The key of the noise at a world position: equal for positions that round to the same (-0 is 0).
[[nodiscard]] std::uint64_t noise_key(std::uint64_t seed, const Vec3& world,
                                      PositionRounding rounding = PositionRounding::float32);

/// Noise that is similar at neighbouring positions (value noise): normal numbers on the points of a lattice,
/// mixed by smooth weights and scaled to deviation 1 everywhere. Each octave adds noise of twice the
/// frequency and `roughness` times the amount.
struct CorrelatedNoise {
    double frequency = 1; ///< lattice cells per world unit, above 0
    int octaves = 1;
    double roughness = 0.5; ///< amount of an octave relative to the previous
    double truncate = 3;
    PositionRounding places = PositionRounding::float32;

    /// The amount at the place of a world position; clamped to the cut.
    double at(std::uint64_t seed, const Vec3& world) const;
};

struct CrumpleSettings {
    enum class Direction {
        free,   ///< three independent amounts along x, y and z of the world
        normal, ///< one amount along the vertex normal (area-weighted, world space)
    };
    enum class Boundary {
        free,  ///< boundary vertices move as all others
        fixed, ///< they stay
    };
    double amplitude = 0; ///< standard deviation of each amount, world units, >= 0
    Direction direction = Direction::free;
    Boundary boundary = Boundary::free;
    std::uint64_t seed = 0;
    double truncate = 3;     ///< no amount exceeds this many standard deviations: at least 0.1
    Transform to_world = {}; ///< part space -> world; the displacement is made there
    double frequency = 0;    ///< of correlated noise, per world unit; 0: independent noise at every position
    int octaves = 1;         ///< of correlated noise, 1 to 32
    double roughness = 0.5;  ///< of correlated noise: amount of each octave relative to the previous, 0 to 1
    std::vector<double> mask = {}; ///< [vertices] 0 to 1: share of the move; empty: all of it
    PositionRounding places = PositionRounding::float32;
};

/// How the vertices of a mesh are to move, before any has.
struct CrumpleMoves {
    std::vector<std::uint64_t> keys; ///< [vertices] keys of the positions: equal keys move together
    std::vector<Vec3> moves;         ///< [vertices] in part space, as if nothing were held or masked
    std::vector<double> shares; ///< [vertices] 0 to 1: how much of it the vertex itself allows, because of
                                ///< the boundary and the mask; empty: all
    std::size_t held = 0;       ///< vertices that were held, by boundary: fixed or a mask of 0
};

struct CrumpleResult {
    Mesh mesh;
    AttributeChanges changes;
    double largest_move = 0;     ///< world units
    double root_mean_square = 0; ///< of the moves of all vertices, world units
    std::size_t moved = 0;
    std::size_t held = 0; ///< vertices that were held, by boundary: fixed or a mask of 0
};

/// Displaces each vertex of the mesh once. Topology, wedges and faces stay. NORMAL is recomputed, TANGENT
/// made perpendicular to it, and all else kept.
/// The noise at a vertex is a pure function of the seed and of the rounded world position (see
/// PositionRounding; -0 is 0). So vertices at one position move together, across seams, unwelded duplicates,
/// parts and files. Neither the order of the vertices nor the number of threads matters. Boundary and mask
/// also apply to positions. A boundary edge connects two positions and has one face; a position moves by the
/// least share of its vertices. With `direction: normal` the normal is the sum over all faces of this mesh
/// at the position. Amounts follow the normal distribution truncated at `truncate` (drawn again, never
/// clamped). With a frequency, neighbouring vertices move alike (see CorrelatedNoise). Throws usage
/// (E-RANGE) for a setting out of range, stage (E-TRANSFORM) when to_world is singular, and stage (E-RANGE)
/// when a vertex would exceed the range of float32. After P. Bourke, "Geometric Crumpling" (1994).
[[nodiscard]] CrumpleResult crumple(Mesh mesh, const CrumpleSettings& settings);

/// The first half of crumple: nothing moves yet.
[[nodiscard]] CrumpleMoves crumple_moves(const Mesh& mesh, const CrumpleSettings& settings);

/// The second half: positions before and after are compared, attributes settled.
[[nodiscard]] CrumpleResult crumple_settled(Mesh mesh, const std::vector<Vec3>& before,
                                            const Transform& to_world);

/// A mesh and how it is to move; several move together where they have keys in common.
struct CrumpleSheet {
    Mesh* mesh = nullptr;
    CrumpleMoves moves;
};

/// Takes the shares into the moves: each place, over all sheets, takes the least that its vertices allow. To
/// be called once, before anything moves.
void hold_joint_vertices(std::span<CrumpleSheet> sheets);

/// Triangles of sheets that are kept ready to be searched: half a gigabyte.
inline constexpr std::size_t max_open_triangles = std::size_t{4} << 20;

struct AvoidResult {
    std::size_t exempt = 0; ///< pairs of faces that met before
    /// With `only_look`, new pairs of faces that the full moves would make (max_pairs at most), and faces
    /// that lose their area. Otherwise the faces of such pairs, faces without area and overstretched faces.
    std::size_t found = 0;
    bool at_least = false;           ///< with `only_look`: more pairs may exist
    std::size_t left = 0;            ///< new pairs in the result: 0, but with `only_look`
    std::pair<Index, Index> first{}; ///< of the pairs found, faces of sheet first_sheet
    std::size_t first_sheet = 0;
    int rounds = 0; ///< of lowering
    /// Places that were lowered in large steps, since the work was too much for small ones.
    std::size_t coarse = 0;
    std::size_t box_pairs = 0; ///< pairs of triangles with boxes that meet, looked at in all rounds
    /// Vertices by the share of their move: 1, 1/2 ... 1/256, 0.
    std::array<std::size_t, 10> shares{};
};

/// Limits the moves of the vertices of all sheets so that faces of a sheet do not come to meet. Every
/// position has a share 1, 1/2 ... 1/256, 0 of its move. Each round finds all new pairs of faces that meet
/// (find_self_intersections, folded neighbours included) and all faces that lost their area. All their
/// positions take the next lower share, until none are found. Before the first round, shares fall until no
/// two corners of a face move apart by more than eight times its longest edge, because such a face would
/// meet a great many others. If a sample suggests that more than an eighth of all faces would be found, the
/// limit is halved repeatedly (coarse). After eight rounds the surrounding positions are lowered too; after
/// sixteen, twice as far around in each round. This limits the rounds to about forty. The box pairs of all
/// rounds are counted. Beyond 32 per face, or three times the pairs before the move if these are more, shares
/// fall to an eighth at once. After three such rounds they fall to 0, including the surroundings (coarse).
/// Shares only fall, and without moves all positions are unchanged, so the loop ends. Pairs that met before
/// the move are exempt. Shares belong to positions: unwelded copies of a vertex count as merged. Positions
/// are rounded to float32 in part space, before and after, so that exact decisions hold for the values in
/// files. Polygons are tested as the triangles of triangulated(). With only_look nothing is lowered. The
/// result is the same for any number of threads. A round takes about as long as finding the
/// self-intersections of the lowered faces; the tree of boxes is sorted once. Only the sheets of the first
/// max_open triangles keep their tree. Other sheets rebuild it when a round needs it, with the same result.
/// Identical sheets are searched for crossings once before the move.
/// Faces of different sheets may still meet. Throws limit (E-LIMIT) when more than max_pairs pairs of a
/// sheet meet before the move, because not all could be exempt.
[[nodiscard]] AvoidResult avoid_intersections(std::span<CrumpleSheet> sheets, bool only_look = false,
                                              std::size_t max_pairs = std::size_t{8} << 20,
                                              std::size_t max_open = max_open_triangles);

/// The approximate memory in bytes of avoid_intersections for sheets of so many triangles, without their
/// meshes. largest: the triangles of the largest sheet.
[[nodiscard]] double avoid_intersections_memory(double triangles, double largest);

} // namespace facetmill
