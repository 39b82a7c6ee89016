#include "base/parallel.h"

#include <exception>
#include <system_error>
#include <thread>
#include <utility>

#include "base/progress.h"
#include "base/spin_wait.h"

namespace fairing {

namespace {

// The most threads by default (more bring little, since parts of every solve are serial), and by the caller's wish.
constexpr int most_chosen = 8;
constexpr int most_asked = 64;

int wanted_threads(int count) {
    if (count > 0) return std::min(count, most_asked);
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most_chosen);
}

// The team of this thread, taken away for as long as it works on a loop.
class Taken {
public:
    Taken() { ThreadTeam::current = nullptr; }
    ~Taken() { ThreadTeam::current = team; }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

    ThreadTeam* const team = ThreadTeam::current;
};

}  // namespace

constinit thread_local ThreadTeam* ThreadTeam::current = nullptr;

// One loop, shared by those who work on it.
class ThreadTeam::Job {
public:
    Job(int pieces, const std::function<void(int)>& piece) : pieces_(pieces), piece_(piece), stop_(stop_flag()) {}

    void work() noexcept {
        for (int k = next_++; k < pieces_; k = next_++) {
            try {
                piece_(k);
                checkpoint();
            } catch (...) {
                next_ = pieces_;
                const std::scoped_lock lock(mutex_);
                if (!error_) error_ = std::current_exception();
            }
        }
    }

    // A helper's checkpoints look at the flag of the thread whose loop it is.
    void help() noexcept {
        const Checkpoints checkpoints(stop_);
        work();
    }

    void rethrow() const {
        if (!error_) return;
        throw_if_stopped();  // what the callback has thrown, rather than that a helper has seen the flag
        std::rethrow_exception(error_);
    }

private:
    const int pieces_;
    const std::function<void(int)>& piece_;
    const StopFlag* const stop_;
    std::atomic<int> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr error_;
};

ThreadTeam::~ThreadTeam() {
    {
        const std::scoped_lock lock(mutex_);
        ends_ = true;
    }
    ++posted_;
    wake_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
}

void ThreadTeam::run(int pieces, const std::function<void(int)>& piece) {
    Job job(pieces, piece);
    start_helpers();
    post([&] {
        job_ = &job;
        ++generation_;
    });
    job.work();
    {
        const std::scoped_lock lock(mutex_);
        job_ = nullptr;
    }
    wait_for_helpers();
    job.rethrow();
}

void ThreadTeam::wait_for_helpers() noexcept {
    const auto is_idle = [this] { return working_ == 0; };
    if (SpinWait::until(is_idle)) return;
    ask_whether_to_stop();
    std::unique_lock lock(mutex_);
    while (!idle_.wait_for(lock, between_looks, is_idle)) {
        lock.unlock();
        ask_whether_to_stop();
        lock.lock();
    }
}

void ThreadTeam::send(std::shared_ptr<BackgroundTask::Work> work) {
    start_helpers();
    post([&] { works_.push_back(std::move(work)); });
}

void ThreadTeam::start_helpers() {
    for (; helpers_wanted_ > 0; --helpers_wanted_) {
        try {
            helpers_.emplace_back([this] { help(); });
        } catch (const std::system_error&) {
            helpers_wanted_ = 0;  // the system has no more threads for us: fewer do it too
            return;
        }
    }
}

// change(): of what helpers find to do.
template <typename Change>
void ThreadTeam::post(const Change& change) {
    bool asleep = false;
    {
        const std::scoped_lock lock(mutex_);
        change();
        asleep = asleep_ > 0;
    }
    ++posted_;  // without the lock, which who looks on takes next
    if (asleep) wake_.notify_all();
}

void ThreadTeam::help() noexcept {
    unsigned seen = 0;
    unsigned looked = 0;
    while (true) {
        const bool news = SpinWait::until([&] { return posted_ != looked; });
        std::unique_lock lock(mutex_);
        looked = posted_;
        const auto is_wanted = [&] { return ends_ || !works_.empty() || (job_ && generation_ != seen); };
        if (!is_wanted()) {
            if (news) continue;
            ++asleep_;
            wake_.wait(lock, is_wanted);
            --asleep_;
        }
        if (ends_) return;
        works_.empty() ? help_with_job(lock, seen) : do_work(lock);
    }
}

void ThreadTeam::help_with_job(std::unique_lock<std::mutex>& lock, unsigned& seen) {
    seen = generation_;
    Job& job = *job_;
    ++working_;
    lock.unlock();
    job.help();
    lock.lock();
    if (--working_ == 0) idle_.notify_all();
}

void ThreadTeam::do_work(std::unique_lock<std::mutex>& lock) {
    const std::shared_ptr<BackgroundTask::Work> work = std::move(works_.front());
    works_.pop_front();
    lock.unlock();
    if (work->take()) work->do_on_helper();
}

Threads::Threads(int count)
    : team_(std::make_unique<ThreadTeam>(wanted_threads(count))), previous_(ThreadTeam::current) {
    ThreadTeam::current = team_.get();
}

Threads::~Threads() { ThreadTeam::current = previous_; }

void run_pieces(int pieces, const std::function<void(int)>& piece) {
    const Taken taken;
    if (taken.team && pieces > 1) {
        taken.team->run(pieces, piece);
        return;
    }
    for (int k = 0; k < pieces; ++k) {
        piece(k);
        checkpoint();
    }
}

}  // namespace fairing
