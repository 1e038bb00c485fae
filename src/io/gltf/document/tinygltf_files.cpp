#include "io/gltf/document/tinygltf_files.hpp"

namespace facetmill::io::gltf {

namespace {

TinygltfFiles& files_of(void* user) { return *static_cast<TinygltfFiles*>(user); }

/// Newer versions ask for the size first.
template <class Callbacks>
Callbacks callbacks_for(TinygltfFiles& files) {
    Callbacks callbacks{};
    callbacks.FileExists = [](const std::string& path, void* user) { return files_of(user).exists(path); };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error, const std::string& path,
                                 void* user) { return files_of(user).read(path, *out, *error); };
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                  void*) { return false; };
    if constexpr (requires { callbacks.GetFileSizeInBytes; })
        callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void* user) {
            *size = files_of(user).size();
            return true;
        };
    callbacks.user_data = &files;
    return callbacks;
}

} // namespace

tinygltf::TinyGLTF loader_for(TinygltfFiles& files) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(callbacks_for<tinygltf::FsCallbacks>(files));
    loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    return loader;
}

} // namespace facetmill::io::gltf
