#pragma once
// The jobserver of GNU make: tokens shared by all processes of a make, one for each job beyond a program's
// first.

#include <memory>
#include <mutex>
#include <string>

namespace facetmill::batch {

class Jobserver {
  public:
    /// The jobserver in these MAKEFLAGS (--jobserver-auth=fifo:PATH or R,W; --jobserver-fds=R,W of older
    /// makes). Null without a jobserver, or if the descriptors are closed (a recipe without +).
    static std::unique_ptr<Jobserver> offered(const std::string& makeflags);
    ~Jobserver(); ///< returns all tokens
    Jobserver(const Jobserver&) = delete;
    Jobserver& operator=(const Jobserver&) = delete;

    /// Takes a token if any is available.
    bool take();
    void give();
    void give_all();

  private:
    Jobserver(int in, int out) : in_(in), out_(out) {}
    int in_, out_;
    std::mutex guard_;
    std::string tokens_; ///< the tokens taken: each must be returned unchanged
};

/// The FIFO in these MAKEFLAGS; empty without one.
std::string jobserver_file(const std::string& makeflags);

} // namespace facetmill::batch
