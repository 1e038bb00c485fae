#include "io/gltf/read/lines.hpp"

namespace facetmill::io::gltf {

std::vector<Index> ends_of_lines(const std::vector<Index>& indices, std::uint64_t mode) {
    enum Mode : std::uint64_t { list = 1, loop = 2 };
    std::vector<Index> ends;
    for (std::size_t i = 0; i + 1 < indices.size(); i += mode == list ? 2 : 1)
        ends.insert(ends.end(), {indices[i], indices[i + 1]});
    if (mode == loop && indices.size() > 1) ends.insert(ends.end(), {indices.back(), indices.front()});
    return ends;
}

} // namespace facetmill::io::gltf
