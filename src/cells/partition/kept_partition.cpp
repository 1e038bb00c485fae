#include "cells/partition/kept_partition.hpp"

#include "base/hash.hpp"
#include "base/json.hpp"
#include "base/text/words.hpp"
#include "cells/storage/input_stamps.hpp"
#include "platform/build_id.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace facetmill::cells {

namespace {

constexpr auto manifest_file = kept_files[0], records_file = kept_files[1], borders_file = kept_files[2];
constexpr const char* format_name = "facetmill-cells";
constexpr int format_version = 1;

Json block_json(const Block& block) {
    return {
        {"offset", block.offset}, {"bytes", block.size}, {"digest", fmt::format("{:016x}", block.digest)}};
}

/// The inverse of block_json. Throws Json::exception, std::logic_error for other JSON.
Block block_from(const Json& json) {
    return {json.at("offset").get<std::uint64_t>(), json.at("bytes").get<std::uint64_t>(),
            std::stoull(json.at("digest").get<std::string>(), nullptr, 16)};
}

Json inputs_json(const FaceSource& source) {
    Json all = Json::array();
    for (const auto& file : source.contents().files)
        all.push_back({{"bytes", file.input.bytes().size()}, {"sha256", file.sha256}});
    return all;
}

Json box_json(const Box& box) {
    return {{"min", {box.min.x, box.min.y, box.min.z}}, {"max", {box.max.x, box.max.y, box.max.z}}};
}

/// The inverse of box_json. Throws Json::exception for other JSON.
Box box_from(const Json& json) {
    const auto point = [&](const char* name) {
        const auto p = json.at(name).get<std::array<double, 3>>();
        return Vec3{p[0], p[1], p[2]};
    };
    Box box;
    box.add(point("min"));
    box.add(point("max"));
    return box;
}

/// The digest of the manifest without its digest.
std::string digest_of(const Json& manifest) {
    Json rest = manifest;
    rest.erase("sha256");
    const std::string text = rest.dump();
    return sha256(std::as_bytes(std::span(text)));
}

class PartitionKeeper {
  public:
    PartitionKeeper(std::shared_ptr<FaceSource> source, const CellResources& means, std::uint64_t most)
        : source_(std::move(source)), means_(means), folder_(*means.kept), most_(most),
          stamps_(source_->contents().files) {}

    std::unique_ptr<Partition> partition() {
        auto partition = taken_or_made();
        if (!knew_inputs_ && folder_.is_alone()) stamps_.store(folder_, source_->contents().files);
        return partition;
    }

  private:
    std::unique_ptr<Partition> taken_or_made() {
        std::string why;
        if (auto taken = take(why)) {
            folder_.tell(fmt::format("{} reused from '{}'", counted(taken->tree().leaves.size(), "cell"),
                                     folder_.path().generic_string()));
            if (means_.job && means_.job->makes_cells()) // the time must be newer than the inputs
                for (const char* name : kept_files) folder_.touch(name);
            return taken;
        }
        if (is_beside_others())
            make_cells_due(folder_, why.empty() ? fmt::format("there are no cells in '{}'",
                                                              folder_.path().generic_string())
                                                : why);
        if (!why.empty()) folder_.tell(why + ": they are made again");
        return make();
    }

    bool is_beside_others() const { return means_.job && !means_.job->makes_cells(); }

    /// The inputs that the partition depends on.
    Json origin() const {
        return {{"format", format_name}, {"version", format_version}, {"program", code_id()},
                {"options", means_.key}, {"faces_of_cell", most_},    {"inputs", inputs_json(*source_)}};
    }

    /// Takes the kept partition. If it returns none, `why` is the reason, or empty if nothing was kept.
    std::unique_ptr<Partition> take(std::string& why) {
        const std::optional<io::Bytes> text = folder_.read(manifest_file);
        if (!text) return {};
        const Json manifest = parse_json(io::as_text(*text), Broken::discarded);
        if (!manifest.is_object() || !manifest.contains("sha256") ||
            manifest["sha256"] != digest_of(manifest)) {
            why =
                fmt::format("the manifest of the cells in '{}' is damaged", folder_.path().generic_string());
            return {};
        }
        find_digests();
        why = difference(manifest);
        if (!why.empty()) return {};
        same_origin_ = manifest;
        try {
            auto partition = restored(manifest, why);
            if (partition)
                source_->restore(box_from(manifest.at("bounds")),
                                 manifest.value("skipped_faces", std::uint64_t{0}));
            return partition;
        } catch (const Json::exception&) {
        } catch (const std::logic_error&) {
        } catch (const Error&) { // a file is missing or unreadable
        }
        if (why.empty()) why = fmt::format("cells in '{}' cannot be read", folder_.path().generic_string());
        return {};
    }

    /// Finds the digests of the inputs; inputs that have not changed are not read again.
    void find_digests() {
        const auto& files = source_->contents().files;
        if (std::none_of(files.begin(), files.end(), [](const auto& f) { return f.sha256.empty(); })) return;
        const std::vector<std::string> digests = stamps_.digests(folder_);
        knew_inputs_ = !digests.empty();
        if (knew_inputs_)
            source_->take_digests(digests);
        else
            source_->finish_digests();
    }

