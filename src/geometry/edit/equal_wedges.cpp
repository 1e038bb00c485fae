#include "geometry/edit/equal_wedges.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace facetmill {

namespace {

/// Compares the attributes of wedges.
class WedgeOrder {
  public:
    explicit WedgeOrder(const Mesh& mesh) : vertex_(mesh.wedge_vertex) {
        for (const Attribute& a : mesh.attributes)
            if (a.domain == Domain::wedge)
                std::visit(
                    [&](const auto& numbers) {
                        columns_.push_back({reinterpret_cast<const char*>(numbers.data()),
                                            sizeof(numbers[0]) * static_cast<std::size_t>(a.components)});
                    },
                    a.data);
    }
    int compare(Index a, Index b) const {
        if (vertex_[a] != vertex_[b]) return vertex_[a] < vertex_[b] ? -1 : 1;
        for (const auto& [bytes, stride] : columns_)
            if (const int order = std::memcmp(bytes + a * stride, bytes + b * stride, stride)) return order;
        return 0;
    }

  private:
    const std::vector<Index>& vertex_;
    std::vector<std::pair<const char*, std::size_t>> columns_;
};

} // namespace

std::size_t merge_equal_wedges(Mesh& mesh) {
    if (!mesh.has_seams()) return 0;
    const std::size_t before = mesh.wedge_count();
    const WedgeOrder order(mesh);
    std::vector<Index> sorted(mesh.wedge_vertex.size());
    std::iota(sorted.begin(), sorted.end(), Index{0});
    std::sort(sorted.begin(), sorted.end(), [&](Index a, Index b) {
        const int c = order.compare(a, b);
        return c != 0 ? c < 0 : a < b;
    });
    std::vector<Index> instead(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i)
        instead[sorted[i]] =
            i > 0 && order.compare(sorted[i - 1], sorted[i]) == 0 ? instead[sorted[i - 1]] : sorted[i];
    bool equal = false;
    for (Index w = 0; w < instead.size(); ++w) equal = equal || instead[w] != w;
    if (!equal) return 0;
    for (Index& w : mesh.corners) w = instead[w];
    drop_unused(mesh);
    return before - mesh.wedge_count();
}

} // namespace facetmill
