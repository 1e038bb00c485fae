// cgal_verdicts FILE.off...: what CGAL says of triangle meshes, a line of JSON for each; for verdicts.py.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

struct Soup {
    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> triangles;
};

/// OFF, triangles only; colours are skipped.
Soup read(const char* path) {
    std::ifstream file(path);
    std::string word;
    std::size_t vertices = 0, faces = 0, edges = 0;
    file >> word >> vertices >> faces >> edges;
    Soup soup;
    for (std::size_t i = 0; i < vertices; ++i) {
        double x = 0, y = 0, z = 0;
        file >> x >> y >> z;
        std::getline(file, word); // colours
        soup.points.emplace_back(x, y, z);
    }
    for (std::size_t i = 0; i < faces; ++i) {
        std::size_t size = 0, a = 0, b = 0, c = 0;
        file >> size >> a >> b >> c;
        std::getline(file, word); // colours
        soup.triangles.push_back({a, b, c});
    }
    return soup;
}

/// Without the points that no triangle uses.
Soup compact(const Soup& soup) {
    Soup all;
    std::vector<std::size_t> number(soup.points.size(), soup.points.size());
    for (auto triangle : soup.triangles) {
        for (std::size_t& v : triangle) {
            if (number[v] == soup.points.size()) {
                number[v] = all.points.size();
                all.points.push_back(soup.points[v]);
            }
            v = number[v];
        }
        all.triangles.push_back(triangle);
    }
    return all;
}

using Pairs = std::vector<std::pair<Surface::Face_index, Surface::Face_index>>;

Pairs print_self_intersections(const Surface& mesh) {
    Pairs pairs;
    pmp::self_intersections(mesh, std::back_inserter(pairs));
    std::cout << ", \"pairs\": [";
    for (std::size_t i = 0; i < pairs.size(); ++i)
        std::cout << (i > 0 ? ", [" : "[") << std::size_t{pairs[i].first} << ", "
                  << std::size_t{pairs[i].second} << "]";
    std::cout << "], \"self_intersections\": " << pairs.size();
    return pairs;
}

bool repeats_a_vertex(const std::array<std::size_t, 3>& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Of what CGAL takes for a mesh: every edge with at most two faces that agree, every vertex with one fan.
void describe(const Surface& mesh) {
    const bool closed = CGAL::is_closed(mesh);
    auto labels = std::vector<std::size_t>(num_faces(mesh));
    const auto pieces =
        pmp::connected_components(mesh, CGAL::make_property_map(labels), CGAL::parameters::all_default());
    const Pairs pairs = print_self_intersections(mesh);
    std::cout << ", \"closed\": " << closed << ", \"pieces\": " << pieces << ", \"euler\": "
              << static_cast<long long>(num_vertices(mesh)) - static_cast<long long>(num_edges(mesh)) +
                     static_cast<long long>(num_faces(mesh))
              << ", \"area\": " << pmp::area(mesh);
    if (!closed) return;
    std::cout << ", \"volume\": " << pmp::volume(mesh);
    if (pairs.empty())
        std::cout << ", \"outward\": " << (pmp::does_bound_a_volume(mesh) && pmp::volume(mesh) > 0);
}

} // namespace

int main(int count, char** paths) {
    std::cout.precision(17);
    std::cout << std::boolalpha;
    for (int i = 1; i < count; ++i) {
        Soup soup = compact(read(paths[i]));
        const bool mesh = pmp::is_polygon_soup_a_polygon_mesh(soup.triangles);
        std::cout << "{\"mesh\": " << mesh;
        const auto& triangles = soup.triangles;
        if (mesh || std::none_of(triangles.begin(), triangles.end(), repeats_a_vertex)) {
            // What is no mesh is taken apart, vertices doubled, until it is one: faces stay, and in their
            // order.
            if (!mesh) pmp::orient_polygon_soup(soup.points, soup.triangles);
            Surface surface;
            pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, surface);
            if (mesh)
                describe(surface);
            else
                print_self_intersections(surface);
        }
        std::cout << "}\n";
    }
}
