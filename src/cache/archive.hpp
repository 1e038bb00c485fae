#pragma once
// Converts records to bytes and back. Each record lists its fields once, in its Members (cache/fields.hpp),
// for both directions. Counts are checked against the remaining bytes before allocation.

#include "base/json.hpp"
#include "base/math/vec.hpp"
#include "io/bytes.hpp"
#include "mesh/attribute.hpp"

#include <array>
#include <bit>
#include <concepts>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace facetmill::cache {

/// Lists the fields of a record. Each specialisation has static void each(auto& record, auto&& take), which
/// calls take(field, field, ...).
template <class T>
struct Members;

template <class T>
concept Record = requires(T& record) {
    Members<T>::each(record, [](auto&...) {});
};

/// The largest value of each enumeration that is stored.
template <class E>
inline constexpr E last = [] {
    static_assert(sizeof(E) == 0, "specialise it");
    return E{};
}();

template <class T>
concept Number = std::is_arithmetic_v<T>;

/// Thrown for truncated bytes, or bytes that ByteWriter did not write.
struct Corrupt : std::exception {
    const char* what() const noexcept override { return "the bytes differ from the written bytes"; }
};

/// Throws Corrupt for invalid CBOR, or nesting of more than 200 levels.
[[nodiscard]] Json json_of_cbor(io::Span cbor);

/// Points as arrays of three numbers; null for null.
[[nodiscard]] inline const double* coordinates(const Vec3* points) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    return reinterpret_cast<const double*>(points);
}
[[nodiscard]] inline double* coordinates(Vec3* points) { return reinterpret_cast<double*>(points); }

/// Writes numbers in the machine's byte order, because the data never leaves the machine.
class ByteWriter {
  public:
    io::Bytes bytes;

    ByteWriter() = default;
    /// Passes the bytes to `take` in pieces instead of collecting them. flush() passes the last piece.
    explicit ByteWriter(std::function<void(io::Span)> take) : take_(std::move(take)) {}
    void flush() {
        if (take_) take_(bytes);
        bytes.clear();
    }

    template <class... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }

  private:
    static constexpr std::size_t piece = std::size_t{1} << 20;

    /// Appends uninitialised bytes, and returns them.
    std::byte* room(std::size_t size) {
        if (take_ && bytes.size() + size > piece) flush();
        bytes.resize(bytes.size() + size);
        return bytes.data() + bytes.size() - size;
    }
    void raw(const void* from, std::size_t size) {
        const auto* begin = static_cast<const std::byte*>(from);
        if (take_ && size > piece) {
            flush();
            return take_({begin, size});
        }
        if (size > 0) std::memcpy(room(size), begin, size);
    }
    void count(std::size_t n) { put(static_cast<std::uint64_t>(n)); }

    template <Number T>
    void put(T value) {
        raw(&value, sizeof value);
    }
    template <class E>
    requires std::is_enum_v<E>
    void put(E value) { put(static_cast<std::uint8_t>(value)); }
    void put(const std::string& text) {
        count(text.size());
        raw(text.data(), text.size());
    }
    /// Writes JSON as CBOR.
    void put(const Json& json);
    template <Record R>
    void put(const R& record) {
        Members<R>::each(record, [this](const auto&... fields) { (put(fields), ...); });
    }
    template <class T>
    void put(const std::vector<T>& all) {
        count(all.size());
        if constexpr (std::is_same_v<T, double>)
            doubles(all.data(), all.size());
        else if constexpr (std::is_same_v<T, Vec3>)
            doubles(coordinates(all.data()), 3 * all.size());
        else if constexpr (std::is_same_v<T, std::uint32_t>)
            indices(all);
        else if constexpr (Number<T> || std::is_same_v<T, std::byte>)
            raw(all.data(), all.size() * sizeof(T));
        else
            for (const auto& one : all) put(one);
    }
    template <class T, std::size_t N>
    void put(const T (&all)[N]) {
        for (const auto& one : all) put(one);
    }
    template <class K, class V>
    void put(const std::map<K, V>& all) {
        count(all.size());
        for (const auto& [key, value] : all) (*this)(key, value);
    }
    template <class T>
    void put(const std::optional<T>& value) {
        put(value.has_value());
        if (value) put(*value);
    }
    template <class T>
    void put(const std::shared_ptr<const T>& value) {
        put(value != nullptr);
        if (value) put(*value);
    }
    void put(const AttributeData& data) {
        put(static_cast<std::uint8_t>(data.index()));
        std::visit([this](const auto& all) { put(all); }, data);
    }

    /// Writes doubles, as floats if that is lossless for all.
    void doubles(const double* from, std::size_t n);
    /// Writes indices with as few bytes per number as the largest needs.
    void indices(const std::vector<std::uint32_t>& all);

    std::function<void(io::Span)> take_;
};

