#include "scene_files.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

namespace importers {

namespace {

namespace fs = std::filesystem;

class MemoryStream : public Assimp::IOStream {
  public:
    explicit MemoryStream(std::string bytes) : own_(std::move(bytes)), bytes_(own_) {}
    explicit MemoryStream(std::string_view bytes) : bytes_(bytes) {}

    std::size_t Read(void* to, std::size_t size, std::size_t count) override {
        if (size == 0) return 0;
        const std::size_t items = std::min(count, (bytes_.size() - at_) / size);
        std::memcpy(to, bytes_.data() + at_, items * size);
        at_ += items * size;
        return items;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin from) override {
        const std::size_t to = from == aiOrigin_SET   ? offset
                               : from == aiOrigin_CUR ? at_ + offset
                                                      : bytes_.size() + offset;
        if (to > bytes_.size()) return aiReturn_FAILURE;
        at_ = to;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return at_; }
    std::size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

  private:
    std::string own_;
    std::string_view bytes_;
    std::size_t at_ = 0;
};

bool is_below(const fs::path& file, const std::vector<fs::path>& folders) {
    std::error_code failed;
    const fs::path real = fs::canonical(file, failed);
    return !failed && fs::is_regular_file(real, failed) &&
           std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
               const fs::path root = fs::canonical(folder, failed);
               return !failed &&
                      std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
           });
}

} // namespace

std::string SceneFiles::neighbour(std::string name) const {
    if (options_.folders.empty() || name.empty()) return {};
    std::replace(name.begin(), name.end(), '\\', '/');
    const bool absolute = name.front() == '/' || name.find(':') != name.npos;
    const fs::path last = fs::path(name).filename(), stem = fs::path(options_.name).stem();
    std::vector<fs::path> tried;
    if (!absolute) tried.push_back(fs::path(name).lexically_normal());
    tried.insert(tried.end(), {last, fs::path(stem.string() + ".fbm") / last, fs::path("textures") / last,
                               fs::path("Textures") / last});
    for (const fs::path& path : tried)
        if (is_below(options_.folders.front() / path, options_.folders)) return path.generic_string();
    return {};
}

bool SceneFiles::Exists(const char* name) const { return name == options_.name || !neighbour(name).empty(); }

Assimp::IOStream* SceneFiles::Open(const char* name, const char*) {
    if (name == options_.name) return new MemoryStream(std::string_view(file_));
    const std::string path = neighbour(name);
    if (path.empty()) {
        notes_.absent_file(fs::path(name).filename().string());
        return nullptr;
    }
    std::ifstream stream(options_.folders.front() / path, std::ios::binary);
    if (!stream) return nullptr;
    notes_.read_file(path);
    return new MemoryStream(std::string(std::istreambuf_iterator<char>(stream), {}));
}

} // namespace importers
