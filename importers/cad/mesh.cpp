#include "mesh.hpp"

#include <BRep_Tool.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom_Surface.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <cmath>

namespace importers {

namespace {

/// Sets of points that are the same point.
class Unions {
  public:
    std::size_t make() {
        parent_.push_back(parent_.size());
        return parent_.size() - 1;
    }
    std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// The smaller number stays, so the result does not depend on the order.
    void join(std::size_t a, std::size_t b) {
        a = root(a);
        b = root(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::size_t> parent_;
};

struct TriangulatedFace {
    TopoDS_Face face;
    Handle(Poly_Triangulation) triangles;
    TopLoc_Location place;
    std::size_t first = 0; ///< the number of its first node
};

class Welder {
  public:
    explicit Welder(const TopoDS_Shape& shape) {
        TopExp::MapShapes(shape, TopAbs_EDGE, edges_);
        TopExp::MapShapes(shape, TopAbs_VERTEX, vertices_);
        edge_points_.resize(static_cast<std::size_t>(edges_.Extent()) + 1);
        vertex_points_.resize(static_cast<std::size_t>(vertices_.Extent()) + 1, unknown);
        for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) add(TopoDS::Face(at.Current()));
        for (const TriangulatedFace& face : faces) join_edges(face);
    }

    std::vector<TriangulatedFace> faces;
    std::size_t missing = 0;   ///< faces without triangles
    std::size_t different = 0; ///< edges whose faces divide them differently

    /// The position of a node: that of the first node of its set.
    const gp_Pnt& position(std::size_t node) { return points_[unions_.root(node)]; }
    std::size_t set(std::size_t node) { return unions_.root(node); }

  private:
    static constexpr std::size_t unknown = SIZE_MAX;

    void add(const TopoDS_Face& face) {
        TriangulatedFace one{face, {}, {}, points_.size()};
        one.triangles = BRep_Tool::Triangulation(face, one.place);
        if (one.triangles.IsNull() || one.triangles->NbTriangles() == 0) {
            ++missing;
            return;
        }
        for (int n = 1; n <= one.triangles->NbNodes(); ++n) {
            (void)unions_.make();
            points_.push_back(one.triangles->Node(n).Transformed(one.place.Transformation()));
        }
        faces.push_back(one);
    }

    void join_vertex(const TopoDS_Vertex& vertex, std::size_t node) {
        const int index = vertex.IsNull() ? 0 : vertices_.FindIndex(vertex);
        if (index == 0) return;
        std::size_t& known = vertex_points_[static_cast<std::size_t>(index)];
        if (known == unknown) known = node;
        unions_.join(known, node);
    }

    void join_edges(const TriangulatedFace& face) {
        for (TopExp_Explorer at(face.face, TopAbs_EDGE); at.More(); at.Next()) {
            const TopoDS_Edge edge = TopoDS::Edge(at.Current());
            const auto polygon = BRep_Tool::PolygonOnTriangulation(edge, face.triangles, face.place);
            const int index = edges_.FindIndex(edge);
            if (polygon.IsNull() || index == 0) continue;
            std::vector<std::size_t> nodes;
            nodes.reserve(static_cast<std::size_t>(polygon->NbNodes()));
            for (int i = 1; i <= polygon->NbNodes(); ++i)
                nodes.push_back(face.first + static_cast<std::size_t>(polygon->Node(i)) - 1);
            join_edge(edge, nodes, edge_points_[static_cast<std::size_t>(index)]);
        }
    }

    void join_edge(const TopoDS_Edge& edge, const std::vector<std::size_t>& nodes,
                   std::vector<std::size_t>& known) {
        if (nodes.empty()) return;
        const TopoDS_Edge forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
        join_vertex(TopExp::FirstVertex(forward), nodes.front());
        join_vertex(TopExp::LastVertex(forward), nodes.back());
        if (BRep_Tool::Degenerated(edge))
            for (const std::size_t node : nodes) unions_.join(nodes.front(), node);
        if (known.empty()) known = nodes;
        if (known.size() != nodes.size()) {
            ++different;
            return;
        }
        for (std::size_t i = 0; i < nodes.size(); ++i) unions_.join(known[i], nodes[i]);
    }

    TopTools_IndexedMapOfShape edges_, vertices_;
    std::vector<std::vector<std::size_t>> edge_points_; ///< [edge] its nodes in the first face
    std::vector<std::size_t> vertex_points_;
    std::vector<gp_Pnt> points_;
    Unions unions_;
};

/// [node - 1] the normals of the surface; where it has none, the mean of the triangles.
std::vector<gp_Vec> normals_of(const TriangulatedFace& face) {
    const auto& triangles = *face.triangles;
    std::vector<gp_Vec> means(static_cast<std::size_t>(triangles.NbNodes()));
    for (int t = 1; t <= triangles.NbTriangles(); ++t) {
        std::array<int, 3> n{};
        triangles.Triangle(t).Get(n[0], n[1], n[2]);
        const gp_Vec area = gp_Vec(triangles.Node(n[0]), triangles.Node(n[1])) ^
                            gp_Vec(triangles.Node(n[0]), triangles.Node(n[2]));
        for (const int i : n) means[static_cast<std::size_t>(i) - 1] += area;
    }
    const bool reversed = face.face.Orientation() == TopAbs_REVERSED;
    TopLoc_Location surface_place;
    const Handle(Geom_Surface) local = BRep_Tool::Surface(face.face, surface_place);
    for (int n = 1; n <= triangles.NbNodes(); ++n) {
        gp_Vec& normal = means[static_cast<std::size_t>(n) - 1];
        if (!local.IsNull() && triangles.HasUVNodes()) {
            const gp_Pnt2d uv = triangles.UVNode(n);
            constexpr double resolution = 1e-9;
            GeomLProp_SLProps at(local, uv.X(), uv.Y(), 1, resolution);
            if (at.IsNormalDefined()) normal = gp_Vec(at.Normal());
        }
        if (reversed) normal.Reverse();
        normal.Transform(face.place.Transformation());
        const double size = normal.Magnitude();
        normal = size > 0 ? normal / size : gp_Vec(0, 0, 1);
    }
    return means;
}

/// The deviation of one triangle of a face from the surface.
double deviation_of(const Poly_Triangulation& triangles, int t, const Handle(Geom_Surface) & surface) {
    std::array<int, 3> n{};
    triangles.Triangle(t).Get(n[0], n[1], n[2]);
    std::array<gp_XY, 3> uv;
    std::array<gp_XYZ, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
        uv[i] = triangles.UVNode(n[i]).XY();
        p[i] = triangles.Node(n[i]).XYZ();
    }
    constexpr double third = 1.0 / 3;
    constexpr std::array<std::array<double, 3>, 4> samples{
        {{third, third, third}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}};
    gp_XYZ across = (p[1] - p[0]) ^ (p[2] - p[0]);
    const double area = across.Modulus();
    if (!(area > 0)) return 0;
    across /= area;
    double largest = 0;
    for (const auto& [a, b, c] : samples) {
        const gp_XY at = uv[0] * a + uv[1] * b + uv[2] * c;
        largest = std::max(largest, std::fabs((surface->Value(at.X(), at.Y()).XYZ() - p[0]) * across));
    }
    return largest;
}

} // namespace

double deviation_of(const TopoDS_Shape& shape) {
    double largest = 0;
    for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
        const TopoDS_Face& face = TopoDS::Face(at.Current());
        TopLoc_Location place, surface_place;
        const auto triangles = BRep_Tool::Triangulation(face, place);
        const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, surface_place);
        if (triangles.IsNull() || surface.IsNull() || !triangles->HasUVNodes()) continue;
        // Triangles and surface have the same place, except in old files that move one of them.
        if (!(place == surface_place)) continue;
        for (int t = 1; t <= triangles->NbTriangles(); ++t)
            largest = std::max(largest, deviation_of(*triangles, t, surface));
    }
    return largest;
}

