#include "geometry/deviation/signed_deviation.hpp"

#include "geometry/cut/cap_paint.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/spatial/signed_distances.hpp"
#include "mesh/finite_box.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace facetmill {

namespace {

/// The faces of the parts, without attributes.
Scene bare(const Scene& scene) {
    Scene out;
    out.unit = scene.unit;
    out.up = scene.up;
    for (const Part& part : scene.parts) {
        Part& copy = out.parts.emplace_back();
        copy.name = part.name;
        copy.transform = part.transform;
        copy.mesh.positions = part.mesh.positions;
        copy.mesh.wedge_vertex = part.mesh.wedge_vertex;
        copy.mesh.corners = part.mesh.corners;
        copy.mesh.face_offsets = part.mesh.face_offsets;
    }
    return out;
}

/// Removes the caps from the mesh and returns them. The mesh keeps vertices that no cap uses.
Mesh taken_caps(Mesh& mesh, const std::vector<std::uint8_t>& is_cap_face) {
    Mesh caps, others;
    std::vector<std::uint8_t> of_caps(mesh.vertex_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const bool is_cap = is_cap_face[f] != 0;
        add_face(is_cap ? caps : others, mesh.face_wedges(f));
        for (Index c = mesh.face_begin(f); is_cap && c < mesh.face_end(f); ++c) of_caps[mesh.vertex(c)] = 1;
    }
    caps.positions = mesh.positions;
    caps.wedge_vertex = mesh.wedge_vertex;
    drop_unused(caps);
    mesh.corners = std::move(others.corners);
    mesh.face_offsets = std::move(others.face_offsets);
    drop_unused(mesh, of_caps);
    return caps;
}

/// Removes the caps from all parts and returns them as parts. given: the scene that `bare` was made from.
std::vector<Part> taken_caps(Scene& bare, const Scene& given, Index last) {
    std::vector<Part> all;
    for (std::size_t i = 0; i < given.parts.size(); ++i) {
        const auto is_cap = later_caps(given.parts[i].mesh, last);
        if (is_cap.empty()) continue;
        Part caps;
        caps.name = bare.parts[i].name;
        caps.transform = bare.parts[i].transform;
        caps.mesh = taken_caps(bare.parts[i].mesh, is_cap);
        all.push_back(std::move(caps));
    }
    return all;
}

/// Cuts triangles into n x n triangles with world edges of at most `longest`, while few points are added.
class Cutter {
  public:
    explicit Cutter(double longest) : longest_(longest) {}

    /// Cuts a part. Returns whether any triangle was cut.
    bool operator()(Part& part) {
        const Surface surface = surface_of(part.mesh);
        bool any = false;
        std::vector<Index> corners, faces; // corners, and source of each new face
        Mesh& mesh = part.mesh;
        for (std::size_t t = 0; t < surface.size(); ++t) {
            const Index* c = &surface.corners[3 * t];
            const std::size_t n =
                pieces(part.transform, mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]);
            any |= n > 1;
            if (n > 1)
                cut(mesh, {c[0], c[1], c[2]}, n, corners);
            else
                corners.insert(corners.end(), c, c + 3);
            faces.insert(faces.end(), n * n, surface.face(t));
        }
        if (!any) return false;
        std::erase_if(mesh.attributes, [](const Attribute& a) { return a.domain != Domain::face; });
        for (Attribute& a : mesh.attributes) a.select(faces);
        mesh.corners = std::move(corners);
        mesh.face_offsets.clear();
        mesh.wedge_vertex.clear();
        return true;
    }

  private:
    std::size_t pieces(const Transform& t, const Vec3& a, const Vec3& b, const Vec3& c) const {
        constexpr double most = 24;
        constexpr std::size_t most_points = 40000;
        const double edge =
            std::max({length(t.vector(b - a)), length(t.vector(c - b)), length(t.vector(a - c))});
        if (!(edge > longest_) || !std::isfinite(edge) || added_ > most_points) return 1;
        return static_cast<std::size_t>(std::ceil(std::min(most, edge / longest_)));
    }

