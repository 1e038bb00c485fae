#pragma once
// Opens a page with the desktop's browser.

#include "platform/descriptor.hpp"

#include <filesystem>

namespace facetmill {

/// A helper process that waits for the name of a page and becomes the program that opens it (xdg-open, or the
/// program in BROWSER). Start it before the sandbox forbids other programs, and before threads.
class PageOpener {
  public:
    /// Starts the helper, if there are a desktop (or BROWSER) and such a program.
    PageOpener();
    /// Whether the page was handed to the program. Its success is unknown.
    [[nodiscard]] bool open(const std::filesystem::path& page) const;

  private:
    Descriptor helper_;
};

} // namespace facetmill
