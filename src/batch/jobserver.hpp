#pragma once
// The jobserver of GNU make: tokens shared by all programs of a make run, one for each job beyond a program's
// first.

#include "platform/descriptor.hpp"

#include <memory>
#include <mutex>
#include <string>

namespace facetmill::batch {

class Jobserver {
  public:
    /// The jobserver in these MAKEFLAGS (--jobserver-auth=fifo:PATH or R,W; --jobserver-fds=R,W of older
    /// makes). Null if there is none, or if the descriptors were not inherited (a recipe without +).
    static std::unique_ptr<Jobserver> offered(const std::string& makeflags);
    ~Jobserver(); ///< returns all tokens
    Jobserver(const Jobserver&) = delete;
    Jobserver& operator=(const Jobserver&) = delete;

    /// Takes a token; false if none is available.
    bool take();
    void give();
    void give_all();

  private:
    Jobserver(Descriptor in, Descriptor out) : in_(std::move(in)), out_(std::move(out)) {}
    Descriptor in_, out_;
    std::mutex guard_;
    std::string tokens_; ///< taken tokens, which must be returned unchanged
};

/// The FIFO named in these MAKEFLAGS; empty if there is none.
[[nodiscard]] std::string jobserver_file(const std::string& makeflags);

} // namespace facetmill::batch