    /// Adds points in rows from the first corner to the opposite edge.
    void cut(Mesh& mesh, const std::array<Index, 3>& c, std::size_t n, std::vector<Index>& corners) {
        const Vec3 a = mesh.positions[c[0]], b = mesh.positions[c[1]], d = mesh.positions[c[2]];
        const auto share = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(n); };
        std::vector<Index> before{c[0]}, row;
        for (std::size_t i = 1; i <= n; ++i) {
            row.clear();
            for (std::size_t k = 0; k <= i; ++k) {
                if (i == n && (k == 0 || k == n)) {
                    row.push_back(c[k == 0 ? 1 : 2]);
                    continue;
                }
                row.push_back(static_cast<Index>(mesh.positions.size()));
                mesh.positions.push_back(a + (b - a) * share(i - k) + (d - a) * share(k));
                ++added_;
            }
            for (std::size_t k = 0; k < i; ++k) {
                corners.insert(corners.end(), {before[k], row[k], row[k + 1]});
                if (k + 1 < i) corners.insert(corners.end(), {before[k], row[k + 1], before[k + 1]});
            }
            before.swap(row);
        }
    }

    double longest_;
    std::size_t added_ = 0;
};

/// The vertices of all parts, in the world.
std::vector<Vec3> vertices_of(const Scene& scene) {
    std::vector<Vec3> points;
    for (const Part& part : scene.parts) {
        const std::size_t first = points.size();
        points.resize(first + part.mesh.vertex_count());
        parallel_for(part.mesh.vertex_count(), [&](std::size_t v) {
            points[first + v] = part.transform.point(part.mesh.positions[v]);
        });
    }
    return points;
}

struct Cell {
    std::uint64_t key;
    Index vertex;
};

/// Sorts points into grid cells, 112 along the longest side, so that a cell is two or three pixels of a
/// picture. Points that are not finite are in the last cell.
std::vector<Cell> cells_of(const std::vector<Vec3>& points, const Box& box) {
    constexpr double along = 111;
    constexpr int bits = 8; // bits of each coordinate
    constexpr std::uint64_t none_of_them = std::uint64_t{1} << 3 * bits;
    const double longest = box.longest_side();
    const double scale = longest > 0 ? along / longest : 0;
    std::vector<Cell> cells(points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        const Vec3 p = (points[i] - box.min) * scale;
        const auto at = [](double x) { return static_cast<std::uint64_t>(x); };
        cells[i] = {is_finite(p) ? at(p.x) << 2 * bits | at(p.y) << bits | at(p.z) : none_of_them,
                    static_cast<Index>(i)};
    });
    radix_sort(
        cells, [](const Cell& cell) { return cell.key; }, 3 * bits + 1);
    return cells;
}

/// Distances of many vertices: looks up one vertex of each cell, and all vertices near the farthest.
class Reduced {
  public:
    Reduced(const FaceTree& tree, const std::vector<Vec3>& points) : tree_(tree), points_(points) {}

    std::vector<float> distances(std::size_t& looked_up) {
        const Box box = box_of_finite(points_.size(), [&](std::size_t i) { return points_[i]; });
        const auto cells = cells_of(points_, box);
        std::vector<Index> first; // first vertex of each cell
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (i == 0 || cells[i].key != cells[i - 1].key) first.push_back(cells[i].vertex);
        const auto of_cells = look_up(first, looked_up);
        std::vector<float> all(points_.size());
        std::size_t cell = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (i > 0 && cells[i].key != cells[i - 1].key) ++cell;
            all[cells[i].vertex] = of_cells[cell];
        }
        const auto around = neighbours_of_farthest(first, of_cells, box.diagonal() / 24);
        const auto exact = look_up(around, looked_up);
        for (std::size_t i = 0; i < around.size(); ++i) all[around[i]] = exact[i];
        return all;
    }

  private:
    std::vector<float> look_up(const std::vector<Index>& vertices, std::size_t& looked_up) const {
        std::vector<Vec3> asked(vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) asked[i] = points_[vertices[i]];
        looked_up += asked.size();
        return signed_distances(tree_, asked);
    }

    std::vector<Index> neighbours_of_farthest(const std::vector<Index>& vertices,
                                              const std::vector<float>& distances, double reach) const {
        constexpr std::size_t most = 30000;
        std::size_t worst = 0;
        for (std::size_t i = 0; i < distances.size(); ++i)
            if (!(std::abs(distances[i]) <= std::abs(distances[worst])) && !std::isnan(distances[i]))
                worst = i;
        std::vector<Index> around;
        const Vec3 centre = points_[vertices[worst]];
        for (std::size_t v = 0; v < points_.size() && around.size() < most; ++v)
            if (length(points_[v] - centre) <= reach) around.push_back(static_cast<Index>(v));
        return around;
    }

    const FaceTree& tree_;
    const std::vector<Vec3>& points_;
};

