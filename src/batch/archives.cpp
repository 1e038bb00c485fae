#include "batch/archives.hpp"

#include "base/hash.hpp"
#include "base/text/spelling.hpp"
#include "io/codec.hpp"
#include "io/outputs/outputs.hpp"
#include "io/tar.hpp"
#include "io/threemf/zip.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <set>

namespace facetmill::batch {

namespace fs = std::filesystem;

namespace {

/// Writes the files of an archive below a folder.
class Unpacker {
  public:
    Unpacker(const std::string& archive, const fs::path& folder) : archive_(archive), folder_(folder) {}

    void add(const std::string& path, io::Span bytes) {
        if (path.ends_with('/')) return; // a folder of a zip
        // Further data that macOS stores for each file.
        if (path.starts_with("__MACOSX/") || fs::path(path).filename().generic_string().starts_with("._"))
            return;
        const fs::path below = fs::path(path).lexically_normal();
        if (!stays_inside(path, below)) refuse(path, "its name leads out of the archive's folder");
        if (!names_.insert(lower_case(below.generic_string())).second)
            refuse(path, "another file has the same name");
        io::write_now(folder_ / below, bytes, {.sync = false});
        if (io::codec_for(below)) meshes_.push_back(below.generic_string());
    }
    std::vector<std::string> meshes() {
        std::sort(meshes_.begin(), meshes_.end());
        return std::move(meshes_);
    }

  private:
    static bool stays_inside(const std::string& path, const fs::path& below) {
        if (path.find('\0') != path.npos || path.find('\\') != path.npos) return false;
        return !below.empty() && below.is_relative() && below.has_filename() && below != "." &&
               *below.begin() != "..";
    }
    [[noreturn]] void refuse(const std::string& path, const std::string& why) const {
        throw Error(ErrorKind::malformed, "E-ARCHIVE",
                    fmt::format("the file '{}' in '{}' is refused: {}", path, archive_, why),
                    "make the archive again from inside its folder, with relative names");
    }

    const std::string& archive_;
    const fs::path& folder_;
    std::set<std::string> names_;
    std::vector<std::string> meshes_;
};

} // namespace

fs::path unpack_folder(const fs::path& output_dir, const std::string& archive) {
    const std::string name =
        archive == "-" ? archive : fs::absolute(archive).lexically_normal().generic_string();
    constexpr std::size_t digits = 8;
    return output_dir /
           fmt::format(".facetmill-unpacked-{}", sha256(std::as_bytes(std::span(name))).substr(0, digits));
}

std::vector<std::string> unpack_archive(const std::string& archive, const fs::path& folder) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    Unpacker unpacker(archive, folder);
    const auto input = io::Input::open(archive);
    if (io::as_text(input.bytes()).starts_with("PK")) {
        io::threemf::Archive zip(input.bytes(), archive);
        for (const auto& path : zip.paths()) {
            const auto bytes = zip.file(path); // none for an absolute path, which is refused
            unpacker.add(path, bytes ? io::Span(*bytes) : io::Span{});
        }
    } else {
        io::read_tar(input.bytes(), archive,
                     [&](const std::string& path, io::Span bytes) { unpacker.add(path, bytes); });
    }
    return unpacker.meshes();
}

bool is_archive_name(const std::string& path) {
    return path == "-" || path.ends_with(".tar") || path.ends_with(".zip");
}

namespace {

/// The path below the output folder. Refuses files outside, whose names readers refuse.
const std::string& name_in_archive(const std::string& path) {
    if (fs::path(path).has_root_path() || path.starts_with("../"))
        throw Error(ErrorKind::output, "E-ARCHIVE", fmt::format("'{}' is outside the output folder", path),
                    "write below the output folder");
    return path;
}

/// Calls take for the files of all successful assets.
void for_each_file(const Summary& summary,
                   const std::function<void(const std::string& path, io::Span bytes)>& take) {
    for (const Outcome& out : summary.outcomes) {
        if (out.verdict != Outcome::Verdict::ok) continue;
        for (const auto* all : {&out.outputs, &out.reports})
            for (const std::string& path : *all)
                take(name_in_archive(path), io::Input::open(summary.output_dir / path).stored());
    }
}

} // namespace

void write_archive(const Summary& summary, const fs::path& target) {
    if (target.extension() == ".zip") {
        std::vector<io::threemf::ArchiveFile> files;
        for_each_file(summary, [&](const std::string& path, io::Span bytes) {
            files.push_back({path, io::Bytes(bytes.begin(), bytes.end())});
        });
        return io::write_now(target, io::threemf::make_archive(files));
    }
    const auto tar = [&](const std::function<void(io::Span)>& put) {
        for_each_file(summary,
                      [&](const std::string& path, io::Span bytes) { io::put_tar_file(path, bytes, put); });
        io::put_tar_end(put);
    };
    if (target != "-") {
        io::Outputs outputs;
        outputs.add(target, tar);
        return outputs.commit();
    }
    tar([&](io::Span bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size())
            throw Error(ErrorKind::output, "E-WRITE", "standard output does not take the archive");
    });
    if (std::fflush(stdout) != 0)
        throw Error(ErrorKind::output, "E-WRITE", "standard output does not take the archive");
}

} // namespace facetmill::batch
