#include "io/read_back.hpp"

#include "base/math/random.hpp"
#include "base/math/whole_number.hpp"
#include "base/progress.hpp"
#include "base/text/words.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/flatten.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/drawn_box.hpp"
#include "mesh/float32_ulp.hpp"
#include "mesh/placement.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"
#include "parallel/storage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <span>

namespace facetmill::io {

namespace {

using Points = std::vector<std::array<double, 3>>;

void add_used(const Part& part, bool in_world_space, Points& points) {
    const Mesh& mesh = part.mesh;
    std::vector<std::uint8_t> used(mesh.vertex_count());
    for (Index c = 0; c < mesh.corner_count(); ++c) used[mesh.vertex(c)] = 1;
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        const Vec3 p = in_world_space ? in_world(part, mesh.positions[v]) : mesh.positions[v];
        points.push_back({p.x, p.y, p.z});
    }
}

std::size_t count_positions(Points& points) {
    std::sort(points.begin(), points.end());
    return static_cast<std::size_t>(std::unique(points.begin(), points.end()) - points.begin());
}

void add(VertexChanges& sum, Points before, Points after) {
    const std::size_t were = before.size(), are = after.size();
    constexpr std::size_t many = 10000; // larger sets are both sorted at once
    std::size_t places = 0, left = 0;
    parallel_for(
        2, [&](std::size_t i) { i == 0 ? places = count_positions(before) : left = count_positions(after); },
        were < many ? 2 : 1);
    const std::size_t rounded = places > left ? places - left : 0;
    sum.rounded += rounded;
    if (are > were) sum.added += are - were;
    if (were > are + rounded) sum.merged += were - are - rounded;
}

} // namespace

VertexChanges vertex_changes(const Scene& before, const Scene& after) {
    VertexChanges changes;
    const bool by_part = before.parts.size() == after.parts.size();
    Points here, there;
    for (std::size_t i = 0; i < before.parts.size(); ++i) {
        add_used(before.parts[i], !by_part, here);
        if (!by_part) continue;
        add_used(after.parts[i], false, there);
        add(changes, std::move(here), std::move(there));
        here = {};
        there = {};
    }
    if (by_part) return changes;
    for (const Part& part : after.parts) add_used(part, true, there);
    add(changes, std::move(here), std::move(there));
    return changes;
}

// --- read back

namespace {

/// A scene in world space: the points and corners of all parts, in order. The scene must outlive it, because
/// data of a scene of one part is referenced, not copied.
struct Flat {
    std::span<const Vec3> points;
    std::span<const Index> corners;
    std::vector<Vec3> ends; ///< ends of lines, in order

    /// degenerate: include faces of fewer than three distinct vertices.
    explicit Flat(const Scene& scene, bool degenerate = true) {
        for (const auto& part : scene.parts)
            for (const Index w : part.mesh.lines)
                ends.push_back(in_world(part, part.mesh.positions[part.mesh.vertex_of_wedge(w)]));
        if (!degenerate) {
            add_sound_faces(scene);
        } else if (scene.parts.size() == 1) {
            const Part& part = scene.parts.front();
            if (part.transform.identity())
                points = part.mesh.positions;
            else
                add_points(part);
            if (part.mesh.has_seams())
                add_corners(part.mesh, 0);
            else
                corners = part.mesh.corners;
        } else {
            for (const auto& part : scene.parts) add_corners(part.mesh, add_points(part));
        }
        if (points.empty()) points = made_points_;
        if (corners.empty()) corners = made_corners_;
    }
    Flat(const Flat&) = delete;
    Flat& operator=(const Flat&) = delete;

    /// The points that faces use; all points if there are neither faces nor lines.
    std::vector<Vec3> used() const {
        if (corners.empty())
            return ends.empty() ? std::vector(points.begin(), points.end()) : std::vector<Vec3>{};
        std::vector<std::uint8_t> is_used(points.size());
        for (const Index p : corners) is_used[p] = 1;
        std::vector<Vec3> found;
        reserve_large(found, points.size());
        for (std::size_t p = 0; p < points.size(); ++p)
            if (is_used[p]) found.push_back(points[p]);
        return found;
    }

