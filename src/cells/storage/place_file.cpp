#include "cells/storage/place_file.hpp"

#include "cells/storage/packed_numbers.hpp"

namespace facetmill::cells {

void PlaceFile::add(std::size_t place) {
    put_difference(last_, place, [&](std::byte byte) {
        file_.append(io::Span(&byte, 1));
        ++size_;
    });
    last_ = place;
}

std::size_t PlaceFile::Reader::next(std::size_t end) {
    last_ = take_difference(last_, [&] {
        if (bytes_.left() == 0) unreadable_scratch(scratch_);
        return *bytes_.take(1);
    });
    if (last_ >= end) unreadable_scratch(scratch_);
    return last_;
}

} // namespace facetmill::cells
