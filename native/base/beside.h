// Work beside a thread's own, by one of the helpers of its `Threads`.
#pragma once

#include <functional>
#include <memory>

namespace fairing {

class Errand;

// Work that a helper may do beside the caller's thread; loops go on without that helper meanwhile. What it reads has to
// stay as it is until it is finished.
class Beside {
public:
    Beside() = default;  // no work
    // Loops within the work run on its own thread.
    explicit Beside(std::function<void()> work);
    Beside(Beside&&) = default;
    Beside& operator=(Beside&&) = default;
    // Work that no one has asked for stops at its next checkpoint.
    ~Beside();

    // Does the work here where no one has begun it, and waits for it otherwise. Its exception comes through.
    void finish();

private:
    std::shared_ptr<Errand> errand_;
};

}  // namespace fairing