/// Updates the extremes with these distances.
void add_extremes(SignedDeviation& out, std::span<const Vec3> points, const std::vector<float>& distances) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = distances[i];
        if (std::isnan(d)) continue;
        out.low = std::min(out.low, d);
        out.high = std::max(out.high, d);
        if (std::abs(d) > std::abs(out.worst_distance)) {
            out.worst = points[i];
            out.worst_distance = d;
        }
    }
}

/// The sum of the area vectors of the triangles that contain the worst point.
Vec3 worst_normal(const Surface& surface, const std::vector<SurfaceSample>& samples, const Vec3& worst) {
    Vec3 sum;
    const auto add = [&](std::size_t t) {
        const Vec3& first = surface.point(t, 0);
        sum += cross(surface.point(t, 1) - first, surface.point(t, 2) - first);
    };
    for (const SurfaceSample& sample : samples)
        if (sample.point == worst) add(sample.triangle);
    for (std::size_t t = 0; t < surface.size(); ++t)
        if (surface.point(t, 0) == worst || surface.point(t, 1) == worst || surface.point(t, 2) == worst)
            add(t);
    return sum;
}

void put_distances(Scene& scene, const std::vector<float>& distances) {
    std::size_t first = 0;
    for (Part& part : scene.parts) {
        const auto begin = distances.begin() + static_cast<std::ptrdiff_t>(first);
        first += part.mesh.vertex_count();
        std::vector<float> own(begin, distances.begin() + static_cast<std::ptrdiff_t>(first));
        part.mesh.attributes.push_back(
            {std::string(distance_attribute), Domain::vertex, Role::generic, 1, false, std::move(own)});
    }
}

void add_means(SignedDeviation& out) {
    double sum = 0, squares = 0;
    std::erase_if(out.samples, [](float d) { return std::isnan(d); });
    for (const double d : out.samples) {
        sum += std::abs(d);
        squares += d * d;
    }
    if (out.samples.empty()) return;
    const auto count = static_cast<double>(out.samples.size());
    out.mean = sum / count;
    out.rms = std::sqrt(squares / count);
}

} // namespace

bool cut_large_faces(Scene& scene, double diagonal) {
    constexpr double along_diagonal = 64; // pieces along the diagonal, each a few pixels of a picture
    Cutter cut(diagonal / along_diagonal);
    bool any = false;
    for (Part& part : scene.parts) any |= cut(part);
    return any;
}

Index last_cap(const Scene& scene) {
    Index last = 0;
    for (const Part& part : scene.parts) last = std::max(last, largest_number(part.mesh, cut_id_attribute));
    return last;
}

SignedDeviation signed_deviation(const Scene& scene, const FaceTree& reference,
                                 const SignedDeviationSettings& settings) {
    SignedDeviation out;
    if (reference.empty() || scene.parts.empty()) return out;
    out.scene = bare(scene);
    std::vector<Part> caps;
    if (settings.last_cap) caps = taken_caps(out.scene, scene, *settings.last_cap);
    for (const Part& part : caps) out.caps += part.mesh.face_count();
    out.is_cut = cut_large_faces(out.scene, scene.bounds().diagonal());
    const std::vector<Vec3> points = vertices_of(out.scene);
    if (points.empty()) return out;
    std::vector<float> distances;
    if (points.size() <= settings.vertices) {
        distances = signed_distances(reference, points);
        out.looked_up = points.size();
    } else {
        distances = Reduced(reference, points).distances(out.looked_up);
    }
    add_extremes(out, points, distances);
    const Surface surface = surface_of(out.scene);
    const auto samples = sample_area(surface, settings.samples, settings.seed);
    std::vector<Vec3> spread;
    spread.reserve(samples.size());
    for (const SurfaceSample& sample : samples) spread.push_back(sample.point);
    out.looked_up += spread.size();
    out.samples = spread.empty() ? distances : signed_distances(reference, spread);
    if (!spread.empty()) add_extremes(out, spread, out.samples);
    out.worst_normal = worst_normal(surface, samples, out.worst);
    put_distances(out.scene, distances);
    add_means(out);
    std::move(caps.begin(), caps.end(), std::back_inserter(out.scene.parts));
    return out;
}

} // namespace facetmill
