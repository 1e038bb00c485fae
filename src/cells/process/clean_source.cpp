#include "cells/process/clean_source.hpp"

#include "base/sort_unique.hpp"
#include "cells/sources/pieces.hpp"
#include "cells/sources/unite.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace facetmill::cells {

namespace {

constexpr std::size_t number_size = sizeof(std::uint32_t);

std::uint32_t number_in(io::Span record) {
    std::uint32_t number = 0;
    std::memcpy(&number, record.data() + record.size() - number_size, number_size);
    return number;
}

void unite_all(Piece& piece) {
    std::vector<Index> all(piece.mesh.vertex_count());
    std::iota(all.begin(), all.end(), Index{0});
    unite(piece.mesh, piece.names, std::move(all));
}

class NumberedSource final : public FaceSource {
  public:
    NumberedSource(std::shared_ptr<FaceSource> plain, bool by_place)
        : FaceSource(plain->contents()), plain_(std::move(plain)), by_place_(by_place) {
        own_contents().vertices = 0; // faces use all vertices
    }

    std::size_t record_size() const override { return plain_->record_size() + number_size; }

    void each(const Take& take, std::size_t memory) override {
        Numbered numbered(record_size());
        plain_->each([&](const Vec3& centre, io::Span record) { take(centre, numbered.next(record)); },
                     memory);
    }

    void each_record(const TakeRecord& take, std::size_t memory) override {
        Numbered numbered(record_size());
        plain_->each_record([&](io::Span record) { take(numbered.next(record)); }, memory);
    }

    Piece piece(io::Span records) const override {
        Piece piece = plain_->piece(plain_records(*this, records));
        if (!by_place_) return piece;
        for (std::size_t v = 0; v < piece.names.size(); ++v)
            piece.names[v] = name_of_place(piece.mesh.positions[v]);
        unite_all(piece);
        return piece;
    }

    std::vector<std::uint64_t> names(io::Span records) const override {
        if (!by_place_) return plain_->names(plain_records(*this, records));
        return sorted_once(piece(records).names);
    }

  private:
    /// Records followed by their numbers.
    class Numbered {
      public:
        explicit Numbered(std::size_t size) : bytes_(size) {}
        io::Span next(io::Span record) {
            std::copy(record.begin(), record.end(), bytes_.begin());
            std::memcpy(bytes_.data() + record.size(), &number_, number_size);
            ++number_;
            return bytes_;
        }

      private:
        io::Bytes bytes_;
        std::uint32_t number_ = 0;
    };

    std::shared_ptr<FaceSource> plain_;
    bool by_place_;
};

class ReplacedSource final : public FaceSource {
  public:
    ReplacedSource(std::shared_ptr<FaceSource> numbered, std::uint32_t faces, Replacement by)
        : FaceSource(numbered->contents()), numbered_(std::move(numbered)), faces_(faces),
          by_(std::move(by)) {
        own_contents().bounds = by_.bounds;
    }

    std::size_t record_size() const override { return numbered_->record_size(); }

    void each(const Take& take, std::size_t memory) override {
        Gone gone(by_.gone);
        numbered_->each(
            [&](const Vec3& centre, io::Span record) {
                if (!gone.has(record)) take(centre, record);
            },
            memory);
        each_that_comes([&](Index face, io::Span record) { take(centre_of(by_.come.mesh, face), record); });
    }

    void each_record(const TakeRecord& take, std::size_t memory) override {
        Gone gone(by_.gone);
        numbered_->each_record(
            [&](io::Span record) {
                if (!gone.has(record)) take(record);
            },
            memory);
        each_that_comes([&](Index, io::Span record) { take(record); });
    }

    Piece piece(io::Span records) const override {
        io::Bytes stay;
        std::vector<Index> come;
        std::vector<bool> stays;
        for (std::size_t size = record_size(); !records.empty(); records = records.subspan(size)) {
            const io::Span record = records.first(size);
            const std::uint32_t number = number_in(record);
            stays.push_back(number < faces_);
            if (number < faces_)
                stay.insert(stay.end(), record.begin(), record.end());
            else
                come.push_back(number - faces_);
        }
        if (come.empty()) return numbered_->piece(stay);
        Piece fresh = some_faces(by_.come, come);
        if (stay.empty()) return fresh;
        return mixed(numbered_->piece(stay), fresh, stays);
    }

    std::vector<std::uint64_t> names(io::Span records) const override {
        return sorted_once(piece(records).names);
    }

  private:
    /// Finds out whether faces are removed. Faces must be queried in order.
    class Gone {
      public:
        explicit Gone(const std::vector<std::uint32_t>& numbers)
            : next_(numbers.begin()), end_(numbers.end()) {}
        bool has(io::Span record) {
            const bool is_gone = next_ != end_ && *next_ == number_in(record);
            if (is_gone) ++next_;
            return is_gone;
        }

      private:
        std::vector<std::uint32_t>::const_iterator next_, end_;
    };

    /// Calls take(face, record).
    template <class TakeFace>
    void each_that_comes(TakeFace&& take) const {
        io::Bytes record(record_size());
        for (Index f = 0; f < by_.come.mesh.face_count(); ++f) {
            const std::uint32_t number = faces_ + f;
            std::memcpy(record.data() + record.size() - number_size, &number, number_size);
            take(f, record);
        }
    }

    /// Merges both pieces. `first` gives the order: whether the next face comes from the first piece.
    static Piece mixed(Piece all, const Piece& more, const std::vector<bool>& first) {
        std::size_t of_first = 0, of_more = all.mesh.corners.size();
        append(all.mesh, more.mesh);
        all.names.insert(all.names.end(), more.names.begin(), more.names.end());
        std::vector<Index> corners;
        corners.reserve(all.mesh.corners.size());
        for (const bool is_first : first) {
            std::size_t& at = is_first ? of_first : of_more;
            for (const std::size_t end = at + 3; at < end; ++at) corners.push_back(all.mesh.corners[at]);
        }
        all.mesh.corners = std::move(corners);
        unite_all(all);
        return all;
    }

    std::shared_ptr<FaceSource> numbered_;
    std::uint32_t faces_;
    Replacement by_;
};

} // namespace

std::shared_ptr<FaceSource> numbered_source(std::shared_ptr<FaceSource> plain, bool by_place) {
    return std::make_shared<NumberedSource>(std::move(plain), by_place);
}

std::vector<std::uint32_t> numbers_in(const FaceSource& numbered, io::Span records) {
    std::vector<std::uint32_t> numbers;
    for (const std::size_t size = numbered.record_size(); !records.empty(); records = records.subspan(size))
        numbers.push_back(number_in(records.first(size)));
    return numbers;
}

io::Bytes plain_records(const FaceSource& numbered, io::Span records) {
    const std::size_t size = numbered.record_size();
    io::Bytes plain;
    plain.reserve(records.size());
    for (; !records.empty(); records = records.subspan(size))
        plain.insert(plain.end(), records.begin(),
                     records.begin() + static_cast<std::ptrdiff_t>(size - number_size));
    return plain;
}

std::shared_ptr<FaceSource> replaced_source(std::shared_ptr<FaceSource> numbered, std::uint32_t faces,
                                            Replacement by) {
    return std::make_shared<ReplacedSource>(std::move(numbered), faces, std::move(by));
}

} // namespace facetmill::cells
