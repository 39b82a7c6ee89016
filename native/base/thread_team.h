// The threads behind `Threads`: helpers of one thread, which run its loops and background work with it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "base/background_work.h"

namespace fairing {

class ThreadTeam {
public:
    // `count`: threads, that of the caller among them. They begin where there is work for them.
    explicit ThreadTeam(int count) : helpers_wanted_(count - 1) {}
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    // See run_pieces. Doesn't wait for helpers that have not begun by the time the work is done.
    void run(int pieces, const std::function<void(int)>& piece);
    // For the next helper that has nothing to do.
    void send(std::shared_ptr<BackgroundTask::Work> work);

    // This thread's team; null without one, and within a piece or background work.
    static constinit thread_local ThreadTeam* current;

private:
    class Job;

    void start_helpers();
    template <typename Change>
    void post(const Change& change);
    void wait_for_helpers() noexcept;
    void help() noexcept;
    void help_with_job(std::unique_lock<std::mutex>& lock, unsigned& seen);
    void do_work(std::unique_lock<std::mutex>& lock);

    int helpers_wanted_;
    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable idle_;
    Job* job_ = nullptr;
    std::deque<std::shared_ptr<BackgroundTask::Work>> works_;
    unsigned generation_ = 0;           // of jobs
    std::atomic<unsigned> posted_ = 0;  // jobs, works
    std::atomic<int> working_ = 0;      // helpers within the job
    int asleep_ = 0;
    bool ends_ = false;
};

}  // namespace fairing
