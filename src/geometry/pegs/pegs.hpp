#pragma once
// Joins the tiles of a solid by pegs, or by holes for dowels and magnets.

#include "geometry/tile/tile.hpp"

#include <string>
#include <utility>

namespace facetmill {

enum class PegKind {
    pegs,    ///< the lower tile of a pair gets a peg and the upper tile gets a hole
    dowels,  ///< both tiles get a hole of half the length
    magnets, ///< both tiles get a hole of the whole length
};

/// Lengths are in world units and above zero, except clearance and wall, which may be 0.
struct PegSettings {
    PegKind kind = PegKind::pegs;
    double diameter = 1;
    double length = 1;     ///< of a peg out of its tile, of a dowel, or of a magnet
    double clearance = 0;  ///< by which holes are deeper, and wider on each side
    double wall = 0;       ///< the least material around holes and the roots of pegs
    std::size_t count = 2; ///< the maximum for each pair of tiles
    int sides = 32;
    std::optional<Primitive> primitive; ///< of the new faces
};

/// A place where two tiles are joined.
struct Peg {
    std::size_t axis = 0;
    std::size_t low = 0, high = 0; ///< numbers of the tiles below and above along the axis
    Vec3 at;                       ///< in the plane between them, in world space
};

struct PegsResult {
    std::vector<Peg> pegs;
    std::vector<std::pair<std::size_t, std::size_t>> without; ///< pairs of neighbours without room for one
    /// If a Boolean operation fails: the tile, and why. The tiles must not be used then.
    std::optional<std::pair<std::size_t, std::string>> failure;
};

/// whole: the closed mesh that `tile` cut, in the same space. Pegs lie along the axes of the grid. All points
/// of an axis have at least the radius of the hole plus the wall to the surface and to the borders of both
/// tiles. The search along an axis has steps of an eighth of the wall, so at least 15/16 of the wall remain.
/// Candidate positions form a square grid, and pegs are placed at positions that are far apart. If the grid
/// has no place, it is refined down to half the radius. Pegs have a polygon as their section. Its corners lie
/// on the circle, and for a hole its sides touch it. Pegs and holes are united with tiles and subtracted from
/// tiles exactly, so each tile stays a closed manifold. The volume of all tiles changes by the volume of pegs
/// minus the volume of holes. The same for any number of threads.
[[nodiscard]] PegsResult add_pegs(std::vector<Tile>& tiles, const Mesh& whole, const TileSettings& settings,
                                  const PegSettings& pegs);

/// The length by which a peg enlarges the box of its tile.
[[nodiscard]] inline double protrusion(const PegSettings& pegs) {
    return pegs.kind == PegKind::pegs ? pegs.length : 0;
}

} // namespace facetmill
