#pragma once
// Open files.

#include <filesystem>
#include <utility>

namespace facetmill {

/// A file descriptor, closed by the destructor. It is false if opening failed; errno gives the reason.
class Descriptor {
  public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    /// Does not close the file: for standard output, or a descriptor passed to this process.
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
    /// Network file systems report a full disk only here, by false and errno.
    bool close() noexcept;

  private:
    int number_ = -1;
    bool is_borrowed_ = false;
};

enum class OpenFor { reading, writing, both };
enum class Create { no, if_missing, always }; ///< `always`: an existing file is an error

struct OpenOptions {
    OpenFor what = OpenFor::reading;
    Create create = Create::no;
    bool truncates = false;
    bool appends = false;
    bool follows_links = true;
    bool waits = true; ///< waits for the other end of a pipe, and for its bytes
    bool is_folder = false;
    unsigned permissions = 0666; ///< permissions of a new file
};

/// Programs that this process starts do not inherit the file; forked processes (start_worker) do.
[[nodiscard]] Descriptor open_file(const std::filesystem::path& path, const OpenOptions& options = {});

/// A second descriptor of the same open file, which shares its locks.
[[nodiscard]] Descriptor duplicate(const Descriptor& file);

} // namespace facetmill
