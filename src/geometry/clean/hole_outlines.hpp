#pragma once
// The holes of a surface, by their outlines.

#include "mesh/topology.hpp"

#include <algorithm>
#include <map>

namespace facetmill {

/// A hole's outline the way its faces would run: corner i's wedge is at the start of the edge to corner i
/// + 1.
struct Outline {
    std::vector<Index> wedges;
    std::vector<Index> faces; ///< [i] across the edge from i to i + 1
};

class Outlines {
  public:
    explicit Outlines(const Mesh& mesh)
        : mesh_(mesh), edges_(build_edges(mesh)), faces_(corner_faces(mesh)), done_(mesh.corner_count(), 0) {}

    /// Calls body(outline) for each loop of open edges, and broken(corner) for those that do not come round.
    /// A walk that comes to a vertex again goes around several holes that touch there: each is an outline.
    template <class Body, class Broken>
    void each(Body&& body, Broken&& broken) {
        for (Index c = 0; c < mesh_.corner_count(); ++c) {
            if (done_[c] || !is_open(c)) continue;
            Outline outline;
            if (walk(c, outline))
                each_loop(outline, body);
            else
                broken(c);
        }
    }

  private:
    template <class Body>
    void each_loop(const Outline& walked, Body&& body) {
        Outline path;
        std::map<Index, std::size_t> place; // of the path's vertices on it
        for (std::size_t i = 0; i < walked.wedges.size(); ++i) {
            const Index v = mesh_.vertex_of_wedge(walked.wedges[i]);
            if (const auto again = place.find(v); again != place.end()) {
                const auto from = static_cast<std::ptrdiff_t>(again->second);
                const Outline loop{{path.wedges.begin() + from, path.wedges.end()},
                                   {path.faces.begin() + from, path.faces.end()}};
                for (const Index w : loop.wedges) place.erase(mesh_.vertex_of_wedge(w));
                path.wedges.resize(static_cast<std::size_t>(from));
                path.faces.resize(static_cast<std::size_t>(from));
                body(loop);
            }
            place[v] = path.wedges.size();
            path.wedges.push_back(walked.wedges[i]);
            path.faces.push_back(walked.faces[i]);
        }
        body(path);
    }

    bool is_open(Index c) const {
        const Index e = edges_.corner_edge[c];
        return e != none && edges_.corners_of(e).size() == 1;
    }
    Index next(Index c) const { return next_corner(mesh_, faces_[c], c); }

    /// The open edge that follows c's around the vertex at c's end, or none.
    Index follow(Index c) const {
        Index at = next(c); // leaves the vertex
        for (std::size_t turns = 0; turns <= mesh_.corner_count(); ++turns) {
            const Index e = edges_.corner_edge[at];
            if (e == none) return none;
            const auto corners = edges_.corners_of(e);
            if (corners.size() == 1) return at;
            if (corners.size() > 2) return none;
            const Index other = corners[0] == at ? corners[1] : corners[0];
            if (mesh_.vertex(other) == mesh_.vertex(at)) return none; // neighbours disagree
            at = next(other);
        }
        return none;
    }

    bool walk(Index start, Outline& outline) {
        Index c = start;
        do {
            if (done_[c]) return false;
            done_[c] = 1;
            outline.wedges.push_back(mesh_.corners[next(c)]);
            outline.faces.push_back(faces_[c]);
            c = follow(c);
            if (c == none) return false;
        } while (c != start);
        // Walked along the faces' edges; a face in the hole runs the other way.
        std::reverse(outline.wedges.begin(), outline.wedges.end());
        std::reverse(outline.faces.begin(), outline.faces.end());
        return true;
    }

    const Mesh& mesh_;
    EdgeTable edges_;
    std::vector<Index> faces_;
    std::vector<std::uint8_t> done_;
};

} // namespace facetmill
