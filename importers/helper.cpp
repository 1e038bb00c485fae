#include "helper.hpp"

#include "platform/descriptor.hpp"
#include "platform/file_bytes.hpp"
#include "platform/file_status.hpp"
#include "platform/sandbox.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
/// AddressSanitizer asks this. Open CASCADE and assimp keep memory until the process ends, which is soon.
extern "C" int __lsan_is_turned_off() { return 1; }
#endif

namespace importers {

namespace {

constexpr int float_type = 5126, short_type = 5123, int_type = 5125, index_target = 34963;

std::size_t components(std::string_view type) {
    return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type.back() - '0');
}

std::string little_endian(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
}

Options options_of(std::span<char*> arguments) {
    Options options;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string_view option = arguments[i];
        if (option == "--keep-unit" || option == "--keep-up") {
            (option == "--keep-unit" ? options.keep_unit : options.keep_up) = true;
            continue;
        }
        if (i + 1 == arguments.size()) throw std::runtime_error("an option has no value");
        const char* value = arguments[++i];
        if (option == "--format") options.format = value;
        if (option == "--name") options.name = value;
        if (option == "--folder") options.folders.emplace_back(value);
        if (option == "--deviation") options.deviation = std::strtod(value, nullptr);
        if (option == "--ratio") options.ratio = std::strtod(value, nullptr);
        if (option == "--angle") options.degrees = std::strtod(value, nullptr);
        if (option == "--unit") options.unit = std::strtod(value, nullptr);
    }
    return options;
}

std::string standard_input() {
    const facetmill::Descriptor file = facetmill::Descriptor::standard_input();
    const auto about = facetmill::status_of(file);
    std::string all(about ? static_cast<std::size_t>(about->stamp.bytes) : 0, '\0');
    all.resize(facetmill::read_whole(file, std::as_writable_bytes(std::span(all))));
    return all;
}

void send(const facetmill::Descriptor& output, std::string_view text) {
    auto bytes = std::as_bytes(std::span(text));
    while (!bytes.empty()) {
        const auto done = facetmill::write_some(output, bytes);
        if (!done) throw std::runtime_error("the output cannot be written");
        bytes = bytes.subspan(*done);
    }
}

} // namespace

void Notes::add(const char* list, std::string text) {
    Json& all = json_[list];
    if (all.is_null()) all = Json::array();
    if (std::find(all.begin(), all.end(), Json(text)) == all.end()) all.push_back(std::move(text));
}

Glb::Glb()
    : json({{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", Json::array()}}}}}) {}

int Glb::add(const char* list, Json item) {
    Json& all = json[list];
    if (all.is_null()) all = Json::array();
    all.push_back(std::move(item));
    return static_cast<int>(all.size()) - 1;
}

int Glb::view(std::span<const std::byte> bytes, int target) {
    constexpr std::size_t aligned = 4;
    buffer_.resize((buffer_.size() + aligned - 1) / aligned * aligned);
    Json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return add("bufferViews", std::move(view));
}

int Glb::floats(const std::vector<float>& values, const char* type, int target, bool bounds) {
    const std::size_t width = components(type);
    Json accessor = {{"bufferView", view(std::as_bytes(std::span(values)), target)},
                     {"componentType", float_type},
                     {"count", values.size() / width},
                     {"type", type}};
    if (bounds) {
        std::vector<float> low(width, std::numeric_limits<float>::max()),
            high(width, std::numeric_limits<float>::lowest());
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!std::isfinite(values[i])) continue;
            low[i % width] = std::min(low[i % width], values[i]);
            high[i % width] = std::max(high[i % width], values[i]);
        }
        accessor["min"] = low;
        accessor["max"] = high;
    }
    return add("accessors", std::move(accessor));
}

int Glb::shorts(const std::vector<std::uint16_t>& values, const char* type, bool normalised) {
    Json accessor = {{"bufferView", view(std::as_bytes(std::span(values)), vertex_target)},
                     {"componentType", short_type},
                     {"count", values.size() / components(type)},
                     {"type", type}};
    if (normalised) accessor["normalized"] = true;
    return add("accessors", std::move(accessor));
}

int Glb::indices(const std::vector<std::uint32_t>& values) {
    return add("accessors", {{"bufferView", view(std::as_bytes(std::span(values)), index_target)},
                             {"componentType", int_type},
                             {"count", values.size()},
                             {"type", "SCALAR"}});
}

void Glb::use_extension(const char* name) {
    Json& used = json["extensionsUsed"];
    if (used.is_null()) used = Json::array();
    if (std::find(used.begin(), used.end(), Json(name)) == used.end()) used.push_back(name);
}

std::string Glb::container() {
    constexpr std::size_t aligned = 4;
    constexpr int size = 4;
    if (!buffer_.empty()) json["buffers"] = {{{"byteLength", buffer_.size()}}};
    if (json["scenes"][0]["nodes"].empty()) json["scenes"][0].erase("nodes");
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + aligned - 1) / aligned * aligned, ' ');
    std::string data = buffer_;
    data.resize((data.size() + aligned - 1) / aligned * aligned);
    const std::size_t head = 12, chunk = 8;
    const std::size_t all = head + chunk + text.size() + (data.empty() ? 0 : chunk + data.size());
    if (all > std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error("it is too large for a GLB");
    std::string glb = "glTF" + little_endian(2, size) + little_endian(all, size);
    glb += little_endian(text.size(), size) + "JSON" + text;
    if (!data.empty()) glb += little_endian(data.size(), size) + std::string("BIN\0", size) + data;
    return glb;
}

int run(int count, char** arguments,
        const std::function<void(const Options&, const std::string& file, Glb&, Notes&)>& convert) {
    // Libraries print to standard output, which is the stream: they get standard error instead.
    const facetmill::Descriptor output = facetmill::duplicate(facetmill::Descriptor::standard_output());
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    Notes notes;
    Json error;
    std::string glb;
    try {
        const Options options = options_of(std::span(arguments, static_cast<std::size_t>(count)).subspan(1));
        const std::string file = standard_input();
        facetmill::confine_calls();
        Glb document;
        convert(options, file, document, notes);
        glb = document.container();
    } catch (const std::bad_alloc&) {
        error = "it needs more memory than is allowed";
    } catch (const std::exception& e) {
        error = e.what();
    }
    Json all = notes.json();
    if (!error.is_null()) all = {{"error", error}};
    const std::string text = all.dump(-1, ' ', false, Json::error_handler_t::replace);
    constexpr int size_bytes = 8;
    send(output, "FMIMPORT" + little_endian(text.size(), size_bytes));
    send(output, text);
    send(output, glb);
    return 0;
}

} // namespace importers
