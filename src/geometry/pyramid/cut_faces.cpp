#include "geometry/pyramid/cut_faces.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace facetmill {

namespace {

class FaceSetCutter {
  public:
    FaceSetCutter(const Mesh& mesh, std::size_t most)
        : most_(most), centres_(mesh.face_count()), order_(mesh.face_count()) {
        parallel_for(centres_.size(), [&](std::size_t f) {
            const Index begin = mesh.face_begin(static_cast<Index>(f)),
                        end = mesh.face_end(static_cast<Index>(f));
            for (Index c = begin; c < end; ++c)
                centres_[f] = centres_[f] + mesh.point(c) * (1.0 / (end - begin));
        });
        std::iota(order_.begin(), order_.end(), Index{0});
        cuts_.leaf_of_face.resize(mesh.face_count());
    }

    FaceCuts run() {
        add(order_, "");
        return std::move(cuts_);
    }

  private:
    using Faces = std::span<Index>;

    std::size_t add(Faces faces, const std::string& name) {
        const std::size_t at = cuts_.tiles.size(), leaves = (faces.size() + most_ - 1) / most_;
        cuts_.tiles.push_back({name, {}, static_cast<Index>(cuts_.leaves), 0});
        if (leaves <= 1) {
            for (const Index f : faces) cuts_.leaf_of_face[f] = static_cast<Index>(cuts_.leaves);
            ++cuts_.leaves;
        } else {
            std::vector<std::size_t> children;
            for (const Faces part : parts_of(faces, leaves_of_children(leaves)))
                children.push_back(add(part, name + static_cast<char>('0' + children.size())));
            cuts_.tiles[at].children = std::move(children);
        }
        cuts_.tiles[at].last_leaf = static_cast<Index>(cuts_.leaves);
        return at;
    }

    /// The numbers of leaves of up to four children of a node with this many leaves, about equal. A tree of
    /// n leaves whose nodes all have four children has (n - 1) / 3 nodes. All numbers except the last are 1
    /// more than a multiple of 3, so no tree has fewer nodes.
    static std::vector<std::size_t> leaves_of_children(std::size_t leaves) {
        if (leaves <= most_children) return std::vector<std::size_t>(leaves, 1);
        std::vector<std::size_t> children;
        for (std::size_t left = most_children; left > 1; --left) {
            const std::size_t even = (leaves + left / 2) / left;
            children.push_back(even / 3 * 3 + 1);
            leaves -= children.back();
        }
        children.push_back(leaves);
        return children;
    }

    /// Divides the faces into parts for these numbers of leaves, by halving along the longest side.
    std::vector<Faces> parts_of(Faces faces, std::span<const std::size_t> leaves) {
        if (leaves.size() == 1) return {faces};
        const std::size_t first = (leaves.size() + 1) / 2;
        const auto sum = [](std::span<const std::size_t> some) {
            return std::accumulate(some.begin(), some.end(), std::size_t{0});
        };
        const std::size_t middle = share_of(faces.size(), sum(leaves.first(first)), sum(leaves));
        part_at(faces, middle);
        std::vector<Faces> parts = parts_of(faces.first(middle), leaves.first(first));
        for (const Faces part : parts_of(faces.subspan(middle), leaves.subspan(first))) parts.push_back(part);
        return parts;
    }

    /// n * part / whole, rounded down, without overflow.
    static std::size_t share_of(std::size_t n, std::size_t part, std::size_t whole) {
        return n / whole * part + n % whole * part / whole;
    }

    void part_at(Faces faces, std::size_t middle) const {
        Box box;
        for (const Index f : faces) box.add(centres_[f]);
        const Vec3 e = box.extent();
        const std::size_t axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
        std::nth_element(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(middle), faces.end(),
                         [&](Index a, Index b) {
                             const double x = centres_[a][axis], y = centres_[b][axis];
                             return x != y ? x < y : a < b;
                         });
    }

    static constexpr std::size_t most_children = 4;
    std::size_t most_;
    std::vector<Vec3> centres_;
    std::vector<Index> order_;
    FaceCuts cuts_;
};

} // namespace

FaceCuts cut_faces(const Mesh& mesh, std::size_t most) { return FaceSetCutter(mesh, most).run(); }

} // namespace facetmill
