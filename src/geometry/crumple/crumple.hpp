#pragma once
// Crumples a mesh: displaces every vertex once by a Gaussian amount.

#include "base/math/vec.hpp"
#include "mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace facetmill {

/// A standard normal number, truncated at `truncate`. It is a pure function of its key. Numbers beyond the
/// limit are drawn again, not clamped, so that they do not accumulate at the limit.
[[nodiscard]] double gaussian(std::uint64_t key, double truncate);
/// Computes a number for each key, several at once by vector instructions. Both spans must have the same
/// length.
void gaussians(std::span<const std::uint64_t> keys, double truncate, std::span<double> all);

/// The rounding that decides which positions are equal for the noise.
enum class PositionRounding {
    float32, ///< the precision of most files
    far,     ///< to 40 significant bits, for coordinates far from the origin, where float32 would merge many
             ///< positions
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

    /// The amount at a world position, clamped to `truncate`.
    double at(std::uint64_t seed, const Vec3& world) const;
};

struct CrumpleSettings {
    enum class Direction {
        free,   ///< three independent amounts along the world axes
        normal, ///< a single amount along the vertex normal (area-weighted, in world space)
    };
    enum class Boundary {
        free,  ///< boundary vertices move like all others
        fixed, ///< boundary vertices stay
    };
    double amplitude = 0; ///< standard deviation of each amount, in world units; at least 0
    Direction direction = Direction::free;
    Boundary boundary = Boundary::free;
    std::uint64_t seed = 0;
    double truncate = 3;     ///< no amount exceeds this many standard deviations: at least 0.1
    Transform to_world = {}; ///< from the part's space to the world, in which vertices are displaced
    double frequency =
        0; ///< frequency of correlated noise, per world unit; 0: independent noise at every position
    int octaves = 1;        ///< octaves of correlated noise, 1 to 32
    double roughness = 0.5; ///< for correlated noise: amount of each octave relative to the previous, 0 to 1
    std::vector<double> mask = {}; ///< [vertices] share of the move, 0 to 1; empty: 1
    PositionRounding places = PositionRounding::float32;
};

/// The planned moves of the vertices of a mesh.
struct CrumpleMoves {
    std::vector<std::uint64_t> keys; ///< [vertices] keys of the positions: equal keys move together
    std::vector<Vec3> moves;         ///< [vertices] moves in part space, without boundary and mask
    std::vector<double>
        shares;           ///< [vertices] share of the move that boundary and mask allow, 0 to 1; empty: 1
    std::size_t held = 0; ///< vertices held by `boundary: fixed` or a mask of 0
};

struct CrumpleResult {
    Mesh mesh;
    AttributeChanges changes;
    double largest_move = 0;     ///< in world units
    double root_mean_square = 0; ///< RMS of the moves of all vertices, in world units
    std::size_t moved = 0;
    std::size_t held = 0; ///< vertices held by `boundary: fixed` or a mask of 0
};

/// Displaces each vertex of the mesh once. Topology, wedges and faces stay. NORMAL is recomputed, TANGENT
/// made perpendicular to it, and all else kept. The noise at a vertex is a pure function of the seed and of
/// the rounded world position (see PositionRounding; -0 is 0). So vertices at the same position move
/// together, across seams, unwelded duplicates, parts and files. The result does not depend on the order of
/// the vertices or the number of threads. Boundary and mask also apply to positions. A boundary edge
/// connects two positions and has a single face. A position moves by the smallest share of its vertices.
/// With `direction: normal` the normal is the sum over all faces of this mesh at the position. Amounts
/// follow the normal distribution truncated at `truncate` (drawn again, never clamped). With a frequency,
/// neighbouring vertices move similarly (see CorrelatedNoise). Throws a usage error (E-RANGE) for a setting
/// out of range, a stage error (E-TRANSFORM) when to_world is singular, and a stage error (E-RANGE) when a
/// vertex would exceed the range of float32. After P. Bourke, "Geometric Crumpling" (1994).
[[nodiscard]] CrumpleResult crumple(Mesh mesh, const CrumpleSettings& settings);