  private:
    /// Returns the index of the first added point.
    Index add_points(const Part& part) {
        const Transform to_world = part.transform;
        const std::size_t first = made_points_.size();
        made_points_.resize(first + part.mesh.vertex_count());
        parallel_for(part.mesh.vertex_count(), [&](std::size_t v) {
            made_points_[first + v] = to_world.point(part.mesh.positions[v]);
        });
        return static_cast<Index>(first);
    }

    void add_corners(const Mesh& mesh, Index first) {
        const std::size_t before = made_corners_.size();
        made_corners_.resize(before + mesh.corner_count());
        parallel_for(mesh.corner_count(), [&](std::size_t c) {
            made_corners_[before + c] = first + mesh.vertex(static_cast<Index>(c));
        });
    }

    /// Adds the faces of three or more distinct vertices from every part.
    void add_sound_faces(const Scene& scene) {
        for (const auto& part : scene.parts) {
            const Mesh& mesh = part.mesh;
            const std::size_t first = made_points_.size();
            for (const Vec3& p : mesh.positions) made_points_.push_back(in_world(part, p));
            for (Index f = 0; f < mesh.face_count(); ++f) {
                std::set<Index> vertices;
                for (const Index w : mesh.face_wedges(f)) vertices.insert(mesh.vertex_of_wedge(w));
                if (vertices.size() < 3) continue;
                for (const Index w : mesh.face_wedges(f))
                    made_corners_.push_back(static_cast<Index>(first) + mesh.vertex_of_wedge(w));
            }
        }
    }

    std::vector<Vec3> made_points_;
    std::vector<Index> made_corners_;
};

/// Returns the largest distance, or any distance above the tolerance if the largest exceeds it.
template <class Distance>
double largest(std::size_t count, double tolerance, Distance&& distance) {
    return parallel_reduce(
        count, 0.0,
        [&](std::size_t begin, std::size_t end) {
            double most = 0;
            for (std::size_t i = begin; i < end && most <= tolerance; ++i) most = std::max(most, distance(i));
            return most;
        },
        [](double a, double b) { return std::max(a, b); });
}

/// A hash grid: points are sorted by the hash keys of their cells. A table has the start of each range of
/// keys. A lookup is direct but may visit points of other cells. Blocks of 8 x 8 x 8 cells have similar
/// keys, so that nearby points are mostly adjacent in memory.
class Grid {
  public:
    Grid(const std::vector<Vec3>& points, double cell) : cell_(cell) {
        while (points.size() >> bits_ != 0) ++bits_;
        std::vector<KeyedPlace> order;
        resize_large(order, points.size());
        parallel_for(points.size(), [&](std::size_t i) {
            order[i] = {share(cell_of(points[i])), static_cast<Index>(i)};
        });
        radix_sort(
            order, [](const KeyedPlace& p) { return p.key; }, bits_);
        begins_.assign((std::size_t{1} << bits_) + 1, 0);
        for (const KeyedPlace& p : order) ++begins_[p.key + 1];
        for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
        resize_large(points_, points.size());
        parallel_for(points.size(), [&](std::size_t i) { points_[i] = points[order[i].place]; });
    }

    double cell() const { return cell_; }
    /// The points, in grid order.
    const std::vector<Vec3>& points() const { return points_; }

