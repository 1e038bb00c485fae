// Measures charts of texture coordinates: mirrored faces, texel density, and gaps between charts.
#include "geometry/inspect/measures.hpp"
#include "geometry/polygon/polygon.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill::inspect_room {

namespace {

/// The texture coordinates of the faces that have some.
class FaceCoordinates {
  public:
    explicit FaceCoordinates(const Mesh& mesh) : mesh_(mesh), uv_(mesh.find("TEXCOORD_0", Domain::wedge)) {
        if (uv_ && uv_->components < 2) uv_ = nullptr;
    }
    bool any() const { return uv_ && mesh_.face_count() > 0; }
    bool has(Index f) const {
        return mesh_.primitives.empty() || mesh_.primitives[mesh_.primitive_of(f)].has("TEXCOORD_0");
    }
    Vec2 at(Index corner) const {
        return {uv_->value(mesh_.corners[corner], 0), uv_->value(mesh_.corners[corner], 1)};
    }
    /// The corners of a face in the texture; empty if it has no finite coordinates.
    void ring(Index f, std::vector<Vec2>& points) const {
        points.clear();
        if (!has(f)) return;
        for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
            points.push_back(at(c));
            if (!std::isfinite(points.back().x) || !std::isfinite(points.back().y)) return points.clear();
        }
    }

  private:
    const Mesh& mesh_;
    const Attribute* uv_;
};

/// A border edge of a chart in the texture.
struct ChartEdge {
    Vec2 a, b;
    Index chart;
};

double distance_to_segment(const Vec2& p, const ChartEdge& e) {
    const Vec2 d = e.b - e.a;
    const double dd = dot(d, d), t = dd > 0 ? std::clamp(dot(p - e.a, d) / dd, 0.0, 1.0) : 0;
    return length(p - (e.a + d * t));
}

bool crosses(const ChartEdge& e, const ChartEdge& f) {
    const auto side = [](const ChartEdge& g, const Vec2& p) { return cross(g.b - g.a, p - g.a); };
    return side(e, f.a) * side(e, f.b) < 0 && side(f, e.a) * side(f, e.b) < 0;
}

double distance_between(const ChartEdge& e, const ChartEdge& f) {
    if (crosses(e, f)) return 0;
    return std::min({distance_to_segment(e.a, f), distance_to_segment(e.b, f), distance_to_segment(f.a, e),
                     distance_to_segment(f.b, e)});
}

/// The borders of charts. Faces are in the same chart if they share an edge with the same coordinates.
std::vector<ChartEdge> chart_borders(const Mesh& mesh, const FaceCoordinates& uv) {
    const EdgeTable table = build_edges(mesh);
    const auto face_of = corner_faces(mesh);
    DisjointSets charts(mesh.face_count());
    std::vector<std::uint8_t> inner(mesh.corner_count());
    for (Index e = 0; e < table.size(); ++e) {
        const auto corners = table.corners_of(e);
        for (std::size_t i = 0; i < corners.size() && corners.size() <= 8; ++i)
            for (std::size_t j = i + 1; j < corners.size(); ++j) {
                Index a = corners[i], b = next_corner(mesh, face_of[a], a), c = corners[j],
                      d = next_corner(mesh, face_of[c], c);
                if (mesh.vertex(a) != mesh.vertex(c)) std::swap(c, d);
                if (!uv.has(face_of[a]) || !uv.has(face_of[c]) || !(uv.at(a) == uv.at(c)) ||
                    !(uv.at(b) == uv.at(d)))
                    continue;
                charts.join(face_of[corners[i]], face_of[corners[j]]);
                inner[corners[i]] = inner[corners[j]] = 1;
            }
    }
    std::vector<ChartEdge> borders;
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        const Index f = face_of[c];
        if (inner[c] || !uv.has(f)) continue;
        const ChartEdge edge{uv.at(c), uv.at(next_corner(mesh, f, c)), charts.find(f)};
        const Vec2 sum = edge.a + edge.b;
        if (std::isfinite(sum.x) && std::isfinite(sum.y)) borders.push_back(edge);
    }
    return borders;
}

} // namespace

std::vector<Index> mirrored_faces(const Mesh& mesh) {
    const FaceCoordinates uv(mesh);
    std::vector<Index> found;
    std::vector<Vec2> ring;
    for (Index f = 0; f < mesh.face_count() && uv.any(); ++f) {
        uv.ring(f, ring);
        // v runs down in glTF, so a face that runs anticlockwise there is mirrored.
        if (!ring.empty() && polygon::orientation(ring) > 0) found.push_back(f);
    }
    return found;
}

std::optional<double> count_mirrored_faces(const Measured& m) {
    if (!FaceCoordinates(m.local).any()) return {};
    return static_cast<double>(mirrored_faces(m.local).size());
}

std::optional<double> texel_density_ratio(const Measured& m) {
    const FaceCoordinates uv(m.local);
    if (!uv.any()) return {};
    struct Density {
        double squared, area;
    };
    std::vector<Density> faces;
    faces.reserve(m.local.face_count());
    std::vector<Vec2> ring;
    double all = 0;
    for (Index f = 0; f < m.local.face_count(); ++f) {
        uv.ring(f, ring);
        const double area = length(area_vector(m.world, f)) / 2;
        if (ring.empty() || !(area > 0) || !std::isfinite(area)) continue;
        faces.push_back({std::abs(polygon::signed_area(ring)) / area, area});
        all += area;
    }
    if (faces.empty()) return {};
    std::stable_sort(faces.begin(), faces.end(),
                     [](const Density& a, const Density& b) { return a.squared < b.squared; });
    // The densities that a hundredth of the area lies below, and above.
    const auto after = [&](double share) {
        double sum = 0;
        for (const Density& d : faces)
            if ((sum += d.area) > share * all) return d.squared;
        return faces.back().squared;
    };
    const double low = after(0.01), high = after(0.99);
    return low > 0 ? std::sqrt(high / low) : HUGE_VAL;
}

std::optional<double> smallest_uv_gap(const Measured& m) {
    const FaceCoordinates uv(m.local);
    if (!uv.any()) return {};
    const std::vector<ChartEdge> borders = chart_borders(m.local, uv);
    std::vector<Box> boxes(borders.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (const Vec2& p : {borders[i].a, borders[i].b}) boxes[i].add(Vec3{p.x, p.y, 0});
    const BoxTree tree(boxes);
    // Widens the search until it finds a gap that is smaller than its reach.
    for (double reach = 1.0 / 4096; reach < 4; reach *= 4) {
        const double least = parallel_reduce(
            borders.size(), HUGE_VAL,
            [&](std::size_t begin, std::size_t end) {
                double best = reach;
                for (std::size_t i = begin; i < end; ++i) {
                    Box box = boxes[i];
                    box.min -= Vec3{best, best, 0};
                    box.max += Vec3{best, best, 0};
                    tree.visit(box, [&](Index other) {
                        if (borders[other].chart != borders[i].chart)
                            best = std::min(best, distance_between(borders[i], borders[other]));
                    });
                }
                return best < reach ? best : HUGE_VAL;
            },
            [](double a, double b) { return std::min(a, b); }, 1024);
        if (least < reach) return least;
    }
    return {};
}

} // namespace facetmill::inspect_room