/// The first half of crumple: plans the moves.
[[nodiscard]] CrumpleMoves crumple_moves(const Mesh& mesh, const CrumpleSettings& settings);

/// The second half of crumple: compares positions before and after, and updates attributes.
[[nodiscard]] CrumpleResult crumple_settled(Mesh mesh, const std::vector<Vec3>& before,
                                            const Transform& to_world);

/// A mesh and its planned moves. Sheets move together at common keys.
struct CrumpleSheet {
    Mesh* mesh = nullptr;
    CrumpleMoves moves;
};

/// Multiplies the moves by the shares. Each position, over all sheets, uses the smallest share that its
/// vertices allow. Call it once, before any vertex moves.
void hold_joint_vertices(std::span<CrumpleSheet> sheets);

/// The maximum number of triangles in sheets kept ready for searching, which takes half a gigabyte.
inline constexpr std::size_t max_open_triangles = std::size_t{4} << 20;

struct AvoidResult {
    std::size_t exempt = 0; ///< pairs of faces that intersected before
    /// With `only_look`, new pairs of faces that the full moves would make (max_pairs at most), and faces
    /// that lose their area. Otherwise the faces of such pairs, faces without area and overstretched faces.
    std::size_t found = 0;
    bool at_least = false;           ///< with `only_look`: more pairs may exist
    std::size_t left = 0;            ///< new pairs in the result; 0 without `only_look`
    std::pair<Index, Index> first{}; ///< the first new pair, faces of sheet first_sheet
    std::size_t first_sheet = 0;
    int rounds = 0; ///< rounds of lowering
    /// Positions lowered in large steps, because small steps would have taken too much work.
    std::size_t coarse = 0;
    std::size_t box_pairs = 0; ///< pairs of triangles with boxes that meet, examined in all rounds
    /// The number of vertices by the share of their move: 1, 1/2 ... 1/256, 0.
    std::array<std::size_t, 10> shares{};
};

/// Limits the moves of the vertices of all sheets so that no faces of a sheet start to intersect. Every
/// position has a share 1, 1/2 ... 1/256, 0 of its move. Each round finds all new pairs of faces that meet
/// (find_self_intersections, folded neighbours included) and all faces that lost their area. All their
/// positions get the next lower share, until none are found. Before the first round, shares fall until no
/// two corners of a face move apart by more than eight times its longest edge. Such a face would meet a
/// great many others. If a sample suggests that more than an eighth of all faces would be found, the limit
/// is halved repeatedly (coarse). After eight rounds the surrounding positions are lowered too; after
/// sixteen, twice as far around in each round. This limits the rounds to about forty. The box pairs of all
/// rounds are counted. Beyond 32 per face, or three times the pairs before the move if these are more,
/// shares fall to an eighth at once. After three such rounds they fall to 0, including the surroundings
/// (coarse). Shares only fall, and without moves all positions are unchanged, so the loop ends. Pairs that
/// met before the move are exempt. Shares belong to positions: unwelded copies of a vertex count as merged.
/// Positions are rounded to float32 in part space, before and after, so that exact decisions hold for the
/// values in files. Polygons are tested as the triangles of triangulated(). With only_look, no share is
/// lowered. The result does not depend on the number of threads. A round takes about as long as finding the
/// self-intersections of the lowered faces; the tree of boxes is sorted once. Only the sheets of the first
/// max_open triangles keep their tree. Other sheets rebuild it when a round needs it, with the same result.
/// Identical sheets are searched for crossings once before the move. Faces of different sheets may still
/// meet. Throws a limit error (E-LIMIT) when more than max_pairs pairs of a sheet meet before the move,
/// because not all could be exempt.
[[nodiscard]] AvoidResult avoid_intersections(std::span<CrumpleSheet> sheets, bool only_look = false,
                                              std::size_t max_pairs = std::size_t{8} << 20,
                                              std::size_t max_open = max_open_triangles);

/// The approximate memory in bytes of avoid_intersections for sheets with this many triangles, without their
/// meshes. largest: the triangles of the largest sheet.
[[nodiscard]] double avoid_intersections_memory(double triangles, double largest);

} // namespace facetmill
