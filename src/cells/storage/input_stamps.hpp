#pragma once
// By what inputs are known again without being read, in a folder of kept cells.

#include "cells/sources/face_source.hpp"
#include "cells/storage/cell_folder.hpp"
#include "cells/storage/stream.hpp"

namespace facetmill::cells {

class InputStamps {
  public:
    static constexpr const char* file = "facetmill-cells.inputs";

    /// Nanoseconds since 1970.
    static std::int64_t now();
    /// Of the files as they were when they were opened; whatever their paths name now.
    explicit InputStamps(const std::vector<FaceSource::File>& files, std::int64_t now = InputStamps::now());
    /// The digests of the files, where they are as they were when they were stored; else none.
    std::vector<std::string> digests(const CellFolder& folder) const;
    /// Stores the digests, which were taken after this was made; nothing where files changed since, or
    /// just before, or it cannot be written.
    void store(const CellFolder& folder, const std::vector<FaceSource::File>& files) const;

  private:
    std::vector<FileStamp> stamps_; ///< [files]; fewer: there are none
    std::int64_t now_;
};

} // namespace facetmill::cells
