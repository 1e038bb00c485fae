#pragma once
// Folders of outputs that are made before the sandbox closes: what is made later would have no right of its
// own.

#include "platform/descriptor.hpp"

#include <vector>

namespace facetmill::io {

struct CleanUp;

/// While one lives, the folders that it knows are not removed by another that made them. Its end, or a
/// signal, removes those that it made, are empty, and are used by no other.
class EarlyFolders {
  public:
    EarlyFolders() = default;
    EarlyFolders(const EarlyFolders&) = delete;
    EarlyFolders& operator=(const EarlyFolders&) = delete;
    ~EarlyFolders();

    /// Makes the folder and those above it that are missing. What fails is left to whoever writes there.
    void make(const std::filesystem::path& folder);
    /// The folders in which the first ones were made: what is made and removed there are folders only.
    std::vector<std::filesystem::path> made_in() const;

  private:
    struct Folder {
        std::filesystem::path path;
        Descriptor lock; ///< held open and locked, shared, while this lives
        bool made = false;
        CleanUp* clean_up = nullptr;
    };
    void use(const std::filesystem::path& folder, bool made);

    std::vector<Folder> folders_; ///< an outer one before those in it
};

} // namespace facetmill::io
