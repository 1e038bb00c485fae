#pragma once
// A text file of any size, read item by item through a sliding window in memory.

#include "cells/storage/stream.hpp"
#include "io/text.hpp"

namespace facetmill::cells {

class TextWindow {
  public:
    /// Reads from byte `begin`, which is in line `line`, to byte `end`. id, comment: see io::Text. sum:
    /// receives all bytes from `begin` on; may be null. name must outlive the window.
    TextWindow(const ReadFile& file, std::uint64_t begin, std::uint64_t end, const std::string& name,
               const char* id, char comment, Sha256* sum, std::int64_t line = 1);

    /// Calls parse(io::Text&) at the end of the previous item. An item that does not fit the window is
    /// parsed again, so parse must reset all of its results. Throws the errors of parse, and a limit error
    /// (E-SIZE) for an item larger than the largest window.
    template <class Parse>
    void item(Parse&& parse) {
        if (text_.left() < low && left_ > 0) move(usual);
        while (true) {
            io::Text attempt = text_;
            try {
                parse(attempt);
            } catch (const Error&) {
                if (attempt.left() > 0 || left_ == 0) throw;
            }
            if (attempt.left() > 0 || left_ == 0) {
                text_ = attempt;
                return;
            }
            move(2 * (text_.left() + usual));
        }
    }
    bool at_end() {
        bool end = false;
        item([&](io::Text& text) { end = text.at_end(); });
        return end;
    }
    /// Bytes not yet parsed: the rest of the file.
    std::uint64_t left() const { return text_.left() + left_; }
    const io::Text& text() const { return text_; } ///< the text, for line numbers and messages

  private:
    static constexpr std::size_t usual = std::size_t{1} << 20, low = usual / 8;
    void move(std::size_t size);

    const std::string& name_;
    const char* id_;
    char comment_;
    Stream stream_;
    std::uint64_t left_; ///< bytes after the window
    std::vector<char> window_;
    io::Text text_;
};

} // namespace facetmill::cells
