#include "base/parallel.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "base/progress.h"

namespace fairing {

namespace {

// Of our own choice: more bring little, since parts of every solve are serial. And of the caller's.
constexpr int most_chosen = 8;
constexpr int most_asked = 64;

int wanted_threads(int count) {
    if (count > 0) return std::min(count, most_asked);
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most_chosen);
}

// One loop, shared by those who work on it.
class Job {
public:
    Job(int pieces, const std::function<void(int)>& piece) : pieces_(pieces), piece_(piece) {}

    void work() {
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

    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

private:
    const int pieces_;
    const std::function<void(int)>& piece_;
    std::atomic<int> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr error_;
};

}  // namespace

class ThreadTeam {
public:
    explicit ThreadTeam(int count) : helpers_wanted_(count - 1) {}

    ~ThreadTeam() {
        {
            const std::scoped_lock lock(mutex_);
            ends_ = true;
        }
        wake_.notify_all();
        for (std::thread& helper : helpers_) helper.join();
    }

    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    // Doesn't wait for helpers that have not begun by the time the work is done.
    void run(int pieces, const std::function<void(int)>& piece) {
        Job job(pieces, piece);
        start_helpers();
        {
            const std::scoped_lock lock(mutex_);
            job_ = &job;
            ++generation_;
        }
        wake_.notify_all();
        job.work();
        {
            std::unique_lock lock(mutex_);
            job_ = nullptr;
            idle_.wait(lock, [&] { return working_ == 0; });
        }
        job.rethrow();
    }

private:
    void start_helpers() {
        for (; helpers_wanted_ > 0; --helpers_wanted_) {
            try {
                helpers_.emplace_back([this] { help(); });
            } catch (const std::system_error&) {
                helpers_wanted_ = 0;  // the system has no more threads for us: fewer do it too
                return;
            }
        }
    }

    void help() {
        unsigned seen = 0;
        std::unique_lock lock(mutex_);
        while (true) {
            wake_.wait(lock, [&] { return ends_ || (job_ && generation_ != seen); });
            if (ends_) return;
            seen = generation_;
            Job& job = *job_;
            ++working_;
            lock.unlock();
            job.work();
            lock.lock();
            if (--working_ == 0) idle_.notify_all();
        }
    }

    int helpers_wanted_;
    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable idle_;
    Job* job_ = nullptr;
    unsigned generation_ = 0;
    int working_ = 0;
    bool ends_ = false;
};

namespace {

thread_local ThreadTeam* current_team = nullptr;

// The team of this thread, taken away for as long as it works on a loop.
class Taken {
public:
    Taken() : team(current_team) { current_team = nullptr; }
    ~Taken() { current_team = team; }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

    ThreadTeam* const team;
};

}  // namespace

Threads::Threads(int count) : team_(std::make_unique<ThreadTeam>(wanted_threads(count))), previous_(current_team) {
    current_team = team_.get();
}

Threads::~Threads() { current_team = previous_; }

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
