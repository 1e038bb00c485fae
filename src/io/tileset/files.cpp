#include "io/tileset/files.hpp"

#include "io/gltf/document/container.hpp"
#include "io/images/image_files.hpp"

#include <fmt/format.h>

namespace facetmill::io::tileset {

Input file_below(const Input& tileset, const std::string& uri, const std::string& place) {
    const auto relative = gltf::decoded_path(uri);
    if (!relative || !path_below(tileset, *relative))
        throw Error(ErrorKind::malformed, "E-URI",
                    fmt::format("{}: \"{}\" is not a file in the tileset's folder or below", place, uri),
                    hint_for_asset_root(tileset, relative));
    return tileset.beside(*relative).with_asset_roots(tileset.asset_roots());
}

} // namespace facetmill::io::tileset
