#include "base/progress.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "base/errors.h"

namespace fairing {

struct Progress::Shared {
    ProgressCallback callback;
    double last = 0.0;
    std::string stage = {};
};

Progress::Progress(ProgressCallback callback) {
    if (callback) shared_ = std::make_shared<Shared>(Shared{std::move(callback)});
}

void Progress::report(double fraction, std::string_view stage) const {
    if (!shared_) return;
    const double inside = begin_ + (end_ - begin_) * std::clamp(fraction, 0.0, 1.0);
    // A stage that only asks (an empty range) leaves the fraction where it is.
    shared_->last = std::max(shared_->last, inside);
    shared_->stage = stage;
    if (!shared_->callback(shared_->last, stage)) throw Cancelled();
}

Progress Progress::range(double begin, double end) const {
    Progress inner = *this;
    inner.begin_ = begin_ + (end_ - begin_) * begin;
    inner.end_ = begin_ + (end_ - begin_) * end;
    return inner;
}

Progress Progress::here() const { return range(0.0, 0.0); }

void Progress::ask() const {
    if (shared_ && !shared_->callback(shared_->last, shared_->stage)) throw Cancelled();
}

struct Checkpoints::Watch {
    using Clock = std::chrono::steady_clock;
    const Progress& progress;
    Clock::time_point asked = Clock::now();
};

thread_local Checkpoints::Watch* Checkpoints::current = nullptr;

Checkpoints::Checkpoints(const Progress& progress)
    : watch_(std::make_unique<Watch>(Watch{progress})), previous_(current) {
    current = watch_.get();
}

Checkpoints::~Checkpoints() { current = previous_; }

void checkpoint() {
    constexpr std::chrono::milliseconds between{50};
    Checkpoints::Watch* const watch = Checkpoints::current;
    if (!watch) return;
    const auto now = Checkpoints::Watch::Clock::now();
    if (now - watch->asked < between) return;
    watch->asked = now;
    watch->progress.ask();
}

}  // namespace fairing
