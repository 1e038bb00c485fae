#pragma once
// Recognises unchanged inputs without reading them, in a folder of kept cells.

#include "cells/sources/face_source.hpp"
#include "cells/storage/cell_folder.hpp"
#include "cells/storage/stream.hpp"

namespace facetmill::cells {

class InputStamps {
  public:
    static constexpr const char* file = "facetmill-cells.inputs";

    /// The time in nanoseconds since 1970.
    static std::int64_t now();
    /// The stamps of the files when they were opened, whatever their paths name now.
    explicit InputStamps(const std::vector<FaceSource::File>& files, std::int64_t now = InputStamps::now());
    /// The stored digests if the files have not changed since; otherwise an empty list.
    std::vector<std::string> digests(const CellFolder& folder) const;
    /// Stores the digests, which must be computed after this object was made. Stores nothing if files
    /// changed since or just before, or if writing fails.
    void store(const CellFolder& folder, const std::vector<FaceSource::File>& files) const;

  private:
    std::vector<FileStamp> stamps_; ///< [files] stamps; fewer if stamps are unavailable
    std::int64_t now_;
};

} // namespace facetmill::cells
