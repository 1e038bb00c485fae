#pragma once
// By what inputs are known again without being read, in a folder of kept cells.

#include "cells/cell_folder.hpp"
#include "cells/face_source.hpp"

namespace facetmill::cells {

/// What the system says of a file that is read.
struct InputStamp {
    std::uint64_t bytes = 0, device = 0, inode = 0;
    std::int64_t modified = 0, changed = 0; ///< nanoseconds since 1970, of its contents and of anything of it
    bool operator==(const InputStamp&) const = default;

    /// None where there is no such file.
    static std::optional<InputStamp> of(const std::filesystem::path& path);
    /// Whether a file that is written to at that time, or later, gets other times, also where the system
    /// counts in seconds.
    bool is_settled(std::int64_t now) const;
};

class InputStamps {
  public:
    static constexpr const char* file = "facetmill-cells.inputs";

    /// Nanoseconds since 1970.
    static std::int64_t now();
    /// Of the files as they are now.
    explicit InputStamps(const std::vector<FaceSource::File>& files, std::int64_t now = InputStamps::now());
    /// The digests of the files, where they are as they were when they were stored; else none.
    std::vector<std::string> digests(const CellFolder& folder) const;
    /// Stores the digests, which were taken after this was made; nothing where files changed since, or
    /// just before, or it cannot be written.
    void store(const CellFolder& folder, const std::vector<FaceSource::File>& files) const;

  private:
    std::vector<InputStamp> stamps_; ///< [files]; fewer: there are none
    std::int64_t now_;
};

} // namespace facetmill::cells
