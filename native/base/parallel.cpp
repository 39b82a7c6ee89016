#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#if defined(__x86_64__) || defined(_M_X64)
#include <immintrin.h>
#endif

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

// A solve enters some thousand loops of a hundredth to a tenth of a millisecond, one soon after the other, and waking a
// thread takes as long as such a loop. So who has nothing to do looks on for a while before it sleeps.
class LookOut {
public:
    template <typename Condition>
    static bool until(const Condition& condition) {
        const auto end = Clock::now() + longest;
        do {
            for (int k = 0; k < looks; ++k) {
                if (condition()) return true;
                pause();
            }
        } while (Clock::now() < end);
        return condition();
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::microseconds longest{50};
    static constexpr int looks = 32;  // between two readings of the clock

    static void pause() {
#if defined(__x86_64__) || defined(_M_X64)
        _mm_pause();
#else
        std::this_thread::yield();
#endif
    }
};

class ThreadTeam {
public:
    explicit ThreadTeam(int count) : helpers_wanted_(count - 1) {}

    ~ThreadTeam() {
        {
            const std::scoped_lock lock(mutex_);
            ends_ = true;
        }
        ++posted_;
        wake_.notify_all();
        for (std::thread& helper : helpers_) helper.join();
    }

    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    // Doesn't wait for helpers that have not begun by the time the work is done.
    void run(int pieces, const std::function<void(int)>& piece) {
        Job job(pieces, piece);
        start_helpers();
        const bool asleep = post(&job);
        if (asleep) wake_.notify_all();
        job.work();
        post(nullptr);
        if (!LookOut::until([&] { return working_ == 0; })) {
            std::unique_lock lock(mutex_);
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

    // Whether helpers sleep.
    bool post(Job* job) {
        bool asleep = false;
        {
            const std::scoped_lock lock(mutex_);
            job_ = job;
            if (job) ++generation_;
            asleep = asleep_ > 0;
        }
        if (job) ++posted_;  // without the lock: who looks on takes it next
        return asleep;
    }

    void help() {
        unsigned seen = 0;
        while (true) {
            LookOut::until([&] { return posted_ != seen; });
            std::unique_lock lock(mutex_);
            const auto wanted = [&] { return ends_ || (job_ && generation_ != seen); };
            if (!wanted()) {
                ++asleep_;
                wake_.wait(lock, wanted);
                --asleep_;
            }
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
    unsigned generation_ = 0;  // of jobs
    std::atomic<unsigned> posted_ = 0;  // generations that may be looked at
    std::atomic<int> working_ = 0;
    int asleep_ = 0;
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
