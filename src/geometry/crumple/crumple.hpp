#pragma once
// Crumpling: every vertex is displaced once by a Gaussian amount, and faces that share it move with it.

#include "base/math/vec.hpp"
#include "mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace facetmill {

/// A standard normal number, cut off at `truncate`, that is a pure function of its key. Numbers beyond the
/// cut are drawn again, never clamped, so nothing heaps up there.
double gaussian(std::uint64_t key, double truncate);
/// The same for each key, several side by side in the processor. The spans are of one length.
void gaussians(std::span<const std::uint64_t> keys, double truncate, std::span<double> all);

/// Which positions are one place for the noise: those that are equal when rounded so.
enum class PositionRounding {
    float32, ///< to what most files hold
    far,     ///< to 40 significant bits, where float32 would make one place of many: far from the origin
};

/// The key of the noise at a world position: equal for positions of one place (-0 is 0).
std::uint64_t noise_key(std::uint64_t seed, const Vec3& world,
                        PositionRounding rounding = PositionRounding::float32);

/// Noise that is alike at places that are near each other: normal numbers on the points of a lattice, mixed
/// by smooth weights and scaled to deviation 1 everywhere (value noise); octaves of twice the frequency and
/// `roughness` times the amount each are added.
struct CorrelatedNoise {
    double frequency = 1; ///< lattice cells per world unit, above 0
    int octaves = 1;
    double roughness = 0.5; ///< amount of an octave beside the one before
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
    double frequency = 0;    ///< of correlated noise, per world unit; 0: every place for itself
    int octaves = 1;         ///< of correlated noise, 1 to 32
    double roughness = 0.5;  ///< of correlated noise: amount of each octave beside the one before, 0 to 1
    std::vector<double> mask = {}; ///< [vertices] 0 to 1: share of the move; empty: all of it
    PositionRounding places = PositionRounding::float32;
};

/// How the vertices of a mesh are to move, before any has.
struct CrumpleMoves {
    std::vector<std::uint64_t> keys; ///< [vertices] of the places: equal keys move together
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

/// Displaces each vertex of the mesh once. Topology, wedges and faces stay; NORMAL is recomputed, TANGENT
/// made perpendicular to it, all else kept.
///
/// The noise at a vertex is a pure function of the seed and of the world position, rounded (see
/// PositionRounding; -0 is 0). So vertices at one place move together, across seams, unwelded duplicates,
/// parts and files, and neither the order of the vertices nor the number of threads matters. Boundary and
/// mask are of places too: a boundary edge is one between two places with one face there, and a place moves
/// by the least share of its vertices. With `direction: normal` the normal is that of all faces of this mesh
/// that meet at the place. Amounts follow the normal distribution cut off at `truncate` (drawn again, never
/// clamped, so nothing heaps up at the limit); with a frequency, vertices that are near each other move alike
/// (see CorrelatedNoise). Throws usage (E-RANGE) for a setting out of range, stage (E-TRANSFORM) when
/// to_world is singular, (E-RANGE) when a vertex would leave the numbers that float32 has. After P. Bourke,
/// "Geometric Crumpling" (1994).
CrumpleResult crumple(Mesh mesh, const CrumpleSettings& settings);

/// The first half of crumple: nothing moves yet.
CrumpleMoves crumple_moves(const Mesh& mesh, const CrumpleSettings& settings);

/// The second half: positions before and after are compared, attributes settled.
CrumpleResult crumple_settled(Mesh mesh, const std::vector<Vec3>& before, const Transform& to_world);

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
    /// that lose their area. Else the faces of such pairs, those without area and those that are stretched
    /// too far.
    std::size_t found = 0;
    bool at_least = false;           ///< with `only_look`: there may be more than were found
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

/// Moves the vertices of all sheets, as far as faces of a sheet do not come to meet: every place has a share
/// 1, 1/2 ... 1/256, 0 of its move. In each round all new pairs of faces that meet (find_self_intersections,
/// folded neighbours included) and all faces that have lost their area are found, and every place of them
/// takes the next lower share, all at once, until there are none. Before the first round, places take lower
/// shares until no two corners of a face are drawn apart by more than eight times its longest edge: it would
/// meet a great many others. Where a sample of the faces tells that more than an eighth of them would be
/// found, half as much counts as too far, and so on (coarse). After eight rounds the places around those are
/// lowered too, after sixteen twice as far around in each round, so that the rounds are at most some forty.
/// Once 32 pairs of triangles with boxes that meet were looked at for each face, or three times as many as
/// met before the move, shares fall to an eighth at once, and after three such rounds to 0, those around too
/// (coarse). Shares only fall and places without a move are where they were, so it ends. Pairs that met
/// before the move are exempt. Sharing is by place: unwelded copies of a vertex are one.
///
/// Positions are rounded to float32 in part space, before and after: what is decided, exactly, is what files
/// hold. Polygons stand for their triangles as triangulated() cuts them. With only_look nothing is lowered.
/// The same for any number of threads. A round takes about as long as finding the self-intersections of the
/// faces that it lowered; the tree of boxes is sorted once. Of many sheets, only those of the first max_open
/// triangles keep it, and the others make it again when a round looks at them, to the same result. Sheets
/// that are alike before they move are searched for crossings once.
///
/// Only faces of one sheet are kept apart. Throws limit (E-LIMIT) when more than max_pairs pairs of a sheet
/// meet before: they could not all be exempt.
AvoidResult avoid_intersections(std::span<CrumpleSheet> sheets, bool only_look = false,
                                std::size_t max_pairs = std::size_t{8} << 20,
                                std::size_t max_open = max_open_triangles);

/// About the bytes that avoid_intersections takes for sheets of so many triangles, besides their meshes, when
/// the largest has so many.
double avoid_intersections_memory(double triangles, double largest);

} // namespace facetmill
