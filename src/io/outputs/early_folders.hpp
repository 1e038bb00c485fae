#pragma once
// Makes output folders before the sandbox closes, because the sandbox grants rights only to existing
// folders.

#include "platform/descriptor.hpp"

#include <vector>

namespace facetmill::io {

struct CleanUp;

/// Protects the folders in use from removal by other runs that made them. The destructor, or a signal,
/// removes folders that this object made if they are empty and unused.
class EarlyFolders {
  public:
    EarlyFolders() = default;
    EarlyFolders(const EarlyFolders&) = delete;
    EarlyFolders& operator=(const EarlyFolders&) = delete;
    ~EarlyFolders();

    /// Makes the folder and its missing parents. Ignores errors, because writing to the folder will report
    /// them.
    void make(const std::filesystem::path& folder);
    /// The parents of all folders made here. The sandbox need only allow making and removing folders in
    /// these.
    std::vector<std::filesystem::path> made_in() const;

  private:
    struct Folder {
        std::filesystem::path path;
        Descriptor lock; ///< held open and locked, shared, while this lives
        bool made = false;
        CleanUp* clean_up = nullptr;
    };
    void use(const std::filesystem::path& folder, bool made);

    std::vector<Folder> folders_; ///< outer folders before inner folders
};

} // namespace facetmill::io