    /// The distance to the nearest point if this is below half a cell, otherwise a larger value or infinity.
    /// The search stops at any point no farther than `enough`.
    double nearest(const Vec3& p, double enough) const {
        const Cell centre = cell_of(p);
        double best = nearest_in(centre, p, HUGE_VAL, enough);
        if (best <= enough) return best;
        std::array<double, 3> side{}; // squared distance to the nearer neighbouring cell
        Cell beside = centre;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double within = p[axis] / cell_ - static_cast<double>(centre[axis]);
            beside[axis] += within < 0.5 ? -1 : 1;
            const double to_side = std::min(within, 1 - within) * cell_;
            side[axis] = to_side * to_side;
        }
        for (int i = 1; i < 8 && best > enough; ++i) {
            Cell c = centre;
            double gap = 0; // squared distance to the cell
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (i >> axis & 1) {
                    c[axis] = beside[axis];
                    gap += side[axis];
                }
            // The margin makes the search visit both sides of a border, whichever way the point's cell was
            // rounded.
            if (gap * (1 - 1e-9) <= best * best) best = nearest_in(c, p, best, enough);
        }
        return best;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;
    double nearest_in(const Cell& cell, const Vec3& p, double best, double enough) const {
        const std::size_t k = share(cell);
        for (std::size_t i = begins_[k]; i < begins_[k + 1] && best > enough; ++i)
            best = std::min(best, length(points_[i] - p));
        return best;
    }
    Cell cell_of(const Vec3& p) const {
        Cell c;
        for (std::size_t axis = 0; axis < 3; ++axis)
            c[axis] = whole_number<std::int64_t>(std::floor(p[axis] / cell_));
        return c;
    }
    /// A key of bits_ bits: the hash of the block, then the index of the cell in the block.
    std::size_t share(const Cell& c) const {
        constexpr int side_bits = 3, place_bits = 3 * side_bits;
        std::uint64_t hash = 0, place = 0;
        for (const std::int64_t x : c) {
            hash = hashed(hash, static_cast<std::uint64_t>(x >> side_bits));
            place = place << side_bits | (static_cast<std::uint64_t>(x) & ((1u << side_bits) - 1));
        }
        return (hash << place_bits ^ place) & ((std::uint64_t{1} << bits_) - 1);
    }

    double cell_;
    int bits_ = 0;
    std::vector<Index> begins_;
    std::vector<Vec3> points_;
};

/// A cell size with few surface points per cell, large enough that cell indices fit an integer.
double cell_of_few(const std::vector<Vec3>& points) {
    Box box;
    for (const Vec3& p : points) box.add(p);
    const double share = 2 * box.longest_side() / std::sqrt(static_cast<double>(points.size()));
    return std::max(share, 1e-15 * std::max(length(box.min), length(box.max)));
}

/// Raises `most` to the largest distance from the points to their nearest neighbours in the grid. Returns
/// the points without a neighbour in reach; the last grid leaves none.
std::vector<Vec3> farther(std::span<const Vec3> points, const Grid& grid, bool is_last, double& most) {
    std::vector<std::uint8_t> is_open(points.size());
    most = parallel_reduce(
        points.size(), most,
        [&](std::size_t begin, std::size_t end) {
            double enough = most;
            for (std::size_t i = begin; i < end; ++i) {
                const double d = grid.nearest(points[i], enough);
                is_open[i] = d > enough && d > grid.cell() / 2 && !is_last;
                if (!is_open[i]) enough = std::max(enough, d);
            }
            return enough;
        },
        [](double a, double b) { return std::max(a, b); });
    std::vector<Vec3> open;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (is_open[i]) open.push_back(points[i]);
    return open;
}

/// The Hausdorff distance of two point sets; a value above the tolerance, or infinity, if it is larger.
/// Small cells come first and larger cells later, because cells of the tolerance's size might hold all
/// points at large coordinates.
double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double tolerance) {
    if (a.empty() && b.empty()) return 0;
    const double largest_cell = std::max(2.5 * tolerance, 1e-300);
    double cell = a.empty() || b.empty() ? largest_cell : std::max(cell_of_few(a), cell_of_few(b));
    if (!(cell > 0 && cell < largest_cell)) cell = largest_cell; // NaN, too
    double most = 0;
    std::vector<Vec3> open_a, open_b;
    for (bool is_first = true;; is_first = false, cell = std::min(8 * cell, largest_cell)) {
        const Grid grid_a(a, cell), grid_b(b, cell);
        const bool is_last = cell >= largest_cell;
        // The first pass takes all points in grid order, which suits the memory order of the other grid.
        open_a = farther(is_first ? grid_a.points() : open_a, grid_b, is_last, most);
        open_b = farther(is_first ? grid_b.points() : open_b, grid_a, is_last, most);
        if (open_a.empty() && open_b.empty()) return most;
    }
}

