#include "geometry/pyramid/cut_faces.hpp"

#include "base/parallel.hpp"

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
        const std::size_t at = cuts_.tiles.size();
        cuts_.tiles.push_back({name, {}, static_cast<Index>(cuts_.leaves), 0});
        if (faces.size() <= most_) {
            for (const Index f : faces) cuts_.leaf_of_face[f] = static_cast<Index>(cuts_.leaves);
            ++cuts_.leaves;
        } else {
            std::vector<std::size_t> children;
            const auto child = [&](Faces some) {
                children.push_back(add(some, name + static_cast<char>('0' + children.size())));
            };
            const bool two = halvings(faces.size()) % 2 == 1; // so that all below have four
            for (const Faces half : halves(faces)) {
                if (two)
                    child(half);
                else
                    for (const Faces quarter : halves(half)) child(quarter);
            }
            cuts_.tiles[at].children = std::move(children);
        }
        cuts_.tiles[at].last_leaf = static_cast<Index>(cuts_.leaves);
        return at;
    }

    /// Until none has more than most.
    int halvings(std::size_t faces) const {
        int n = 0;
        for (; faces > most_; faces = (faces + 1) / 2) ++n;
        return n;
    }

    std::array<Faces, 2> halves(Faces faces) const {
        Box box;
        for (const Index f : faces) box.add(centres_[f]);
        const Vec3 e = box.extent();
        const std::size_t axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
        const std::size_t middle = faces.size() / 2;
        std::nth_element(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(middle), faces.end(),
                         [&](Index a, Index b) {
                             const double x = centres_[a][axis], y = centres_[b][axis];
                             return x != y ? x < y : a < b;
                         });
        return {faces.first(middle), faces.subspan(middle)};
    }

    std::size_t most_;
    std::vector<Vec3> centres_;
    std::vector<Index> order_;
    FaceCuts cuts_;
};

} // namespace

FaceCuts cut_faces(const Mesh& mesh, std::size_t most) { return FaceSetCutter(mesh, most).run(); }

} // namespace facetmill
