#include "base/progress.h"

#include <algorithm>
#include <utility>

#include "base/errors.h"

namespace fairing {

struct Progress::Shared {
    ProgressCallback callback;
    double last = 0.0;
};

Progress::Progress(ProgressCallback callback) {
    if (callback) shared_ = std::make_shared<Shared>(Shared{std::move(callback)});
}

void Progress::report(double fraction, std::string_view stage) const {
    if (!shared_) return;
    const double inside = begin_ + (end_ - begin_) * std::clamp(fraction, 0.0, 1.0);
    // A stage that only asks (an empty range) leaves the fraction where it is.
    shared_->last = std::max(shared_->last, inside);
    if (!shared_->callback(shared_->last, stage)) throw Cancelled();
}

Progress Progress::range(double begin, double end) const {
    Progress inner = *this;
    inner.begin_ = begin_ + (end_ - begin_) * begin;
    inner.end_ = begin_ + (end_ - begin_) * end;
    return inner;
}

Progress Progress::here() const { return range(0.0, 0.0); }

}  // namespace fairing