/// most: the largest allowed displacement of a point. in_order: the limit up to which equal indices mean the
/// same point; beyond it, the file may have another order. `most` allows for nodes far from the origin,
/// where it may exceed the size of the mesh.
struct Tolerances {
    double most = 0, in_order = 0;
};

/// Like position_error, for the ends of lines.
double error_of_lines(const Flat& wanted, const Flat& found, const Tolerances& tolerances) {
    if (wanted.ends.size() == found.ends.size()) {
        const double in_order = largest(wanted.ends.size(), tolerances.in_order, [&](std::size_t i) {
            return length(wanted.ends[i] - found.ends[i]);
        });
        if (in_order <= tolerances.in_order) return in_order;
    }
    return farthest(wanted.ends, found.ends, tolerances.most);
}

/// The largest displacement of a corner or, if the format reorders faces, of a point in either direction.
double position_error(const Flat& wanted, const Flat& found, const Tolerances& tolerances) {
    if (wanted.corners.size() == found.corners.size() && !wanted.corners.empty()) {
        const double in_order = largest(wanted.corners.size(), tolerances.in_order, [&](std::size_t c) {
            return length(wanted.points[wanted.corners[c]] - found.points[found.corners[c]]);
        });
        if (in_order <= tolerances.in_order) return in_order;
    }
    return farthest(wanted.used(), found.used(), tolerances.most);
}

/// The largest displacement that the format allows. Three terms add up. The first is float32 rounding of the
/// largest coordinate, twice, because of a node's transform. The second is half a grid step in every
/// direction (Draco or quantized positions). The third is the rounding of instance transforms. transforms:
/// the file has the parts' own coordinates.
Tolerances set_tolerance(ReadBack& back, const Scene& scene, const WriteSettings& settings, bool transforms) {
    Box world;
    double largest = 0;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        Box own;
        const Transform to_world = part.transform;
        for (const Vec3& p : part.mesh.positions) {
            own.add(p);
            world.add(to_world.point(p));
        }
        if (own.empty()) continue;
        double scale = 0; // an upper bound of the world length of the part's unit
        for (const auto& row : to_world.m)
            for (int c = 0; c < 3; ++c) scale += row[c] * row[c];
        const double reach = std::max(length(own.min), length(own.max)) * std::sqrt(scale);
        largest = std::max(largest, reach);
        if (transforms)
            back.float_step = std::max(back.float_step, float32_ulp(own) * greatest_stretch(to_world));
        if (settings.grid_bits(i) > 0) {
            const double range = own.longest_side();
            const auto steps = static_cast<double>((std::int64_t{1} << settings.grid_bits(i)) - 1);
            const double step = std::max(range / steps, settings.lattice(i).step);
            back.grid_step = std::max(back.grid_step, step * std::sqrt(scale));
        }
    }
    if (!world.empty()) {
        largest = std::max({largest, length(world.min), length(world.max)});
        back.diagonal = length(world.extent());
    }
    if (!transforms) back.float_step = float32_ulp(world);
    // Half a step times the square root of three, and a margin for rounding.
    constexpr double float_step = 1.0 / (1 << 23);
    double of_places = 0;
    for (const double error : errors_of_instances(scene, settings.meshopt.on && settings.meshopt.filters))
        of_places = std::max(of_places, error);
    back.tolerance = 2 * largest * float_step + back.grid_step + of_places;
    // Float rounding along three axes with a margin, and double rounding in world space.
    const double in_order = 4 * back.float_step + 0x1p-50 * largest + back.grid_step + of_places;
    return {back.tolerance, std::min(in_order, back.tolerance)};
}

