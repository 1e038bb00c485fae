#pragma once
// Files that are open.

#include <filesystem>
#include <utility>

namespace facetmill {

/// An open file of the system, closed at the end. One that could not be opened is false, and errno says why.
class Descriptor {
  public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    /// One that stays open: standard output, or what was passed on to this process.
    static Descriptor borrowed(int number);
    static Descriptor standard_input() { return borrowed(0); }
    static Descriptor standard_output() { return borrowed(1); }
    Descriptor(Descriptor&& other) noexcept
        : number_(std::exchange(other.number_, -1)), is_borrowed_(other.is_borrowed_) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        std::swap(is_borrowed_, other.is_borrowed_);
        other.close();
        return *this;
    }
    ~Descriptor() { close(); }

    explicit operator bool() const { return number_ >= 0; }
    int number() const { return number_; }
    /// Network file systems report only here, by false and errno, that there is no room.
    bool close() noexcept;

  private:
    int number_ = -1;
    bool is_borrowed_ = false;
};

enum class OpenFor { reading, writing, both };
enum class Create { no, if_missing, always }; ///< always: what is there already is an error

struct OpenOptions {
    OpenFor what = OpenFor::reading;
    Create create = Create::no;
    bool truncates = false;
    bool appends = false;
    bool follows_links = true;
    bool waits = true; ///< for the other end of a pipe, and for its bytes
    bool is_folder = false;
    unsigned permissions = 0666; ///< of a file that is made
};

/// Programs that this process starts do not get the file.
Descriptor open_file(const std::filesystem::path& path, const OpenOptions& options = {});

/// A second one for the same open file, which shares its locks.
Descriptor duplicate(const Descriptor& file);

} // namespace facetmill
