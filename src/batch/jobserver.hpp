#pragma once
// The jobserver of GNU make: tokens shared by all that a make runs, one for each job beyond a program's
// first.

#include "platform/descriptor.hpp"

#include <memory>
#include <mutex>
#include <string>

namespace facetmill::batch {

class Jobserver {
  public:
    /// What these MAKEFLAGS offer (--jobserver-auth=fifo:PATH or R,W; --jobserver-fds=R,W of older makes), or
    /// null: when they offer none, or the descriptors were not passed on (a recipe without +).
    static std::unique_ptr<Jobserver> offered(const std::string& makeflags);
    ~Jobserver(); ///< gives all back
    Jobserver(const Jobserver&) = delete;
    Jobserver& operator=(const Jobserver&) = delete;

    /// Takes a token if one is available.
    bool take();
    void give();
    void give_all();

  private:
    Jobserver(Descriptor in, Descriptor out) : in_(std::move(in)), out_(std::move(out)) {}
    Descriptor in_, out_;
    std::mutex guard_;
    std::string tokens_; ///< what was taken: a token goes back as it was
};

/// The FIFO that these MAKEFLAGS name; empty for none.
std::string jobserver_file(const std::string& makeflags);

} // namespace facetmill::batch
