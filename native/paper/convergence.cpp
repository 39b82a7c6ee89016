#include "paper/convergence.h"

#include <algorithm>
#include <cmath>

namespace fairing {

namespace {

constexpr std::size_t fewest_steps = 4;  // for a contraction
constexpr double fastest = 0.8;          // contraction

constexpr std::size_t window = 10;             // cycles over which contraction, growth or rest shows
constexpr double growth_of_alternation = 2.0;  // of the moves, over a window
constexpr double hardly_falling = 0.97;        // lowest merit of a window over that of the window before
constexpr double undone = 0.1;                 // part of the moves that is left when two updates undo each other
constexpr int undone_cycles = 5;               // one after the other
constexpr int patience = 50;                   // cycles without a hundredth less

}  // namespace

void RemainingChange::add(double step) {
    steps_.push_back(step);
    if (steps_.size() > window) steps_.pop_front();
    if (steps_.size() == fewest_steps && first_ == 0.0) first_ = estimate();
}

double RemainingChange::estimate() const {
    if (steps_.size() < fewest_steps) return std::numeric_limits<double>::infinity();
    // Accelerated steps fall unevenly: a single small one says little.
    const double last = *std::max_element(steps_.end() - 3, steps_.end());
    const double ratio = last / std::max(steps_.front(), 1e-300);
    const auto between = static_cast<double>(steps_.size() - 3);
    const double contraction = std::max(std::pow(ratio, 1.0 / between), fastest);
    return contraction < 1.0 ? last * contraction / (1.0 - contraction) : std::numeric_limits<double>::infinity();
}

double RemainingChange::share_done(double tolerance) const {
    const double now = estimate();
    if (!(now < first_) || !(tolerance < first_)) return 0.0;
    return std::min(1.0, std::log(first_ / std::max(now, 1e-300)) / std::log(first_ / tolerance));
}

Verdict ProgressWatch::judge(const Change& change) {
    const double merit = change.merit;
    if (!std::isfinite(merit)) return Verdict::lost;
    recent_.push_back(merit);
    if (recent_.size() > 2 * window) recent_.pop_front();
    ++since_mark_;
    if (merit < 0.99 * mark_) {
        mark_ = merit;
        since_mark_ = 0;
    }
    const bool better = merit < best_;
    best_ = std::min(best_, merit);
    const bool exhausted = since_mark_ > patience;
    if (exhausted || undoing(change) || growing() || resting()) return Verdict::alternating;
    return better ? Verdict::better : Verdict::fair;
}

void ProgressWatch::restart() {
    recent_.clear();
    restarted_ = true;
    mark_ = std::numeric_limits<double>::infinity();
    since_mark_ = 0;
    undone_ = 0;
}

bool ProgressWatch::undoing(const Change& change) {
    undone_ = change.together < undone * change.largest ? undone_ + 1 : 0;
    return accelerated_ && undone_ >= undone_cycles;
}

bool ProgressWatch::growing() const {
    return !accelerated_ && recent_.size() > window &&
           recent_.back() > growth_of_alternation * recent_[recent_.size() - 1 - window];
}

bool ProgressWatch::resting() const {
    if (accelerated_ || restarted_ || recent_.size() < 2 * window) return false;
    const auto middle = recent_.end() - static_cast<std::ptrdiff_t>(window);
    const double before = *std::min_element(recent_.begin(), middle);
    return *std::min_element(middle, recent_.end()) > hardly_falling * before;
}

}  // namespace fairing
