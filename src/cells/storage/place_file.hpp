#pragma once
// The grid cell of each face, in face order, as temporary data. A cell needs one or two bytes if consecutive
// faces are close together.

#include "cells/storage/block_file.hpp"

namespace facetmill::cells {

class PlaceFile {
  public:
    /// Throws an output error (E-WRITE, E-SPACE).
    explicit PlaceFile(const std::filesystem::path& scratch) : scratch_(scratch), file_(scratch) {}
    /// Throws an output error (E-WRITE, E-SPACE).
    void add(std::size_t place);

    /// Reads the numbers in order.
    class Reader {
      public:
        /// Throws an output error (E-SCRATCH) if no numbers are left, or the next is not below `end`.
        std::size_t next(std::size_t end);

      private:
        friend class PlaceFile;
        Reader(std::filesystem::path scratch, std::shared_ptr<const ReadFile> file, std::uint64_t size)
            : scratch_(std::move(scratch)), file_(std::move(file)), bytes_(*file_, 0, size) {}
        std::filesystem::path scratch_;
        std::shared_ptr<const ReadFile> file_;
        Stream bytes_;
        std::uint64_t last_ = 0;
    };
    /// No places can be added afterwards.
    Reader finish() { return {scratch_, file_.finish(), size_}; }

  private:
    std::filesystem::path scratch_;
    ScratchFile file_;
    std::uint64_t last_ = 0, size_ = 0;
};

} // namespace facetmill::cells
