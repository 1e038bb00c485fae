#pragma once
// How tinygltf gets files: it asks callbacks, and does not open files or decode images itself.

#include <string>
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
#include <vector>

namespace facetmill::io::gltf {

/// Answers tinygltf's requests for the files that a document names.
class TinygltfFiles {
  public:
    virtual ~TinygltfFiles() = default;
    [[nodiscard]] virtual bool exists(const std::string& /*path*/) { return true; }
    /// Newer versions compare it with a limit before they read.
    [[nodiscard]] virtual std::size_t size() const { return 1; }
    /// Returns false with a reason if the file cannot be read.
    [[nodiscard]] virtual bool read(const std::string& path, std::vector<unsigned char>& out,
                                    std::string& error) = 0;
};

/// A loader that asks `files`, which must outlive it, and leaves images undecoded.
[[nodiscard]] tinygltf::TinyGLTF loader_for(TinygltfFiles& files);

} // namespace facetmill::io::gltf
