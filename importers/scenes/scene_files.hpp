#pragma once
// The files that assimp may open: the bytes of the file itself, and neighbours below the allowed folders.

#include "helper.hpp"

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

namespace importers {

class SceneFiles : public Assimp::IOSystem {
  public:
    SceneFiles(const Options& options, const std::string& file, Notes& notes)
        : options_(options), file_(file), notes_(notes) {}

    bool Exists(const char* name) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override;
    void Close(Assimp::IOStream* stream) override { delete stream; }

    /// The path of a neighbour relative to the file's folder, by its name in the file. Names may be absolute
    /// paths of other machines: then a file of the same name beside the file counts. Empty: none exists.
    [[nodiscard]] std::string neighbour(std::string name) const;

  private:
    const Options& options_;
    const std::string& file_;
    Notes& notes_;
};

} // namespace importers