std::map<int, FaceGroup> groups_of(const TopoDS_Shape& shape,
                                   const std::function<int(const TopoDS_Shape&)>& material, Notes& notes) {
    Welder welder(shape);
    std::map<int, FaceGroup> groups;
    for (std::size_t f = 0; f < welder.faces.size(); ++f) {
        const TriangulatedFace& face = welder.faces[f];
        FaceGroup& group = groups[material(face.face)];
        const auto first = static_cast<std::uint32_t>(group.faces.size());
        const std::vector<gp_Vec> normals = normals_of(face);
        for (std::size_t n = 0; n < normals.size(); ++n) {
            const gp_Pnt& p = welder.position(face.first + n);
            for (const double x : {p.X(), p.Y(), p.Z()}) group.positions.push_back(static_cast<float>(x));
            for (const double x : {normals[n].X(), normals[n].Y(), normals[n].Z()})
                group.normals.push_back(static_cast<float>(x));
            group.faces.push_back(static_cast<float>(f));
        }
        const bool turned =
            (face.face.Orientation() == TopAbs_REVERSED) != face.place.Transformation().IsNegative();
        for (int t = 1; t <= face.triangles->NbTriangles(); ++t) {
            std::array<int, 3> n{};
            face.triangles->Triangle(t).Get(n[0], n[1], n[2]);
            if (turned) std::swap(n[1], n[2]);
            std::array<std::size_t, 3> sets{};
            for (std::size_t i = 0; i < 3; ++i)
                sets[i] = welder.set(face.first + static_cast<std::size_t>(n[i]) - 1);
            // At the pole of a sphere, two corners are the same point.
            if (sets[0] == sets[1] || sets[1] == sets[2] || sets[2] == sets[0]) continue;
            for (const int i : n) group.corners.push_back(first + static_cast<std::uint32_t>(i) - 1);
        }
    }
    if (welder.missing > 0) notes.warn("some faces could not be triangulated, which leaves holes");
    if (welder.different > 0)
        notes.warn("some edges are divided differently by their faces, which leaves gaps");
    return groups;
}

} // namespace importers