    /// The difference of the origins, for messages.
    std::string difference(const Json& manifest) const {
        constexpr std::pair<const char*, const char*> told[] = {{"format", "another program"},
                                                                {"version", "another program"},
                                                                {"program", "another version of the program"},
                                                                {"inputs", "other inputs"},
                                                                {"options", "other options"},
                                                                {"faces_of_cell", "other options"}};
        const Json expected = origin();
        for (const auto& [key, what] : told)
            if (!manifest.contains(key) || manifest[key] != expected[key])
                return fmt::format("cells in '{}' belong to {}", folder_.path().generic_string(), what);
        return {};
    }

    std::unique_ptr<Partition> restored(const Json& manifest, std::string& why) const {
        std::vector<std::uint8_t> depths;
        std::vector<Block> records, borders;
        for (const Json& cell : manifest.at("cells")) {
            depths.push_back(cell.at("depth").get<std::uint8_t>());
            records.push_back(block_from(cell.at("records")));
            borders.push_back(block_from(cell.at("borders")));
        }
        Tree tree;
        if (!tree.restore(depths)) return {};
        const std::size_t damaged =
            is_beside_others() ? 0
                               : count_damaged(records_file, records) + count_damaged(borders_file, borders);
        if (damaged > 0) {
            why = fmt::format("{} of the {} cells in '{}' {} damaged", damaged, depths.size(),
                              folder_.path().generic_string(), damaged == 1 ? "is" : "are");
            return {};
        }
        const auto opened = [&](const char* name) {
            return std::make_unique<BlockFile>(folder_.file(name), BlockFile::Named::as_it_is);
        };
        return std::make_unique<Partition>(
            source_, Partition::Stored{std::move(tree), manifest.at("faces").get<std::uint64_t>(),
                                       SpillFile(opened(records_file), records),
                                       std::make_unique<Borders>(manifest.at("vertices").get<std::uint64_t>(),
                                                                 SpillFile(opened(borders_file), borders))});
    }

    /// Throws an output error (E-WRITE) if the file is missing.
    std::size_t count_damaged(const char* name, const std::vector<Block>& blocks) const {
        const BlockFile file(folder_.file(name), BlockFile::Named::as_it_is);
        return static_cast<std::size_t>(std::count_if(
            blocks.begin(), blocks.end(), [&](const Block& block) { return !file.is_as_written(block); }));
    }

    std::unique_ptr<Partition> make() {
        const auto written = folder_.time_of(manifest_file);
        knew_inputs_ = false; // the inputs are read
        for (const std::string& name : folder_.names(manifest_file)) folder_.remove(name);
        auto partition = std::make_unique<Partition>(source_, means_, most_);
        std::vector<Block> records, borders;
        partition->store(folder_.file(records_file), folder_.file(borders_file), folder_.syncs(), records,
                         borders);
        Json manifest = origin();
        manifest["faces"] = partition->faces();
        manifest["vertices"] = partition->vertices();
        manifest["bounds"] = box_json(source_->contents().bounds);
        manifest["record_bytes"] = source_->record_size();
        if (source_->contents().skipped_faces > 0)
            manifest["skipped_faces"] = source_->contents().skipped_faces;
        const std::vector<std::uint8_t> depths = partition->tree().depths();
        Json& cells = manifest["cells"] = Json::array();
        for (std::uint32_t leaf = 0; leaf < depths.size(); ++leaf) {
            const Cell cell = partition->cell(leaf);
            cells.push_back({{"depth", depths[leaf]},
                             {"faces", cell.mesh.face_count()},
                             {"vertices", cell.names.size()},
                             {"shared_vertices",
                              cell.names.size() - static_cast<std::size_t>(std::count(
                                                      cell.home.begin(), cell.home.end(), Cell::inner))},
                             {"bounds", box_json(cell.mesh.bounds())},
                             {"records", block_json(records[leaf])},
                             {"borders", block_json(borders[leaf])}});
        }
        require_as_opened(source_->contents().files);
        manifest["sha256"] = digest_of(manifest);
        const std::string text = manifest.dump(1) + "\n";
        folder_.write(manifest_file, {std::as_bytes(std::span(text))});
        if (!means_.job &&
            manifest ==
                same_origin_) // prevents a workflow from redoing results that others made from these cells
            for (const char* name : kept_files) folder_.set_time(name, written);
        return partition;
    }

    std::shared_ptr<FaceSource> source_;
    const CellResources& means_;
    const CellFolder& folder_;
    std::uint64_t most_;
    InputStamps stamps_;
    bool knew_inputs_ = false; ///< the digests are known without reading the inputs
    Json same_origin_;         ///< the manifest of the same origin with damaged cells
};

} // namespace

std::unique_ptr<Partition> kept_partition(std::shared_ptr<FaceSource> source, const CellResources& means,
                                          std::uint64_t most) {
    if (!means.kept) return std::make_unique<Partition>(std::move(source), means, most);
    return PartitionKeeper(std::move(source), means, most).partition();
}

void make_cells_due(const CellFolder& folder, const std::string& why) {
    folder.remove(manifest_file);
    throw Error(ErrorKind::output, "E-SCRATCH", why, "run the workflow again, which makes the cells first");
}

} // namespace facetmill::cells