/// Reads bytes. Throws Corrupt for bytes that a ByteWriter would not have written.
class ByteReader {
  public:
    explicit ByteReader(io::Span bytes) : left_(bytes) {}

    template <class... T>
    void operator()(T&... values) {
        (get(values), ...);
    }
    /// Checks that no bytes are left.
    void end() const {
        if (!left_.empty()) throw Corrupt();
    }

  private:
    io::Span take(std::size_t size) {
        if (size > left_.size()) throw Corrupt();
        const io::Span taken = left_.first(size);
        left_ = left_.subspan(size);
        return taken;
    }
    void raw(void* to, std::size_t size) {
        const io::Span from = take(size);
        if (size > 0) std::memcpy(to, from.data(), size);
    }
    /// Reads a count of items of at least `each` bytes.
    std::size_t count(std::size_t each) {
        std::uint64_t n = 0;
        get(n);
        if (n > left_.size() / each) throw Corrupt();
        return n;
    }

    template <Number T>
    void get(T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t byte = 0;
            raw(&byte, 1);
            if (byte > 1) throw Corrupt();
            value = byte == 1;
        } else
            raw(&value, sizeof value);
    }
    template <class E>
    requires std::is_enum_v<E>
    void get(E& value) {
        std::uint8_t byte = 0;
        get(byte);
        if (byte > static_cast<std::uint8_t>(last<E>)) throw Corrupt();
        value = static_cast<E>(byte);
    }
    void get(std::string& text) {
        text.resize(count(1));
        raw(text.data(), text.size());
    }
    void get(Json& json) { json = json_of_cbor(take(count(1))); }
    template <Record R>
    void get(R& record) {
        Members<R>::each(record, [this](auto&... fields) { (get(fields), ...); });
    }
    template <class T>
    void get(std::vector<T>& all) {
        if constexpr (std::is_same_v<T, double>) {
            all.resize(count(sizeof(float)));
            doubles(all.data(), all.size());
        } else if constexpr (std::is_same_v<T, Vec3>) {
            all.resize(count(3 * sizeof(float)));
            doubles(coordinates(all.data()), 3 * all.size());
        } else if constexpr (std::is_same_v<T, std::uint32_t>)
            indices(all);
        else if constexpr (Number<T> || std::is_same_v<T, std::byte>) {
            all.resize(count(sizeof(T)));
            raw(all.data(), all.size() * sizeof(T));
        } else {
            all.clear(); // adds items one by one, so that an excessive count stops at the end of the bytes
            for (std::size_t n = count(1); n > 0; --n) get(all.emplace_back());
        }
    }
    template <class T, std::size_t N>
    void get(T (&all)[N]) {
        for (auto& one : all) get(one);
    }
    template <class K, class V>
    void get(std::map<K, V>& all) {
        for (std::size_t n = count(1); n > 0; --n) {
            K key;
            get(key);
            get(all[std::move(key)]);
        }
    }
    template <class T>
    void get(std::optional<T>& value) {
        bool has = false;
        get(has);
        if (has) get(value.emplace());
    }
    template <class T>
    void get(std::shared_ptr<const T>& value) {
        bool has = false;
        get(has);
        if (!has) return;
        auto made = std::make_shared<T>();
        get(*made);
        value = std::move(made);
    }
    void get(AttributeData& data) {
        std::uint8_t index = 0;
        get(index);
        alternative<0>(data, index);
    }
    template <std::size_t I>
    void alternative(AttributeData& data, std::size_t index) {
        if constexpr (I == std::variant_size_v<AttributeData>)
            throw Corrupt();
        else if (index == I)
            get(data.emplace<I>());
        else
            alternative<I + 1>(data, index);
    }

    void doubles(double* to, std::size_t n);
    void indices(std::vector<std::uint32_t>& all);

    io::Span left_;
};

} // namespace facetmill::cache