/// The frame of the mesh's box in the world. A grid of positions in the transform does not change it.
std::array<Vec3, 4> frame_of(const Box& box, const Transform& to_world) {
    const Vec3 size = box.extent();
    return {to_world.point(box.min), to_world.vector({size.x, 0, 0}), to_world.vector({0, size.y, 0}),
            to_world.vector({0, 0, size.z})};
}

double distance_of(const std::array<Vec3, 4>& a, const std::array<Vec3, 4>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i] - b[i], a[i] - b[i]);
    return sum;
}

/// Rounding may make another one of nearly equal instances the largest. Parts with instances then move to the
/// instance of the scene that was written.
void stand_at_written_instances(Scene& back, const Scene& scene) {
    const bool same = back.parts.size() == scene.parts.size();
    std::vector<PartView> views;             // found only when there are instances
    std::vector<std::array<Vec3, 4>> wanted; // [scene.parts]
    std::vector<std::optional<Box>> boxes(back.parts.size());
    std::vector<double> nearest(back.parts.size(), HUGE_VAL);
    std::vector<Transform> places(back.parts.size());
    const auto compare = [&](std::size_t part, const Transform& place, std::size_t with) {
        const double d = distance_of(frame_of(*boxes[part], place), wanted[with]);
        if (!(d < nearest[part])) return;
        nearest[part] = d;
        places[part] = place;
    };
    for_each_place_of_instances(back, [&](std::size_t part, const Transform& place, double) {
        if (views.empty()) {
            views = part_views(scene);
            wanted.reserve(views.size());
            for (const Part& p : scene.parts) wanted.push_back(frame_of(drawn_box(p.mesh), p.transform));
        }
        if (!boxes[part]) boxes[part] = drawn_box(back.parts[part].mesh);
        if (same && views[part].instanced) return compare(part, place, part);
        for (std::size_t i = 0; i < views.size(); ++i)
            if (views[i].instanced) compare(part, place, i);
    });
    for (std::size_t i = 0; i < nearest.size(); ++i)
        if (nearest[i] < HUGE_VAL) back.parts[i].transform = places[i];
}

/// A property that a file should keep: a truth, or a count of defects.
bool should_stay(const Property& property) { return property.soundness != Soundness::none; }

/// Whether every truth holds and no defects are counted, so that no loss is possible.
bool is_sound(const Properties& properties) {
    const auto all = property_table();
    return std::all_of(all.begin(), all.end(), [&](const Property& p) {
        return !should_stay(p) || (p.get(properties).value_or(0) != 0) == p.truth();
    });
}

std::vector<std::string> losses(const Properties& before, const Properties& after) {
    std::vector<std::string> lost;
    for (const Property& p : property_table()) {
        if (!should_stay(p)) continue;
        const double was = p.get(before).value_or(0), is = p.get(after).value_or(0);
        if (p.truth() && was != 0 && is == 0) lost.push_back(fmt::format("no longer {}", p.name));
        if (!p.truth() && is > was) lost.push_back(fmt::format("{} {} (before: {})", is, p.name, was));
    }
    return lost;
}

/// The scene for triangle formats, which fill faces that cross themselves (triangles_of).
std::optional<Scene> with_filled_faces(const Scene& scene) {
    std::optional<Scene> filled;
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
        if (auto faces = fill_crossing_faces(scene.parts[i].mesh); faces.mesh) {
            if (!filled) filled = scene;
            filled->parts[i].mesh = std::move(*faces.mesh);
        }
    return filled;
}

} // namespace

