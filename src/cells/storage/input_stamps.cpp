#include "cells/storage/input_stamps.hpp"

#include "base/hash.hpp"
#include "base/json.hpp"

#include <algorithm>
#include <chrono>

namespace facetmill::cells {

namespace {

std::string digest_of_text(const std::string& text) { return sha256(std::as_bytes(std::span(text))); }

Json stamp_json(const FileStamp& stamp) {
    return {{"bytes", stamp.bytes},
            {"device", stamp.device},
            {"inode", stamp.inode},
            {"modified", stamp.modified},
            {"changed", stamp.changed}};
}

} // namespace

std::int64_t InputStamps::now() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
}

InputStamps::InputStamps(const std::vector<FaceSource::File>& files, std::int64_t now) : now_(now) {
    for (const auto& each : files)
        if (each.file && each.file->stamp()) stamps_.push_back(*each.file->stamp());
}

std::vector<std::string> InputStamps::digests(const CellFolder& folder) const {
    const std::optional<io::Bytes> text = folder.read(file);
    if (!text) return {};
    const Json all = parse_json(io::as_text(*text), Broken::discarded);
    if (!all.is_object() || !all.contains("files") || !all["files"].is_array() || !all.contains("sha256") ||
        all["sha256"] != digest_of_text(all["files"].dump()) || all["files"].size() != stamps_.size())
        return {};
    std::vector<std::string> digests;
    for (std::size_t i = 0; i < stamps_.size(); ++i) {
        const Json& its = all["files"][i];
        if (!its.is_object() || its.value("stamp", Json()) != stamp_json(stamps_[i])) return {};
        const Json digest = its.value("sha256", Json());
        if (!digest.is_string()) return {};
        digests.push_back(digest.get<std::string>());
    }
    return digests;
}

void InputStamps::store(const CellFolder& folder, const std::vector<FaceSource::File>& files) const {
    const auto is_as_opened = [](const FaceSource::File& each) { return each.file->is_as_opened(); };
    if (stamps_.size() != files.size() || !std::all_of(files.begin(), files.end(), is_as_opened) ||
        !std::all_of(stamps_.begin(), stamps_.end(),
                     [&](const FileStamp& stamp) { return stamp.is_settled(now_); }))
        return folder.remove(file);
    Json all;
    for (std::size_t i = 0; i < files.size(); ++i)
        all["files"].push_back({{"stamp", stamp_json(stamps_[i])}, {"sha256", files[i].sha256}});
    all["sha256"] = digest_of_text(all["files"].dump());
    const std::string text = all.dump(1) + "\n";
    try {
        folder.write(file, {std::as_bytes(std::span(text))});
    } catch (const Error&) { // if, for example, the disk is full, the next run reads the files again
        folder.remove(std::string(file) + ".part");
        folder.remove(file);
    }
}

} // namespace facetmill::cells
