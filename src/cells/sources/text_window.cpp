#include "cells/sources/text_window.hpp"

#include <cstring>
#include <fmt/format.h>

namespace facetmill::cells {

TextWindow::TextWindow(const ReadFile& file, std::uint64_t begin, std::uint64_t end, const std::string& name,
                       const char* id, char comment, Sha256* sum, std::int64_t line)
    : name_(name), id_(id), comment_(comment), stream_(file, begin, end, sum), left_(end - begin),
      text_({}, name, id, comment, line) {
    move(usual);
}

/// Moves the remaining text to the beginning of the window and fills the window to `size`.
void TextWindow::move(std::size_t size) {
    constexpr std::size_t most = std::size_t{1} << 26;
    const std::size_t kept = text_.left();
    if (kept >= most)
        io::beyond_limit(
            name_, fmt::format("a face or line behind line {} is longer than {} bytes", text_.line(), most));
    if (kept > 0) std::memmove(window_.data(), window_.data() + text_.offset(), kept);
    const auto more =
        static_cast<std::size_t>(std::min<std::uint64_t>(left_, std::max(size, kept + usual / 2) - kept));
    window_.resize(kept + more);
    if (more > 0) std::memcpy(window_.data() + kept, stream_.take(more), more);
    left_ -= more;
    text_ = io::Text({window_.data(), window_.size()}, name_, id_, comment_, text_.line());
}

} // namespace facetmill::cells