bool ReadBack::too_far_for_floats() const {
    constexpr double tolerable = 1e-6; // times the diagonal
    // An error within the grid step comes from the grid, because a grid in the node's transform avoids
    // float32.
    return position_error > tolerable * diagonal && position_error > grid_step && float_step > grid_step;
}

Json ReadBack::json() const {
    Json all = {{"vertices", vertices}, {"faces", faces}, {"position_error", position_error}};
    if (lines > 0) all["lines"] = lines;
    for (const Property& p : property_table()) {
        if (!should_stay(p)) continue;
        const double value = p.get(soundness).value_or(0);
        const std::string name(p.name);
        if (p.truth())
            all[name] = value != 0;
        else
            all[name] = static_cast<std::int64_t>(value);
    }
    if (second.reader.empty()) return all;
    all["second_reader"] = second.not_asked.empty() ? second.reader + " reads the same"
                                                    : fmt::format("not asked: {}", second.not_asked);
    return all;
}

ReadBack read_back(const Input& file, const Codec& codec, const Scene& given, const WriteSettings& settings,
                   const Written& written) {
    const std::size_t dropped_faces = written.dropped_faces;
    const std::optional<Scene> filled = codec.can.polygons ? std::nullopt : with_filled_faces(given);
    const Scene& scene = filled ? *filled : given;
    ReadBack back;
    const auto refuse = [&](std::string message) {
        throw Error(ErrorKind::output, "E-READBACK",
                    fmt::format("'{}' differs from the data that was written: {}", file.name(), message),
                    "this is a bug in facetmill or a fault of the disk; existing outputs are unchanged");
    };
    ProgressSteps steps({4, 1, 5});
    ReadLog log;
    ReadSettings how;
    how.decoded = written.decoded.get();
    try {
        back.scene = read_scene(file, how, log, &codec);
    } catch (const Error& error) {
        refuse(error.diagnostics().front().message);
    }
    if (codec.read_again) back.second = codec.read_again(file, back.scene);
    if (!back.second.differences.empty())
        refuse(fmt::format("{} reads different contents than facetmill: {}", back.second.reader,
                           fmt::join(back.second.differences, "; ")));
    std::size_t polygons = 0, triangles = 0, lines = 0;
    for (const auto& part : scene.parts) {
        lines += part.mesh.line_count();
        polygons += part.mesh.face_count();
        triangles += part.mesh.corner_count() - 2 * part.mesh.face_count();
    }
    triangles -= dropped_faces;
    if (dropped_faces > 0) polygons = triangles;
    for (const auto& part : back.scene.parts) {
        back.vertices += part.mesh.vertex_count();
        back.lines += part.mesh.line_count();
    }
    if (back.lines != lines) refuse(fmt::format("{}, expected {}", counted(back.lines, "line"), lines));
    back.faces = back.scene.face_count();
    if (back.faces != polygons && back.faces != triangles)
        refuse(fmt::format("{}, expected {}", counted(back.faces, "face"),
                           polygons == triangles ? fmt::format("{}", polygons)
                                                 : fmt::format("{} (or {} triangles)", polygons, triangles)));
    steps.next();
    if (codec.can.transforms) stand_at_written_instances(back.scene, scene);
    const Tolerances tolerances = set_tolerance(back, scene, settings, codec.can.transforms);
    const Flat wanted(scene, dropped_faces == 0), found(back.scene);
    back.position_error =
        std::max(position_error(wanted, found, tolerances), error_of_lines(wanted, found, tolerances));
    if (back.position_error > back.tolerance)
        refuse(fmt::format("a vertex moved farther than {}", back.tolerance));
    steps.next();
    back.soundness = inspect(back.scene);
    if (!is_sound(back.soundness)) back.losses = losses(inspect(scene), back.soundness);
    if (!back.losses.empty()) back.changes = vertex_changes(scene, back.scene);
    return back;
}

} // namespace facetmill::io
