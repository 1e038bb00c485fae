#pragma once
// Crumpling: every vertex is displaced once by a Gaussian amount, and faces that share it move with it.

#include "mesh/mesh.hpp"

namespace facetmill {

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
};

struct CrumpleResult {
    Mesh mesh;
    Fates fates;
    double largest_move = 0;     ///< world units
    double root_mean_square = 0; ///< of the moves of all vertices, world units
    std::size_t moved = 0;
    std::size_t held = 0;  ///< boundary vertices that were held
};

/// Displaces each vertex of the mesh once. Topology, wedges and faces stay; NORMAL is recomputed, TANGENT
/// made perpendicular to it, all else kept.
///
/// The noise at a vertex is a pure function of the seed and of the world position rounded to float32 (-0 is
/// 0). So vertices at one place move together, across seams, unwelded duplicates, parts and files, and
/// neither the order of the vertices nor the number of threads matters. With `direction: normal` the normal
/// is that of all faces of this mesh that meet at the place. Amounts follow the normal distribution cut off
/// at `truncate` (drawn again, never clamped, so nothing heaps up at the limit). Throws usage (E-RANGE) for a
/// setting out of range, stage (E-TRANSFORM) when to_world is singular. Source: the note 'Geometric
/// crumpling' (1994).
CrumpleResult crumple(Mesh mesh, const CrumpleSettings& settings);

/// A standard normal number, cut off at `truncate`, that is a pure function of its key.
double gaussian(std::uint64_t key, double truncate);

/// The key of the noise at a world position: equal for positions equal in float32.
std::uint64_t noise_key(std::uint64_t seed, const Vec3& world);

} // namespace facetmill
